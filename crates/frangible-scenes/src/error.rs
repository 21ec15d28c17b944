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
        /// Requested name.
        name: String,
        /// “, did you mean …”, or nothing.
        hint: String,
        /// Names of all scenes.
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
    /// Two settings that exclude each other, or one that requires another.
    #[error("{0}")]
    Clash(String),
    /// An error in one item of a list, such as one of the bodies.
    #[error("{item}: {source}")]
    Item {
        /// The item, by its list and number.
        item: String,
        /// Its error.
        source: Box<SceneError>,
    },
    /// A scene file with a syntax error or an invalid setting.
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
        /// Path of the file.
        path: PathBuf,
        /// Reason, in words.
        problem: String,
    },
    /// A mesh of several bodies where one is wanted.
    #[error(
        "the file has several bodies, but one is wanted here ({found}); keep the largest (--parts largest, in a scene file: parts = \"largest\"), weld them (--parts weld --gap METRES), or choose one (part = \"NAME\"): {}",
        path.display()
    )]
    SeveralParts {
        /// Path of the file.
        path: PathBuf,
        /// What was found in it.
        found: String,
    },
    /// A file of unknown kind.
    #[error(
        "the file extension of `{}` is unknown; give a mesh (.obj, .stl, .ply, .gltf, .glb), tetrahedra (.msh, .node, .ele, .mesh), a baked body (.frangible) or a scene (.toml)",
        .0.display()
    )]
    UnknownKind(PathBuf),
    /// A mesh that is implausibly large or small.
    #[error(
        "with the metre as the unit of `{}`, the body is {longest} m long; give its longest side in metres, 0.001 to 3, for example --size {example} (in a scene file: size = {example})",
        path.display()
    )]
    Size {
        /// The mesh file.
        path: PathBuf,
        /// Its longest side in its own unit.
        longest: f64,
        /// A plausible size, m.
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
        "`{one}` and `{other}` overlap by {depth_mm:.1} mm at the start; change the `position` of one of them"
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
    #[error("the scene has {wanted} bodies, but {given} baked bodies were given; bake this scene")]
    BakedBodies {
        /// Bodies of the scene.
        wanted: usize,
        /// Baked bodies.
        given: usize,
    },
    /// A file of a baked body that cannot be read or written.
    #[error(transparent)]
    Asset(#[from] frangible::internals::AssetFileError),
    /// A baked body that cannot be changed to the requested material or size.
    #[error("{}: {source}{hint}", path.display())]
    Rescale {
        /// Its file.
        path: PathBuf,
        /// Reason.
        source: Box<frangible_bake::RescaleError>,
        /// Command that bakes the body again, or empty.
        hint: String,
    },
    /// Walls that more tetrahedra would resolve.
    #[error(
        "`{body}` has walls of {wall_mm:.3} mm, which need about {needed} tetrahedra; set --resolution {needed} (in a scene file: resolution = {needed})"
    )]
    ThinWalls {
        /// Name of the body.
        body: String,
        /// Their thickness, mm.
        wall_mm: f64,
        /// Number of tetrahedra that they need.
        needed: usize,
    },
    /// Walls that no allowed number of tetrahedra resolves.
    #[error(
        "`{body}` has walls of {wall_mm:.3} mm, too thin for a body of its size within the limit of {limit} tetrahedra; make them thicker, at least {least_mm:.1} mm"
    )]
    WaferWalls {
        /// Name of the body.
        body: String,
        /// Their thickness, mm.
        wall_mm: f64,
        /// Largest allowed number of tetrahedra.
        limit: usize,
        /// Thickness of walls that the limit allows, mm.
        least_mm: f64,
    },
    /// An unbaked body, in a build that cannot bake.
    #[error(
        "`{body}` is not baked, and this build cannot bake; give it as a baked body (.frangible)"
    )]
    NoBake {
        /// Name of the body.
        body: String,
    },
    /// The body could not be baked.
    #[error("baking failed: {0}")]
    Bake(#[from] frangible_bake::BakeError),
    /// The rigid-body world rejected its input.
    #[error("the simulation failed: {0}")]
    World(#[from] frangible_rapier::WorldError),
    /// The fracture model rejected its input.
    #[error(transparent)]
    Input(#[from] frangible::InputError),
    /// No such material.
    #[error(transparent)]
    Material(#[from] frangible::internals::UnknownMaterial),
}
