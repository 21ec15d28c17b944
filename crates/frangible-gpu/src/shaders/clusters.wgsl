// The stress bound of each cluster of tetrahedra at the live columns of a chunk, and whether it passes the limit. One
// invocation per column and CLUSTERS clusters.

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> jobs: array<Job>;
// Column and impact of each live column.
@group(0) @binding(2) var<storage, read> live: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> amplitudes: array<f32>;
// Largest stress and displacement gradient: one row per cluster, one column per mode.
@group(0) @binding(4) var<storage, read> largest: array<vec2<f32>>;
// Whether a cluster passes at a column of the chunk: one row per cluster.
@group(0) @binding(5) var<storage, read_write> passing: array<u32>;
// Largest bound of the clusters that do not, Pa: one row per CLUSTERS of them, one column per live column.
@group(0) @binding(6) var<storage, read_write> passed_over: array<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    if (id.x >= chunk.count) {
        return;
    }
    let place = chunk.first + id.x;
    let column = live[place].x * chunk.modes;
    let limit = jobs[live[place].y].limit;
    let end = min((id.y + 1u) * CLUSTERS, chunk.clusters);
    var below = 0.0;
    for (var cluster = id.y * CLUSTERS; cluster < end; cluster++) {
        var stress = 0.0;
        var gradient = 0.0;
        for (var i = 0u; i < chunk.modes; i++) {
            let q = abs(amplitudes[column + i]);
            let of_mode = largest[cluster * chunk.modes + i];
            stress += q * of_mode.x;
            gradient += q * of_mode.y;
        }
        let bound = stress + 0.5 * chunk.quadratic * gradient * gradient;
        let passes = bound > limit;
        passing[cluster * chunk.stride + id.x] = select(0u, 1u, passes);
        below = select(max(below, bound), below, passes);
    }
    passed_over[id.y * chunk.alive + place] = below;
}
