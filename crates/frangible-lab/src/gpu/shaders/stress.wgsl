// Largest principal tension at each weak tetrahedron over the live columns of a chunk where its cluster passes the
// limit. A workgroup has POINTS weak tetrahedra of an impact and SLICES invocations for each of them, which share out the
// columns, four at a time.

const POINTS: u32 = 16u;
const SLICES: u32 = 4u;

// Laws of stress: inside the body; beside a free surface; at the edge between two.
const SOLID: u32 = 0u;
const FREE: u32 = 1u;
const EDGE: u32 = 2u;

@group(0) @binding(0) var<uniform> chunk: Chunk;
@group(0) @binding(1) var<storage, read> jobs: array<Job>;
@group(0) @binding(2) var<storage, read> weak: array<Weak>;
// Per analysis element: ten nodes, two of padding, the gradients of the four barycentric coordinates as bits.
@group(0) @binding(3) var<storage, read> elements: array<array<u32, 24>>;
// As displacements.wgsl writes them, four columns at a time.
@group(0) @binding(4) var<storage, read> displacements: array<vec4<f32>>;
// Column and impact of each live column.
@group(0) @binding(5) var<storage, read> live: array<vec2<u32>>;
// Whether a cluster passes at a column of the chunk: one row per cluster, four columns at a time.
@group(0) @binding(6) var<storage, read> passing: array<vec4<u32>>;
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

// Gradients of the displacement, one letter for its component and one for the axis, at four columns.
struct Gradient {
    xx: vec4<f32>,
    xy: vec4<f32>,
    xz: vec4<f32>,
    yx: vec4<f32>,
    yy: vec4<f32>,
    yz: vec4<f32>,
    zx: vec4<f32>,
    zy: vec4<f32>,
    zz: vec4<f32>,
}

// Displacement at four columns.
struct Moved {
    x: vec4<f32>,
    y: vec4<f32>,
    z: vec4<f32>,
}

// Strain at four columns: the diagonal, and twice what is beside it.
struct Strain {
    xx: vec4<f32>,
    yy: vec4<f32>,
    zz: vec4<f32>,
    xy: vec4<f32>,
    yz: vec4<f32>,
    zx: vec4<f32>,
}

fn moved(row: u32, quad: u32) -> Moved {
    let at = row + quad;
    let next = chunk.stride / 4u;
    return Moved(displacements[at], displacements[at + next], displacements[at + 2u * next]);
}

// The share of one node, whose shape function has the gradient `g`. The gradients of all ten add up to nothing: what all
// nodes share only costs digits.
fn with_node(sum: Gradient, row: u32, quad: u32, shared_part: Moved, g: vec3<f32>) -> Gradient {
    let u = moved(row, quad);
    let x = u.x - shared_part.x;
    let y = u.y - shared_part.y;
    let z = u.z - shared_part.z;
    return Gradient(
        sum.xx + x * g.x,
        sum.xy + x * g.y,
        sum.xz + x * g.z,
        sum.yx + y * g.x,
        sum.yy + y * g.y,
        sum.yz + y * g.z,
        sum.zx + z * g.x,
        sum.zy + z * g.y,
        sum.zz + z * g.z,
    );
}

// Largest eigenvalue of a symmetric tensor. The cubic's solution mean + 2 p cos(acos(h) / 3), with the cosine as a
// polynomial of cos(acos(h) / 2) = √((1 + h) / 2): to 2e-7, where WGSL's own cos and acos promise 5e-4.
fn largest_eigenvalue(t: Strain) -> vec4<f32> {
    let mean = (t.xx + t.yy + t.zz) / 3.0;
    let x = t.xx - mean;
    let y = t.yy - mean;
    let z = t.zz - mean;
    let p2 = (x * x + y * y + z * z) / 6.0 + (t.xy * t.xy + t.yz * t.yz + t.zx * t.zx) / 3.0;
    let p = sqrt(p2);
    let determinant = x * (y * z - t.yz * t.yz) - t.xy * (t.xy * z - t.yz * t.zx)
        + t.zx * (t.xy * t.yz - y * t.zx);
    // In this order, since p³ of a strong tension comes near the largest number. Where p is nothing, so is its share.
    let h = clamp(determinant / max(p2, vec4(1e-30)) / max(p, vec4(1e-15)) * 0.5, vec4(-1.0), vec4(1.0));
    let s = sqrt(max(vec4(0.0), 0.5 + 0.5 * h));
    var c = vec4(1.1504290e-3);
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

fn strain(u: Gradient) -> Strain {
    let quadratic = chunk.green_lagrange;
    return Strain(
        u.xx + 0.5 * quadratic * (u.xx * u.xx + u.yx * u.yx + u.zx * u.zx),
        u.yy + 0.5 * quadratic * (u.xy * u.xy + u.yy * u.yy + u.zy * u.zy),
        u.zz + 0.5 * quadratic * (u.xz * u.xz + u.yz * u.yz + u.zz * u.zz),
        u.xy + u.yx + quadratic * (u.xx * u.xy + u.yx * u.yy + u.zx * u.zy),
        u.yz + u.zy + quadratic * (u.xy * u.xz + u.yy * u.yz + u.zy * u.zz),
        u.zx + u.xz + quadratic * (u.xz * u.xx + u.yz * u.yx + u.zz * u.zx),
    );
}

// a · E b
fn component(e: Strain, a: vec3<f32>, b: vec3<f32>) -> vec4<f32> {
    return e.xx * (a.x * b.x) + e.yy * (a.y * b.y) + e.zz * (a.z * b.z)
        + e.xy * (0.5 * (a.x * b.y + a.y * b.x))
        + e.yz * (0.5 * (a.y * b.z + a.z * b.y))
        + e.zx * (0.5 * (a.z * b.x + a.x * b.z));
}

// Largest principal tension by a law; where nothing acts across a surface, that across it, zero, is left out.
// `first`, `second`: axes in the free surface; of an edge the first is along it.
fn tension(law: u32, first: vec3<f32>, second: vec3<f32>, e: Strain) -> vec4<f32> {
    if (law == EDGE) {
        return chunk.youngs_modulus * component(e, first, first);
    }
    if (law == FREE) {
        let aa = component(e, first, first);
        let bb = component(e, second, second);
        let ab = component(e, first, second);
        let difference = chunk.mu * (aa - bb);
        let shear = 2.0 * chunk.mu * ab;
        let radius = sqrt(difference * difference + shear * shear);
        return (chunk.plane_lambda + chunk.mu) * (aa + bb) + radius;
    }
    let pressure = chunk.lambda * (e.xx + e.yy + e.zz);
    let twice = 2.0 * chunk.mu;
    return largest_eigenvalue(
        Strain(
            pressure + twice * e.xx,
            pressure + twice * e.yy,
            pressure + twice * e.zz,
            chunk.mu * e.xy,
            chunk.mu * e.yz,
            chunk.mu * e.zx,
        ),
    );
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

// Which of four columns are looked at: those of the impact whose cluster passes.
fn wanted(cluster: u32, quad: u32, first: u32, end: u32) -> vec4<bool> {
    let columns = vec4(4u * quad) + vec4(0u, 1u, 2u, 3u);
    let passes = passing[cluster * (chunk.stride / 4u) + quad] != vec4(0u);
    return passes & (columns >= vec4(first)) & (columns < vec4(end));
}

// What every SLICES-th group of four columns, from `slice` on, has of a weak tetrahedron. `first` and `end` are the
// impact's columns in the chunk.
fn follow(here: Weak, job: Job, slice: u32, first: u32, end: u32) -> Record {
    let element = here.element;
    let l = here.barycentric;
    let a = barycentric_gradient(element, 0u);
    let b = barycentric_gradient(element, 1u);
    let c = barycentric_gradient(element, 2u);
    let d = barycentric_gradient(element, 3u);
    // Gradients of the quadratic shape functions of all nodes but the first: corners, then middles of edges.
    let g1 = b * (4.0 * l.y - 1.0);
    let g2 = c * (4.0 * l.z - 1.0);
    let g3 = d * (4.0 * l.w - 1.0);
    let g4 = 4.0 * (b * l.x + a * l.y);
    let g5 = 4.0 * (c * l.y + b * l.z);
    let g6 = 4.0 * (c * l.x + a * l.z);
    let g7 = 4.0 * (d * l.x + a * l.w);
    let g8 = 4.0 * (d * l.y + b * l.w);
    let g9 = 4.0 * (d * l.z + c * l.w);
    // Rows of the nodes, in groups of four columns.
    let row = 3u * (chunk.stride / 4u);
    let r0 = elements[element][0] * row;
    let r1 = elements[element][1] * row;
    let r2 = elements[element][2] * row;
    let r3 = elements[element][3] * row;
    let r4 = elements[element][4] * row;
    let r5 = elements[element][5] * row;
    let r6 = elements[element][6] * row;
    let r7 = elements[element][7] * row;
    let r8 = elements[element][8] * row;
    let r9 = elements[element][9] * row;
    var axes = array<vec3<f32>, 2>(here.direction, here.direction);
    if (here.law == FREE) {
        axes = perpendicular(here.direction);
    }
    let near = here.strength * (1.0 - DOUBT);
    var found = Record(0.0, 0u, 0u, 0.0);
    let quads = (end + 3u) / 4u;
    for (var quad = first / 4u + slice; quad < quads; quad += SLICES) {
        let looked_at = wanted(here.cluster, quad, first, end);
        if (!any(looked_at)) {
            continue;
        }
        let base = moved(r0, quad);
        let none = vec4(0.0);
        var u = Gradient(none, none, none, none, none, none, none, none, none);
        u = with_node(u, r1, quad, base, g1);
        u = with_node(u, r2, quad, base, g2);
        u = with_node(u, r3, quad, base, g3);
        u = with_node(u, r4, quad, base, g4);
        u = with_node(u, r5, quad, base, g5);
        u = with_node(u, r6, quad, base, g6);
        u = with_node(u, r7, quad, base, g7);
        u = with_node(u, r8, quad, base, g8);
        u = with_node(u, r9, quad, base, g9);
        let t = select(none, tension(here.law, axes[0], axes[1], strain(u)), looked_at);
        let largest = max(max(t.x, t.y), max(t.z, t.w));
        found.peak = max(found.peak, largest);
        // Rarely met, and then only until the first of each is known.
        if (largest > near && found.crack == 0u) {
            for (var k = 0u; k < 4u; k++) {
                let column = 4u * quad + k;
                // Beyond its columns an impact has no steps; there the tension is zero.
                if (t[k] > near && found.crack == 0u) {
                    let step = NONE - (live[chunk.first + column].x - job.first_column);
                    found.doubt = max(found.doubt, step);
                    if (t[k] > here.strength) {
                        found.crack = step;
                        found.tension = t[k];
                    }
                }
            }
        }
    }
    return found;
}

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) id: vec3<u32>, @builtin(local_invocation_index) lane: u32) {
    let job = jobs[chunk.first_job + id.z];
    let place = (id.y * ROW + id.x) * POINTS + lane / SLICES;
    let slice = lane % SLICES;
    let first = max(job.first_alive, chunk.first) - chunk.first;
    let end = min(job.first_alive + job.alive, chunk.first + chunk.count) - chunk.first;
    lanes[lane] = Record(0.0, 0u, 0u, 0.0);
    if (place < job.weak) {
        let here = weak[job.first_weak + place];
        var looks = false;
        for (var quad = first / 4u + slice; quad < (end + 3u) / 4u; quad += SLICES) {
            looks = looks || any(wanted(here.cluster, quad, first, end));
        }
        if (looks) {
            lanes[lane] = follow(here, job, slice, first, end);
        }
    }
    for (var half = SLICES / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if (slice < half) {
            lanes[lane] = merged(lanes[lane], lanes[lane + half]);
        }
    }
    if (slice == 0u && place < job.weak) {
        let at = job.first_record + place;
        records[at] = merged(records[at], lanes[lane]);
    }
}
