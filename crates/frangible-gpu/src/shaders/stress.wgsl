// Largest principal tension at each weak tetrahedron over the live columns of a chunk where its cluster passes the
// limit. One workgroup per impact and weak tetrahedron; its invocations share out the columns.

// Laws of stress: inside the body; beside a free surface; at the edge between two.
const SOLID: u32 = 0u;
const FREE: u32 = 1u;
const EDGE: u32 = 2u;

// What is known of a weak tetrahedron of an impact so far. Steps count down from NONE, so that 0, what buffers are
// cleared to, is never, and the larger is the earlier.
struct Record {
    // Largest tension, Pa; never below zero.
    peak: f32,
    // First step at which the tension nears the strength …
    doubt: u32,
    // … and passes it, and the tension there, Pa.
    crack: u32,
    tension: f32,
}

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> jobs: array<Job>;
@group(0) @binding(2) var<storage, read> weak: array<Weak>;
// Per analysis element: ten nodes, two of padding, the gradients of the four barycentric coordinates as bits.
@group(0) @binding(3) var<storage, read> elements: array<array<u32, 24>>;
@group(0) @binding(4) var<storage, read> displacements: array<f32>;
// Column and impact of each live column.
@group(0) @binding(5) var<storage, read> live: array<vec2<u32>>;
// Whether a cluster passes at a column of the chunk: one row per cluster.
@group(0) @binding(6) var<storage, read> passing: array<u32>;
@group(0) @binding(7) var<storage, read_write> records: array<Record>;

var<workgroup> lanes: array<Record, 64>;

fn barycentric_gradient(element: u32, i: u32) -> vec3<f32> {
    let at = 12u + 3u * i;
    return vec3(
        bitcast<f32>(elements[element][at]),
        bitcast<f32>(elements[element][at + 1u]),
        bitcast<f32>(elements[element][at + 2u]),
    );
}

// Corner pairs of the six mid-edge nodes.
const FROM = array<u32, 6>(0u, 1u, 0u, 0u, 1u, 2u);
const TO = array<u32, 6>(1u, 2u, 2u, 3u, 3u, 3u);

// Gradients of the ten quadratic shape functions at a point, 1/m.
fn shape_gradients(place: Weak) -> array<vec3<f32>, 10> {
    var l = array<f32, 4>(
        place.barycentric.x,
        place.barycentric.y,
        place.barycentric.z,
        place.barycentric.w,
    );
    var g: array<vec3<f32>, 4>;
    var gradients: array<vec3<f32>, 10>;
    for (var a = 0u; a < 4u; a++) {
        g[a] = barycentric_gradient(place.element, a);
        gradients[a] = g[a] * (4.0 * l[a] - 1.0);
    }
    var edge_from = FROM;
    var edge_to = TO;
    for (var a = 0u; a < 6u; a++) {
        let i = edge_from[a];
        let j = edge_to[a];
        gradients[4u + a] = (g[j] * l[i] + g[i] * l[j]) * 4.0;
    }
    return gradients;
}

// Largest eigenvalue of a symmetric tensor (diagonal xx yy zz, off xy yz zx). The cubic's solution
// mean + 2 p cos(acos(h) / 3), with the cosine as a polynomial of cos(acos(h) / 2) = √((1 + h) / 2): to 2e-7, where
// WGSL's own cos and acos promise 5e-4.
fn largest_eigenvalue(diagonal: vec3<f32>, off: vec3<f32>) -> f32 {
    let mean = (diagonal.x + diagonal.y + diagonal.z) / 3.0;
    let d = diagonal - mean;
    let p2 = dot(d, d) / 6.0 + dot(off, off) / 3.0;
    let p = sqrt(p2);
    if (p2 <= 1e-30) {
        return mean;
    }
    let determinant = d.x * (d.y * d.z - off.y * off.y) - off.x * (off.x * d.z - off.y * off.z)
        + off.z * (off.x * off.y - d.y * off.z);
    // In this order, since p³ of a strong tension comes near the largest number.
    let h = clamp(determinant / p2 / p * 0.5, -1.0, 1.0);
    let s = sqrt(max(0.0, 0.5 + 0.5 * h));
    var c = 1.1504290e-3;
    c = c * s - 6.1699497e-3;
    c = c * s + 1.6159489e-2;
    c = c * s - 3.0313063e-2;
    c = c * s + 5.2869106e-2;
    c = c * s - 0.11104324;
    c = c * s + 0.57734722;
    c = c * s + 0.5;
    return mean + 2.0 * p * c;
}

// Two unit vectors perpendicular to a unit vector and to each other.
fn perpendicular(n: vec3<f32>) -> array<vec3<f32>, 2> {
    let a = abs(n);
    var helper = vec3(0.0, 0.0, 1.0);
    if (a.x <= a.y && a.x <= a.z) {
        helper = vec3(1.0, 0.0, 0.0);
    } else if (a.y <= a.z) {
        helper = vec3(0.0, 1.0, 0.0);
    }
    let first = normalize(cross(n, helper));
    return array<vec3<f32>, 2>(first, cross(first, n));
}

// Strain: xx yy zz, and twice xy yz zx.
struct Strain {
    e: vec3<f32>,
    s: vec3<f32>,
}

// x, y, z are the columns ∂u/∂x, ∂u/∂y, ∂u/∂z.
fn strain(x: vec3<f32>, y: vec3<f32>, z: vec3<f32>) -> Strain {
    let squares = chunk.green_lagrange * vec3(dot(x, x), dot(y, y), dot(z, z));
    let products = chunk.green_lagrange * vec3(dot(x, y), dot(y, z), dot(z, x));
    return Strain(
        vec3(x.x, y.y, z.z) + 0.5 * squares,
        vec3(y.x + x.y, z.y + y.z, x.z + z.x) + products,
    );
}

// a · E b
fn component(strain: Strain, a: vec3<f32>, b: vec3<f32>) -> f32 {
    let e = strain.e;
    let s = 0.5 * strain.s;
    return dot(
        a,
        vec3(
            e.x * b.x + s.x * b.y + s.z * b.z,
            s.x * b.x + e.y * b.y + s.y * b.z,
            s.z * b.x + s.y * b.y + e.z * b.z,
        ),
    );
}

// Largest principal tension by a law; where nothing acts across a surface, that across it, zero, is left out.
// `axes`: two in the free surface; of an edge the first is along it.
fn tension(law: u32, axes: array<vec3<f32>, 2>, here: Strain) -> f32 {
    if (law == EDGE) {
        return chunk.youngs_modulus * component(here, axes[0], axes[0]);
    }
    if (law == FREE) {
        let aa = component(here, axes[0], axes[0]);
        let bb = component(here, axes[1], axes[1]);
        let ab = component(here, axes[0], axes[1]);
        let radius = length(vec2(chunk.mu * (aa - bb), 2.0 * chunk.mu * ab));
        return (chunk.plane_lambda + chunk.mu) * (aa + bb) + radius;
    }
    let pressure = chunk.lambda * (here.e.x + here.e.y + here.e.z);
    return largest_eigenvalue(pressure + 2.0 * chunk.mu * here.e, chunk.mu * here.s);
}

// Of two times at the same place. A step is in one of them only, so the later one's tension never wins.
fn merged(a: Record, b: Record) -> Record {
    return Record(
        max(a.peak, b.peak),
        max(a.doubt, b.doubt),
        max(a.crack, b.crack),
        select(b.tension, a.tension, a.crack >= b.crack),
    );
}

fn displacement(at: u32) -> vec3<f32> {
    return vec3(
        displacements[at],
        displacements[at + chunk.stride],
        displacements[at + 2u * chunk.stride],
    );
}

// What the columns `first`, `first` + 64, … before `end` (places in the chunk) have of a weak tetrahedron.
fn follow(here: Weak, job: Job, first: u32, end: u32) -> Record {
    let strength = here.strength;
    let element = here.element;
    var gradients = shape_gradients(here);
    var axes = array<vec3<f32>, 2>(here.direction, here.direction);
    if (here.law == FREE) {
        axes = perpendicular(here.direction);
    }
    var rows: array<u32, 10>;
    for (var a = 0u; a < 10u; a++) {
        rows[a] = 3u * elements[element][a] * chunk.stride;
    }
    var found = Record(0.0, 0u, 0u, 0.0);
    for (var column = first; column < end; column += 64u) {
        if (passing[here.cluster * chunk.stride + column] == 0u) {
            continue;
        }
        var x = vec3(0.0);
        var y = vec3(0.0);
        var z = vec3(0.0);
        // The gradients of the shape functions add up to nothing: what all nodes share only costs digits.
        let shared_part = displacement(rows[0] + column);
        for (var a = 1u; a < 10u; a++) {
            let u = displacement(rows[a] + column) - shared_part;
            let g = gradients[a];
            x += u * g.x;
            y += u * g.y;
            z += u * g.z;
        }
        let t = tension(here.law, axes, strain(x, y, z));
        found.peak = max(found.peak, t);
        let step = NONE - (live[chunk.first + column].x - job.first_column);
        if (t > strength * (1.0 - DOUBT)) {
            found.doubt = max(found.doubt, step);
        }
        if (t > strength && found.crack == 0u) {
            found.crack = step;
            found.tension = t;
        }
    }
    return found;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let job = jobs[chunk.first_job + id.z];
    let place = id.y * ROW + id.x;
    if (place >= job.weak) {
        return;
    }
    let here = weak[job.first_weak + place];
    let first = max(job.first_alive, chunk.first) - chunk.first + lane;
    let end = min(job.first_alive + job.alive, chunk.first + chunk.count) - chunk.first;
    var any = 0u;
    for (var column = first; column < end; column += 64u) {
        any |= passing[here.cluster * chunk.stride + column];
    }
    lanes[lane] = Record(0.0, 0u, 0u, 0.0);
    if (any != 0u) {
        lanes[lane] = follow(here, job, first, end);
    }
    for (var half = 32u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if (lane < half) {
            lanes[lane] = merged(lanes[lane], lanes[lane + half]);
        }
    }
    if (lane == 0u) {
        let at = job.first_record + place;
        records[at] = merged(records[at], lanes[0]);
    }
}
