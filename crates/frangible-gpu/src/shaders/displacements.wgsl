// u = Φ q: displacements of the analysis nodes at the time steps of a chunk. Tiles of 64 × 64, 4 × 4 per invocation;
// tiles without a column that needs a look are left alone.

@group(0) @binding(0) var<uniform> chunk: Chunk;
// Row-major: one row per node and axis, one column per mode.
@group(0) @binding(1) var<storage, read> shapes: array<f32>;
@group(0) @binding(2) var<storage, read> amplitudes: array<f32>;
@group(0) @binding(3) var<storage, read> tiles: array<u32>;
// Row-major: one row per node and axis, one column per time step.
@group(0) @binding(4) var<storage, read_write> displacements: array<f32>;

const DEPTH: u32 = 16u;
// Rows of 65 keep invocations that write down a column out of each other's banks.
var<workgroup> left: array<f32, 1040>;
var<workgroup> right: array<f32, 1040>;

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) tile: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let row = tile.x * 64u;
    let column = chunk.first + tile.y * COLUMNS;
    if (tiles[column / COLUMNS] == 0u) {
        return;
    }
    var sums: array<vec4<f32>, 4>;
    let depths = (chunk.modes + DEPTH - 1u) / DEPTH;
    // High modes first: they move little, so that the sum is large, and rounds, only at the end.
    for (var d = 0u; d < depths; d++) {
        let first = (depths - 1u - d) * DEPTH;
        for (var i = lane; i < 64u * DEPTH; i += 256u) {
            let mode = first + i % DEPTH;
            let at = (i % DEPTH) * 65u + i / DEPTH;
            let r = row + i / DEPTH;
            let c = column + i / DEPTH;
            left[at] = 0.0;
            if (mode < chunk.modes && r < chunk.rows) {
                left[at] = shapes[r * chunk.modes + mode];
            }
            right[at] = 0.0;
            if (mode < chunk.modes && c < chunk.columns) {
                right[at] = amplitudes[c * chunk.modes + mode];
            }
        }
        workgroupBarrier();
        for (var k = DEPTH; k > 0u; k--) {
            let at = (k - 1u) * 65u;
            // Columns lie 16 apart, so that neighbours write neighbours.
            let q = vec4(
                right[at + local.x],
                right[at + local.x + 16u],
                right[at + local.x + 32u],
                right[at + local.x + 48u],
            );
            for (var i = 0u; i < 4u; i++) {
                sums[i] += left[at + local.y * 4u + i] * q;
            }
        }
        workgroupBarrier();
    }
    for (var i = 0u; i < 4u; i++) {
        let r = row + local.y * 4u + i;
        if (r < chunk.rows) {
            let at = r * chunk.stride + tile.y * COLUMNS + local.x;
            displacements[at] = sums[i].x;
            displacements[at + 16u] = sums[i].y;
            displacements[at + 32u] = sums[i].z;
            displacements[at + 48u] = sums[i].w;
        }
    }
}
