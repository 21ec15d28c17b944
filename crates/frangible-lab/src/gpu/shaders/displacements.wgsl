// u = Φ q: displacements of the analysis nodes at the live columns of a chunk. Tiles of 64 × 64, 4 × 4 per
// invocation.

@group(0) @binding(0) var<uniform> chunk: Chunk;
// Row-major: one row per node and axis, one column per mode.
@group(0) @binding(1) var<storage, read> shapes: array<f32>;
@group(0) @binding(2) var<storage, read> amplitudes: array<f32>;
// Column and impact of each live column.
@group(0) @binding(3) var<storage, read> live: array<vec2<u32>>;
// Row-major: one row per node and axis, one column per live column of the chunk.
@group(0) @binding(4) var<storage, read_write> displacements: array<f32>;

const DEPTH: u32 = 16u;
// Rows of 65 keep invocations that write down a column out of each other's banks.
var<workgroup> left: array<f32, 1040>;
var<workgroup> right: array<f32, 1040>;

fn store(row: u32, column: u32, u: vec4<f32>) {
    if (row < chunk.rows) {
        let at = row * chunk.stride + column;
        displacements[at] = u.x;
        displacements[at + 16u] = u.y;
        displacements[at + 32u] = u.z;
        displacements[at + 48u] = u.w;
    }
}

@compute @workgroup_size(16, 16)
fn main(
    @builtin(workgroup_id) tile: vec3<u32>,
    @builtin(local_invocation_id) local: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let row = tile.x * 64u;
    let column = tile.y * COLUMNS;
    // Four variables, no array: an index that is not constant would put it into memory.
    var a = vec4(0.0);
    var b = vec4(0.0);
    var c = vec4(0.0);
    var d = vec4(0.0);
    let depths = (chunk.modes + DEPTH - 1u) / DEPTH;
    // High modes first: they move little, so that the sum is large, and rounds, only at the end.
    for (var depth = depths; depth > 0u; depth--) {
        let first = (depth - 1u) * DEPTH;
        for (var i = lane; i < 64u * DEPTH; i += 256u) {
            let mode = first + i % DEPTH;
            let at = (i % DEPTH) * 65u + i / DEPTH;
            let r = row + i / DEPTH;
            let col = column + i / DEPTH;
            left[at] = 0.0;
            if (mode < chunk.modes && r < chunk.rows) {
                left[at] = shapes[r * chunk.modes + mode];
            }
            right[at] = 0.0;
            if (mode < chunk.modes && col < chunk.count) {
                right[at] = amplitudes[live[chunk.first + col].x * chunk.modes + mode];
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
            let of_rows = at + local.y * 4u;
            a += left[of_rows] * q;
            b += left[of_rows + 1u] * q;
            c += left[of_rows + 2u] * q;
            d += left[of_rows + 3u] * q;
        }
        workgroupBarrier();
    }
    let first_row = row + local.y * 4u;
    let first_column = column + local.x;
    store(first_row, first_column, a);
    store(first_row + 1u, first_column, b);
    store(first_row + 2u, first_column, c);
    store(first_row + 3u, first_column, d);
}
