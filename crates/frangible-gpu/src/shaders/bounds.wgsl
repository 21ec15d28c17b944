// The stress bound of each time step, over the whole body, and whether it passes the limit. One invocation per column.

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> amplitudes: array<f32>;
// Largest stress and displacement gradient of each mode.
@group(0) @binding(2) var<storage, read> root: array<vec2<f32>>;
// Limit in; out the bound, negative where it does not pass the limit.
@group(0) @binding(3) var<storage, read_write> bounds: array<f32>;
// Whether any column of a tile needs a look.
@group(0) @binding(4) var<storage, read_write> tiles: array<u32>;

var<workgroup> passing: array<u32, 64>;

@compute @workgroup_size(64)
fn main(
    @builtin(global_invocation_id) id: vec3<u32>,
    @builtin(workgroup_id) tile: vec3<u32>,
    @builtin(local_invocation_index) lane: u32,
) {
    let column = id.x;
    passing[lane] = 0u;
    if (column < chunk.columns) {
        var stress = 0.0;
        var gradient = 0.0;
        for (var i = 0u; i < chunk.modes; i++) {
            let q = abs(amplitudes[column * chunk.modes + i]);
            stress += q * root[i].x;
            gradient += q * root[i].y;
        }
        let bound = stress + 0.5 * chunk.quadratic * gradient * gradient;
        if (bound > bounds[column]) {
            passing[lane] = 1u;
            // Above zero also where a bound of zero passes, for want of culling.
            bounds[column] = max(bound, 1e-30);
        } else {
            bounds[column] = -bound;
        }
    }
    workgroupBarrier();
    if (lane == 0u) {
        var any = 0u;
        for (var i = 0u; i < COLUMNS; i++) {
            any |= passing[i];
        }
        tiles[tile.x] = any;
    }
}
