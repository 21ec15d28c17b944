// The stress bound of each time step, over the whole body. One invocation per column.

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> amplitudes: array<f32>;
// Largest stress and displacement gradient of each mode.
@group(0) @binding(2) var<storage, read> root: array<vec2<f32>>;
@group(0) @binding(3) var<storage, read_write> bounds: array<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let column = id.x;
    if (column >= chunk.columns) {
        return;
    }
    var stress = 0.0;
    var gradient = 0.0;
    for (var i = 0u; i < chunk.modes; i++) {
        let q = abs(amplitudes[column * chunk.modes + i]);
        stress += q * root[i].x;
        gradient += q * root[i].y;
    }
    bounds[column] = stress + 0.5 * chunk.quadratic * gradient * gradient;
}
