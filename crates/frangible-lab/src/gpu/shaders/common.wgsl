// What all passes share; put before each of them.
//
// A column is a time step of an impact; the columns of all impacts of a wave stand one after another. Those whose bound
// passes the strength are alive, and are counted by themselves, in the same order. A chunk is a run of live columns
// whose displacements fit the buffer for them.

// Columns of a tile of displacements.
const COLUMNS: u32 = 64u;
// Clusters of tetrahedra per workgroup.
const CLUSTERS: u32 = 16u;
// Records of weak tetrahedra per summary.
const TILE: u32 = 256u;
// Time steps from one restart of the recurrence to the next.
const RESTART: u32 = 64u;
// Workgroups along the first axis of a dispatch, at most.
const ROW: u32 = 32768u;
// A largest tension within this share of the strength is the CPU's to judge.
const DOUBT: f32 = 1e-3;
// Stands for no time step, no tetrahedron.
const NONE: u32 = 0xffffffffu;

struct Chunk {
    modes: u32,
    // Rows of the mode shapes: three per analysis node.
    rows: u32,
    columns: u32,
    // First live column of the chunk, and how many it has …
    first: u32,
    count: u32,
    // … and room for them: a multiple of COLUMNS.
    stride: u32,
    // Live columns of the wave.
    alive: u32,
    first_job: u32,
    blocks: u32,
    clusters: u32,
    // Entries of each impact's list.
    list: u32,
    // Lamé's parameters and the modulus of the bound's quadratic term, Pa.
    lambda: f32,
    mu: f32,
    quadratic: f32,
    // λ* = 2 λ μ / (λ + 2 μ) and Young's modulus, Pa.
    plane_lambda: f32,
    youngs_modulus: f32,
    // 1 with the quadratic terms of strain, 0 without.
    green_lagrange: f32,
}

// A weak tetrahedron, and where its stress is taken: a point of an analysis element.
struct Weak {
    tet: u32,
    // Pa.
    strength: f32,
    cluster: u32,
    // SOLID, FREE or EDGE.
    law: u32,
    barycentric: vec4<f32>,
    // Unit normal of the free surface, or the edge's unit direction.
    direction: vec3<f32>,
    element: u32,
}

struct Job {
    first_column: u32,
    steps: u32,
    contact_steps: u32,
    // Its weak tetrahedra.
    first_weak: u32,
    weak: u32,
    first_record: u32,
    // Its live columns.
    first_alive: u32,
    alive: u32,
    // Steps, and clusters, whose bound is not above this, Pa, need no look.
    limit: f32,
    // Its summaries: one per TILE weak tetrahedra.
    first_tile: u32,
}

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

// What is known of some of an impact's weak tetrahedra.
struct Summary {
    // Largest tension, and where.
    peak: f32,
    peak_at: u32,
    // Largest tension over strength, and where.
    share: f32,
    share_at: u32,
    // First step in doubt, counted down.
    doubt: u32,
    // First crack: step, counted down, place and tension.
    crack: u32,
    crack_at: u32,
    tension: f32,
    // Tetrahedra that pass their strength.
    count: u32,
    // Largest bound of the clusters that were passed over.
    passed_over: f32,
}

// `b` is of later tetrahedra: of equals the earlier holds.
fn joined(a: Summary, b: Summary) -> Summary {
    var s = a;
    if (b.peak > a.peak) {
        s.peak = b.peak;
        s.peak_at = b.peak_at;
    }
    if (b.share > a.share) {
        s.share = b.share;
        s.share_at = b.share_at;
    }
    s.doubt = max(a.doubt, b.doubt);
    if (b.crack > a.crack || (b.crack == a.crack && b.tension > a.tension)) {
        s.crack = b.crack;
        s.crack_at = b.crack_at;
        s.tension = b.tension;
    }
    s.count += b.count;
    s.passed_over = max(a.passed_over, b.passed_over);
    return s;
}
