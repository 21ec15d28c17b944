//! Structs of the header: plain numbers, and pointers into what the library owns.
#![expect(
    unsafe_code,
    reason = "the trait says that the structs are plain numbers"
)]

use std::ffi::c_char;

use crate::memory::Sized32;

/// Version of the header: a million times the major version, plus a thousand times the minor one, plus the patch. Compare it with
/// `frangible_version()`.
pub const FRANGIBLE_VERSION: u32 = 1000;

/// A striker that does not move, such as a floor: `mass` and all that follows it count for nothing.
pub const FRANGIBLE_STRIKER_FIXED: u32 = 0;
/// A ball, or anything else that is hit centrally: it strikes with its whole mass.
pub const FRANGIBLE_STRIKER_BALL: u32 = 1;
/// A rigid body of any shape: it strikes with what its mass, centre and inertia are at the contact.
pub const FRANGIBLE_STRIKER_BODY: u32 = 2;
/// A breakable body: as a rigid one, and it vibrates under the blow.
pub const FRANGIBLE_STRIKER_BREAKABLE: u32 = 3;

/// Handle of a kind of body: a shape and a material, baked by `frangible bake`. Any number of bodies share it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct frangible_breakable {
    /// Its number.
    pub id: u64,
}

/// Handle of one body, or of a piece of one. It keeps the cracks of blows that did not break it.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct frangible_body {
    /// Its number.
    pub id: u64,
}

/// Handle of the outcome of a blow.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct frangible_outcome {
    /// Its number.
    pub id: u64,
}

/// A pose: position of the centre of mass, m, and rotation, a quaternion x, y, z, w of length 1.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct frangible_pose {
    /// Position of the centre of mass, m.
    pub position: [f64; 3],
    /// Rotation.
    pub rotation: [f64; 4],
}

/// A motion: velocity of the centre of mass, m/s, and angular velocity, rad/s, in world axes.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct frangible_motion {
    /// Velocity of the centre of mass, m/s.
    pub linear: [f64; 3],
    /// Angular velocity, rad/s.
    pub angular: [f64; 3],
}

/// Striker of a body. `frangible_striker_of` fills it for a material.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_striker {
    /// sizeof(frangible_striker).
    pub size: u32,
    /// FRANGIBLE_STRIKER_FIXED, FRANGIBLE_STRIKER_BALL, FRANGIBLE_STRIKER_BODY or FRANGIBLE_STRIKER_BREAKABLE.
    pub kind: u32,
    /// Plane-strain modulus E/(1−ν²), Pa; infinite for a rigid striker.
    pub contact_modulus: f64,
    /// Pressure that crushes or dents its surface, Pa; infinite if none does.
    pub crushing_pressure: f64,
    /// Coefficient of restitution, 0 to 1.
    pub restitution: f64,
    /// Radius of curvature at the contact, m; infinite for a flat striker.
    pub radius: f64,
    /// Mass, kg.
    pub mass: f64,
    /// Centre of mass, m, in the frame of the contacts.
    pub centre: [f64; 3],
    /// Inertia about it, kg·m², in the axes of the contacts. For a ball it may be zero, which stands for that of a ball of `radius`.
    pub inertia: [f64; 9],
    /// Its motion just before the blow, for `frangible_outcome_motions`.
    pub motion: frangible_motion,
    /// The body, of a FRANGIBLE_STRIKER_BREAKABLE. The radius of curvature is its own.
    pub body: frangible_body,
    /// The rotation of that body, from its frame to that of the contacts.
    pub rotation: [f64; 4],
}

/// A contact of a blow: a striker that comes, or a push of a script.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_contact {
    /// sizeof(frangible_contact).
    pub size: u32,
    /// Index of its striker among those of the call. Contacts with the same striker share its mass.
    pub striker: u32,
    /// Point of contact, m, in the frame of the body, whose origin is its centre of mass, or in world axes if the call gives a pose.
    pub point: [f64; 3],
    /// Direction of the push on the body, into it, of any length.
    pub normal: [f64; 3],
    /// Speed of approach along the normal just before the blow, m/s.
    pub speed: f64,
    /// Friction on the body per newton of normal force: the direction in which the striker drags the surface, times the coefficient of friction.
    /// Its part along the normal counts for nothing. It counts in the blow on the body, not in `frangible_outcome_motions`.
    pub friction: [f64; 3],
    /// Impulse of a script's push, N·s.
    pub impulse: [f64; 3],
    /// Duration of a script's push, s; zero for a contact with a striker. If it is above zero, only `point` and `impulse` count.
    pub duration: f64,
}

/// Properties of a kind of body.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_about {
    /// sizeof(frangible_about).
    pub size: u32,
    /// 1 if a support holds the body in place, else 0.
    pub supported: u32,
    /// Its name, UTF-8, which is valid while the handle is.
    pub name: *const c_char,
    /// The name of its material.
    pub material: *const c_char,
    /// Tensile strength, Pa.
    pub strength: f64,
    /// Coefficient of friction.
    pub friction: f64,
    /// Coefficient of restitution.
    pub restitution: f64,
}

/// Masses of a body or of a fragment.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_solid {
    /// sizeof(frangible_solid).
    pub size: u32,
    /// 1 if a support holds it in place: it is a fixed body of a physics engine. Else 0.
    pub supported: u32,
    /// Mass, kg.
    pub mass: f64,
    /// Volume, m³.
    pub volume: f64,
    /// Centre of mass, m, of a fragment in the frame of the body that broke.
    pub centre: [f64; 3],
    /// Inertia about the centre, kg·m², in the axes of that frame.
    pub inertia: [f64; 9],
    /// Principal moments of inertia, kg·m², for engines that take these three.
    pub moments: [f64; 3],
    /// The rotation from the principal axes to those of that frame.
    pub axes: [f64; 4],
}

/// A mesh to draw, in the frame of the body or of the fragment: its origin is the centre of mass. The arrays are valid while the handle is.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_geometry {
    /// sizeof(frangible_geometry).
    pub size: u32,
    /// Zero.
    pub reserved: u32,
    /// Number of vertices.
    pub vertices: usize,
    /// Positions, m, three numbers per vertex.
    pub positions: *const f32,
    /// Unit normals, three numbers per vertex; null for the closed surface of a fragment, which has none.
    pub normals: *const f32,
    /// Texture coordinates, two numbers per vertex; null for the closed surface of a fragment.
    pub uvs: *const f32,
    /// Number of indices, three per triangle, counter-clockwise seen from outside.
    pub indices_count: usize,
    /// Number of indices that come first and belong to the body's original surface; those after them are crack faces.
    pub outer_indices: usize,
    /// The indices.
    pub indices: *const u32,
    /// Number of further sets of texture coordinates.
    pub more_uv_sets: usize,
    /// Those sets one after the other, two numbers per vertex each, zero on crack faces; null if there are none.
    pub more_uvs: *const f32,
    /// Linear red, green, blue and opacity of each vertex, white on crack faces; null if the mesh that was baked has no vertex colours.
    pub colors: *const f32,
    /// Number of groups.
    pub groups_count: usize,
    /// Ranges of the first `outer_indices` indices, one for each look; null if the mesh that was baked has no materials.
    pub groups: *const frangible_group,
}

/// Triangles of one look, see `frangible_breakable_look`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct frangible_group {
    /// First index.
    pub first: usize,
    /// Number of indices.
    pub count: usize,
    /// Number of the look.
    pub look: usize,
}

/// Convex parts for colliders, in the frame of the body or of the fragment. The arrays are valid while the handle is.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_hulls {
    /// sizeof(frangible_hulls).
    pub size: u32,
    /// Zero.
    pub reserved: u32,
    /// Number of parts.
    pub count: usize,
    /// Points of all parts one after the other, m, three numbers per point.
    pub points: *const f32,
    /// For each part the number of points up to its end: part k has the points from `ends[k - 1]`, or 0, to `ends[k]`.
    pub ends: *const usize,
}

/// Result of a blow.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_report {
    /// sizeof(frangible_report).
    pub size: u32,
    /// 1 if the body broke, else 0.
    pub broke: u32,
    /// Number of fragments, which together are the body; 0 if it did not break. They are in the order of their sizes, the largest first.
    pub fragments: usize,
    /// Number of contacts that were integrated, for `frangible_outcome_contact`.
    pub contacts: usize,
    /// Number of cracks that started.
    pub cracks: usize,
    /// Strength over an upper bound of the stress, which may be far above the stress itself; above 1 no crack started. 0 if the body broke.
    pub margin: f64,
    /// Duration of the contact, s.
    pub contact_duration: f64,
    /// Largest principal tensile stress at a weak point, Pa.
    pub peak_stress: f64,
    /// Upper bound of that stress, Pa.
    pub stress_bound: f64,
    /// Strength of the weakest point, Pa.
    pub strength: f64,
    /// Kinetic energy of the approach, J.
    pub approach_energy: f64,
    /// Energy spent on cracks, J.
    pub fracture_energy: f64,
    /// Sum of the impulses of all contacts on the body along their normals, N·s, in its frame.
    pub impulse: [f64; 3],
    /// Area of the cracks, one side, m².
    pub crack_area: f64,
    /// Time of the first crack since the start of the contact, s; NaN if there is none.
    pub first_crack_time: f64,
    /// Time that the computation took, s. The only number that is not the same in every run.
    pub seconds: f64,
}

/// Result of a blow at one contact.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct frangible_contact_report {
    /// sizeof(frangible_contact_report).
    pub size: u32,
    /// Zero.
    pub reserved: u32,
    /// Point on the surface, m, in the frame of the body.
    pub point: [f64; 3],
    /// Unit direction of the force on the body, in its frame.
    pub normal: [f64; 3],
    /// Impulse, N·s.
    pub impulse: f64,
    /// Largest force, N.
    pub peak_force: f64,
    /// Duration, s.
    pub duration: f64,
    /// Speed at which striker and body separate, m/s; below zero if the striker goes on into the body.
    pub departure_speed: f64,
    /// Energy spent on crushing, J.
    pub crushing_energy: f64,
    /// Crushed volume, m³.
    pub crushed_volume: f64,
}

/// The version of the library, as `FRANGIBLE_VERSION` is that of the header.
#[unsafe(no_mangle)]
pub extern "C" fn frangible_version() -> u32 {
    FRANGIBLE_VERSION
}

macro_rules! sized {
    ($($kind:ident)*) => {
        $(
            // SAFETY: it is `repr(C)` of numbers, arrays of numbers and raw pointers, for which all bits are sound, and its first field is its size.
            unsafe impl Sized32 for $kind {
                const NAME: &'static str = stringify!($kind);
                const FIRST: usize = size_of::<Self>();
            }

            const _: () = assert!(std::mem::offset_of!($kind, size) == 0);

            impl Default for $kind {
                /// Zeros, with the size.
                fn default() -> Self {
                    // SAFETY: all bits may be zero, as above.
                    let zeros: Self = unsafe { std::mem::zeroed() };
                    Self { size: size_of::<Self>() as u32, ..zeros }
                }
            }
        )*
    };
}

pub(crate) use sized;

sized! {
    frangible_striker
    frangible_contact
    frangible_about
    frangible_solid
    frangible_geometry
    frangible_hulls
    frangible_report
    frangible_contact_report
}
