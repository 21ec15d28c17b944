// The stress bound of each time step, over the whole body. A workgroup has 16 columns, and 16 invocations for each of
// them, which share out the modes.

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> amplitudes: array<f32>;
// Largest stress and displacement gradient of each mode.
@group(0) @binding(2) var<storage, read> root: array<vec2<f32>>;
@group(0) @binding(3) var<storage, read_write> bounds: array<f32>;

// Stress and gradient.
var<workgroup> sums: array<vec2<f32>, 256>;

@compute @workgroup_size(256)
fn main(@builtin(workgroup_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let column = (id.y * ROW + id.x) * 16u + lane / 16u;
    let part = lane % 16u;
    var sum = vec2(0.0);
    if (column < chunk.columns) {
        for (var i = part; i < chunk.modes; i += 16u) {
            sum += abs(amplitudes[column * chunk.modes + i]) * root[i];
        }
    }
    sums[lane] = sum;
    for (var half = 8u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if (part < half) {
            sums[lane] += sums[lane + half];
        }
    }
    if (part == 0u && column < chunk.columns) {
        let s = sums[lane];
        bounds[column] = s.x + 0.5 * chunk.quadratic * s.y * s.y;
    }
}
