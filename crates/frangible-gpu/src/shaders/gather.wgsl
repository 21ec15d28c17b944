// What comes back of an impact: its peak, its first crack, and a list of the weak tetrahedra that pass their strength.
// One workgroup per impact; each invocation takes a run of its weak tetrahedra, so that the list keeps their order.

struct Record {
    peak: f32,
    doubt: u32,
    crack: u32,
    tension: f32,
}

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> jobs: array<Job>;
@group(0) @binding(2) var<storage, read> weak: array<Weak>;
@group(0) @binding(3) var<storage, read> records: array<Record>;
@group(0) @binding(4) var<storage, read> passed_over: array<f32>;
// Per impact HEADER words, then `list` entries of place, first step, tension then, largest tension.
@group(0) @binding(5) var<storage, read_write> results: array<u32>;

const HEADER: u32 = 11u;

struct Summary {
    // Largest tension, and where.
    peak: f32,
    peak_at: u32,
    // Largest tension over strength, and where.
    share: f32,
    share_at: u32,
    // First step in doubt, counted down.
    doubt: u32,
    // First crack: step, counted down, place and tension.
    crack: u32,
    crack_at: u32,
    tension: f32,
    // Tetrahedra that pass their strength.
    count: u32,
    // Largest bound of the clusters that were passed over.
    passed_over: f32,
}

var<workgroup> parts: array<Summary, 64>;

// `b` is of later tetrahedra: of equals the earlier holds.
fn joined(a: Summary, b: Summary) -> Summary {
    var s = a;
    if (b.peak > a.peak) {
        s.peak = b.peak;
        s.peak_at = b.peak_at;
    }
    if (b.share > a.share) {
        s.share = b.share;
        s.share_at = b.share_at;
    }
    s.doubt = max(a.doubt, b.doubt);
    if (b.crack > a.crack || (b.crack == a.crack && b.tension > a.tension)) {
        s.crack = b.crack;
        s.crack_at = b.crack_at;
        s.tension = b.tension;
    }
    s.count += b.count;
    s.passed_over = max(a.passed_over, b.passed_over);
    return s;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let job = jobs[chunk.first_job + id.x];
    let run = (job.weak + 63u) / 64u;
    let first = min(lane * run, job.weak);
    let end = min(first + run, job.weak);
    var mine = Summary(0.0, NONE, 0.0, NONE, 0u, 0u, NONE, 0.0, 0u, 0.0);
    for (var i = first; i < end; i++) {
        let r = records[job.first_record + i];
        let share = r.peak / weak[job.first_weak + i].strength;
        let cracks = select(0u, 1u, r.crack > 0u);
        mine = joined(
            mine,
            Summary(r.peak, i, share, i, r.doubt, r.crack, i, r.tension, cracks, 0.0),
        );
    }
    let groups = (chunk.clusters + CLUSTERS - 1u) / CLUSTERS;
    for (var column = lane; column < job.alive; column += 64u) {
        for (var i = 0u; i < groups; i++) {
            let below = passed_over[i * chunk.alive + job.first_alive + column];
            mine.passed_over = max(mine.passed_over, below);
        }
    }
    parts[lane] = mine;
    workgroupBarrier();
    let out = (chunk.first_job + id.x) * (HEADER + 4u * chunk.list);
    var entry = 0u;
    for (var i = 0u; i < lane; i++) {
        entry += parts[i].count;
    }
    for (var i = first; i < end; i++) {
        let r = records[job.first_record + i];
        if (r.crack > 0u && entry < chunk.list) {
            let at = out + HEADER + 4u * entry;
            results[at] = i;
            results[at + 1u] = NONE - r.crack;
            results[at + 2u] = bitcast<u32>(r.tension);
            results[at + 3u] = bitcast<u32>(r.peak);
            entry++;
        }
    }
    if (lane == 0u) {
        var all = parts[0];
        for (var i = 1u; i < 64u; i++) {
            all = joined(all, parts[i]);
        }
        results[out] = bitcast<u32>(all.peak);
        results[out + 1u] = all.peak_at;
        results[out + 2u] = bitcast<u32>(all.share);
        results[out + 3u] = all.share_at;
        results[out + 4u] = NONE - all.doubt;
        results[out + 5u] = NONE - all.crack;
        results[out + 6u] = all.crack_at;
        results[out + 7u] = bitcast<u32>(all.tension);
        results[out + 8u] = all.count;
        results[out + 9u] = bitcast<u32>(all.passed_over);
        results[out + 10u] = 0u;
        if (all.crack > 0u) {
            results[out + 10u] = bitcast<u32>(records[job.first_record + all.crack_at].peak);
        }
    }
}
