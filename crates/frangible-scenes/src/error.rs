//! Errors of scenes.

use std::path::PathBuf;

use thiserror::Error;

/// Error of a scene.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// No built-in scene of that name.
    #[error("there is no scene `{name}`{hint}; scenes: {known}")]
    UnknownScene {
        /// Name asked for.
        name: String,
        /// “, did you mean …”, or nothing.
        hint: String,
        /// The names there are.
        known: String,
    },
    /// A quantity of the scene that cannot be used.
    #[error("{what} is {value}; it must be {must}")]
    Quantity {
        /// The quantity.
        what: &'static str,
        /// The value given.
        value: String,
        /// The values allowed, with their unit.
        must: &'static str,
    },
    /// Two settings that cannot stand together, or one that lacks another.
    #[error("{0}")]
    Clash(String),
    /// A fault of one item of several, as of one of the bodies.
    #[error("{item}: {source}")]
    Item {
        /// The item, by its list and number.
        item: String,
        /// Its error.
        source: Box<SceneError>,
    },
    /// A scene file that cannot be understood.
    #[error("{file} line {line}: {problem}")]
    Toml {
        /// The file, as it was named.
        file: String,
        /// Line, from 1.
        line: usize,
        /// Fault of the line.
        problem: String,
    },
    /// A file that cannot be read.
    #[error("{problem}: {}", path.display())]
    File {
        /// Path at which it was looked for.
        path: PathBuf,
        /// Reason, in words.
        problem: String,
    },
    /// A file of unknown kind.
    #[error(
        "`{}` has no ending that is known; give a mesh (.obj, .stl, .ply, .gltf, .glb), tetrahedra (.msh, .node, .ele, .vtk, .vtu, .mesh), a baked body (.frangible) or a scene (.toml)",
        .0.display()
    )]
    UnknownKind(PathBuf),
    /// A mesh whose size cannot be meant.
    #[error(
        "the body is {longest} m long if the unit of `{}` is the metre; give its longest side in metres, 0.001 to 3, for example --size {example} (in a scene file: size = {example})",
        path.display()
    )]
    Size {
        /// The mesh file.
        path: PathBuf,
        /// Its longest side in its own unit.
        longest: f64,
        /// A size that may be meant, m.
        example: f64,
    },
    /// A ball that would start inside the floor or the body.
    #[error(
        "the {what} would start {depth_mm:.1} mm below the floor; aim higher with --at, or turn --toward downwards"
    )]
    BallBelowFloor {
        /// Ball or hammer.
        what: &'static str,
        /// Depth, mm.
        depth_mm: f32,
    },
    /// A body that would start inside the floor.
    #[error("`{body}` would start {depth_mm:.1} mm below the floor; raise its position")]
    BodyBelowFloor {
        /// Name of the body.
        body: String,
        /// Depth, mm.
        depth_mm: f32,
    },
    /// Two bodies that would start inside each other.
    #[error(
        "`{one}` and `{other}` overlap: one would start {depth_mm:.1} mm deep inside the other; give one of them another `position`"
    )]
    Overlap {
        /// Name of one body.
        one: String,
        /// Name of the other.
        other: String,
        /// Depth of the overlap, mm.
        depth_mm: f32,
    },
    /// The number of baked bodies is not that of the scene's bodies.
    #[error("the scene has {wanted} bodies, but {given} baked ones were given; bake this scene")]
    BakedBodies {
        /// Bodies of the scene.
        wanted: usize,
        /// Baked bodies.
        given: usize,
    },
    /// A file of a baked body that cannot be read or written.
    #[error(transparent)]
    Asset(#[from] frangible::internals::AssetFileError),
    /// A baked body that cannot be of the material or size asked for.
    #[error("{}: {source}{hint}", path.display())]
    Rescale {
        /// Its file.
        path: PathBuf,
        /// Reason.
        source: Box<frangible_bake::RescaleError>,
        /// Command to type, or nothing.
        hint: String,
    },
    /// Walls that more tetrahedra would resolve.
    #[error(
        "`{body}` has walls of {wall_mm:.3} mm, which need about {needed} tetrahedra; ask for them with --resolution {needed} (in a scene file: resolution = {needed})"
    )]
    ThinWalls {
        /// Name of the body.
        body: String,
        /// Their thickness, mm.
        wall_mm: f64,
        /// Tetrahedra they need.
        needed: usize,
    },
    /// Walls that no allowed number of tetrahedra resolves.
    #[error(
        "`{body}` has walls of {wall_mm:.3} mm, too thin beside its size for the {limit} tetrahedra there may be; make them thicker or the body smaller across"
    )]
    WaferWalls {
        /// Name of the body.
        body: String,
        /// Their thickness, mm.
        wall_mm: f64,
        /// Most tetrahedra there may be.
        limit: usize,
    },
    /// A body to be baked, in a build without the bake.
    #[error(
        "`{body}` would have to be baked, which this build cannot do; give it baked (.frangible)"
    )]
    NoBake {
        /// Name of the body.
        body: String,
    },
    /// The body could not be baked.
    #[error("baking failed: {0}")]
    Bake(#[from] frangible_bake::BakeError),
    /// The rigid-body world refused something.
    #[error("simulating failed: {0}")]
    World(#[from] frangible_rapier::WorldError),
    /// The fracture model refused something.
    #[error(transparent)]
    Input(#[from] frangible::InputError),
    /// No such material.
    #[error(transparent)]
    Material(#[from] frangible::internals::UnknownMaterial),
}
