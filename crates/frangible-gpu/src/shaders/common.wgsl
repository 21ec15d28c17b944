// What all passes share; put before each of them.
//
// A column is a time step of an impact; the columns of all impacts of a batch stand one after another. A tile is
// COLUMNS of them. A chunk is a run of columns whose displacements fit the buffer for them.

const COLUMNS: u32 = 64u;
// Time steps from one restart of the recurrence to the next.
const RESTART: u32 = 64u;
// Weak tetrahedra along the first axis of a dispatch.
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
    // First column of the chunk.
    first: u32,
    // Columns of the chunk …
    count: u32,
    // … and room for them: a multiple of COLUMNS.
    stride: u32,
    first_job: u32,
    blocks: u32,
    // Lamé's parameters and the modulus of the bound's quadratic term, Pa.
    lambda: f32,
    mu: f32,
    quadratic: f32,
    // Entries of each impact's list.
    list: u32,
}

struct Job {
    first_column: u32,
    steps: u32,
    contact_steps: u32,
    // Its weak tetrahedra.
    first_weak: u32,
    weak: u32,
    first_record: u32,
    // Steps whose bound is not above this, Pa, need no look.
    limit: f32,
    padding: u32,
}
