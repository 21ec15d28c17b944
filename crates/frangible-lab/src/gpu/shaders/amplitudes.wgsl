// Amplitudes of the modes over time: the recurrence of the 4 × 4 matrix exponential, in f32, restarted every RESTART
// steps from a state that was computed in f64. One invocation per mode and restart.

struct Mode {
    // The first two rows of the step matrix under the pulse; their first halves serve free of it as well.
    displacement: vec4<f32>,
    velocity: vec4<f32>,
    // Cosine and sine of the pulse's step, amplitude per state; padding.
    turn: vec4<f32>,
}

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> jobs: array<Job>;
// Impact and first step of each block of RESTART steps.
@group(0) @binding(2) var<storage, read> blocks: array<vec2<u32>>;
@group(0) @binding(3) var<storage, read> matrices: array<Mode>;
@group(0) @binding(4) var<storage, read> restarts: array<vec4<f32>>;
// Column-major: one column of modes per time step.
@group(0) @binding(5) var<storage, read_write> amplitudes: array<f32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let mode = id.x;
    let block = id.y + id.z * ROW;
    if (mode >= chunk.modes || block >= chunk.blocks) {
        return;
    }
    let of_job = blocks[block].x;
    let job = jobs[of_job];
    let m = matrices[of_job * chunk.modes + mode];
    var s = restarts[block * chunk.modes + mode];
    let first = blocks[block].y;
    let end = min(first + RESTART, job.steps);
    for (var step = first; step < end; step++) {
        let turned = vec2(m.turn.x * s.z + m.turn.y * s.w, m.turn.x * s.w - m.turn.y * s.z);
        if (step >= job.contact_steps) {
            s.z = 0.0;
            s.w = 0.0;
        }
        s = vec4(dot(m.displacement, s), dot(m.velocity, s), turned);
        amplitudes[(job.first_column + step) * chunk.modes + mode] = s.x * m.turn.z;
    }
}
