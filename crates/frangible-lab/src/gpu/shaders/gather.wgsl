// What comes back of an impact: its peak, its first crack, and a list of the weak tetrahedra that pass their strength.
// One workgroup per impact; each invocation takes a run of its summaries, so that the list keeps their order.

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> jobs: array<Job>;
@group(0) @binding(2) var<storage, read> records: array<Record>;
@group(0) @binding(3) var<storage, read> summaries: array<Summary>;
// Per impact HEADER words, then `list` entries of place, first step, tension then, largest tension.
@group(0) @binding(4) var<storage, read_write> results: array<u32>;

const HEADER: u32 = 11u;

var<workgroup> parts: array<Summary, 64>;

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let job = jobs[id.x];
    let tiles = (job.weak + TILE - 1u) / TILE;
    let run = (tiles + 63u) / 64u;
    let first = min(lane * run, tiles);
    let end = min(first + run, tiles);
    var mine = Summary(0.0, NONE, 0.0, NONE, 0u, 0u, NONE, 0.0, 0u, 0.0);
    for (var tile = first; tile < end; tile++) {
        mine = joined(mine, summaries[job.first_tile + tile]);
    }
    parts[lane] = mine;
    workgroupBarrier();
    let out = id.x * (HEADER + 4u * chunk.list);
    var entry = 0u;
    for (var i = 0u; i < lane; i++) {
        entry += parts[i].count;
    }
    for (var tile = first; tile < end && entry < chunk.list; tile++) {
        if (summaries[job.first_tile + tile].count == 0u) {
            continue;
        }
        let last = min((tile + 1u) * TILE, job.weak);
        for (var i = tile * TILE; i < last && entry < chunk.list; i++) {
            let r = records[job.first_record + i];
            if (r.crack > 0u) {
                let at = out + HEADER + 4u * entry;
                results[at] = i;
                results[at + 1u] = NONE - r.crack;
                results[at + 2u] = bitcast<u32>(r.tension);
                results[at + 3u] = bitcast<u32>(r.peak);
                entry++;
            }
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
