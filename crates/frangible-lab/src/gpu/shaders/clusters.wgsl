// The stress bound of each cluster of tetrahedra at the live columns of a chunk, and whether it passes the limit. Tiles
// of CLUSTERS × COLUMNS, a cluster and four columns per invocation.

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

const DEPTH: u32 = 16u;
var<workgroup> of_clusters: array<vec2<f32>, 256>;
// Rows of 65 keep invocations that write down a column out of each other's banks.
var<workgroup> of_columns: array<f32, 1040>;
var<workgroup> below: array<f32, 1024>;

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) tile: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let column = tile.x * COLUMNS;
    let first_cluster = tile.y * CLUSTERS;
    var stress = vec4(0.0);
    var gradient = vec4(0.0);
    for (var first = 0u; first < chunk.modes; first += DEPTH) {
        for (var i = lane; i < COLUMNS * DEPTH; i += 256u) {
            let mode = first + i % DEPTH;
            let place = column + i / DEPTH;
            let at = (i % DEPTH) * 65u + i / DEPTH;
            of_columns[at] = 0.0;
            if (mode < chunk.modes && place < chunk.count) {
                of_columns[at] = abs(amplitudes[live[chunk.first + place].x * chunk.modes + mode]);
            }
        }
        let mode = first + lane % DEPTH;
        let row = first_cluster + lane / DEPTH;
        of_clusters[lane] = vec2(0.0);
        if (mode < chunk.modes && row < chunk.clusters) {
            of_clusters[lane] = largest[row * chunk.modes + mode];
        }
        workgroupBarrier();
        for (var k = 0u; k < DEPTH; k++) {
            let at = k * 65u + local.x;
            let q = vec4(
                of_columns[at],
                of_columns[at + 16u],
                of_columns[at + 32u],
                of_columns[at + 48u],
            );
            let of_mode = of_clusters[local.y * DEPTH + k];
            stress += of_mode.x * q;
            gradient += of_mode.y * q;
        }
        workgroupBarrier();
    }
    let bounds = stress + 0.5 * chunk.quadratic * gradient * gradient;
    let cluster = first_cluster + local.y;
    for (var k = 0u; k < 4u; k++) {
        let at = local.x + 16u * k;
        let place = column + at;
        below[local.y * COLUMNS + at] = 0.0;
        if (place < chunk.count && cluster < chunk.clusters) {
            let passes = bounds[k] > jobs[live[chunk.first + place].y].limit;
            passing[cluster * chunk.stride + place] = select(0u, 1u, passes);
            below[local.y * COLUMNS + at] = select(bounds[k], 0.0, passes);
        }
    }
    workgroupBarrier();
    if (lane < COLUMNS && column + lane < chunk.count) {
        var most = 0.0;
        for (var i = 0u; i < CLUSTERS; i++) {
            most = max(most, below[i * COLUMNS + lane]);
        }
        passed_over[tile.y * chunk.alive + chunk.first + column + lane] = most;
    }
}
