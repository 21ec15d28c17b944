// Summaries of an impact's weak tetrahedra, and of the clusters that were passed over. One workgroup per impact and TILE
// weak tetrahedra, one invocation for each of them.

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> jobs: array<Job>;
@group(0) @binding(2) var<storage, read> weak: array<Weak>;
@group(0) @binding(3) var<storage, read> records: array<Record>;
@group(0) @binding(4) var<storage, read> passed_over: array<f32>;
@group(0) @binding(5) var<storage, read_write> summaries: array<Summary>;

var<workgroup> parts: array<Summary, 256>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let job = jobs[id.y];
    let tiles = (job.weak + TILE - 1u) / TILE;
    var mine = Summary(0.0, NONE, 0.0, NONE, 0u, 0u, NONE, 0.0, 0u, 0.0);
    let i = id.x * TILE + lane;
    if (i < job.weak) {
        let r = records[job.first_record + i];
        let share = r.peak / weak[job.first_weak + i].strength;
        let cracks = select(0u, 1u, r.crack > 0u);
        mine = joined(
            mine,
            Summary(r.peak, i, share, i, r.doubt, r.crack, i, r.tension, cracks, 0.0),
        );
    }
    // The workgroups share out what was passed over.
    let bounds = (chunk.clusters + CLUSTERS - 1u) / CLUSTERS * job.alive;
    if (id.x < tiles) {
        for (var k = i; k < bounds; k += tiles * TILE) {
            let at = k / job.alive * chunk.alive + job.first_alive + k % job.alive;
            mine.passed_over = max(mine.passed_over, passed_over[at]);
        }
    }
    parts[lane] = mine;
    // Neighbours first, so that they keep their order.
    for (var half = 1u; half < TILE; half *= 2u) {
        workgroupBarrier();
        if (lane % (2u * half) == 0u) {
            parts[lane] = joined(parts[lane], parts[lane + half]);
        }
    }
    if (lane == 0u && id.x < tiles) {
        summaries[job.first_tile + id.x] = parts[0];
    }
}
