//! Schema of a scene file, key by key.

use serde::Deserialize;

use super::either::{AxisTable, MaterialChoice, RotationChoice, SwitchOrName};
use super::weakness::WeaknessTable;

/// A whole file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneTable {
    pub(super) name: Option<String>,
    pub(super) summary: Option<String>,
    pub(super) seed: Option<u64>,
    pub(super) duration: Option<f64>,
    pub(super) floor: Option<SwitchOrName>,
    pub(super) look_from: Option<[f64; 3]>,
    #[serde(default)]
    pub(super) body: Vec<BodyTable>,
    #[serde(default)]
    pub(super) projectile: Vec<ProjectileTable>,
    pub(super) fracture: Option<FractureTable>,
    pub(super) pieces: Option<PiecesTable>,
    pub(super) mortar: Option<f64>,
    pub(super) adhesive: Option<AdhesiveTable>,
    pub(super) output: Option<OutputTable>,
}

/// A `[[body]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BodyTable {
    pub(super) name: Option<String>,
    pub(super) shape: Option<ShapeTable>,
    pub(super) mesh: Option<String>,
    pub(super) asset: Option<String>,
    pub(super) size: Option<f64>,
    pub(super) resolution: Option<usize>,
    pub(super) wall: Option<f64>,
    pub(super) parts: Option<PartsName>,
    pub(super) gap: Option<f64>,
    pub(super) part: Option<String>,
    pub(super) up: Option<AxisTable>,
    pub(super) material: Option<MaterialChoice>,
    pub(super) modes: Option<usize>,
    pub(super) followed: Option<usize>,
    pub(super) position: Option<Vec<f64>>,
    pub(super) drop: Option<f64>,
    pub(super) rotation: Option<RotationChoice>,
    pub(super) velocity: Option<[f64; 3]>,
    pub(super) spin: Option<[f64; 3]>,
    #[serde(default)]
    pub(super) supports: Vec<SupportTable>,
    #[serde(default)]
    pub(super) weakness: Vec<WeaknessTable>,
    pub(super) weibull_modulus: Option<f64>,
    pub(super) specimen: Option<f64>,
    pub(super) fatigue: Option<FatigueTable>,
}

/// What becomes of the parts of a mesh.
#[derive(Clone, Copy, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(super) enum PartsName {
    Auto,
    Separate,
    Largest,
    Weld,
}

/// Static fatigue: strength falls with the time that a load lasts.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FatigueTable {
    pub(super) exponent: f64,
    pub(super) rate: f64,
    pub(super) increase: f64,
}

/// A ready shape by name, or `{ box = … }`, `{ pane = … }`, `{ revolution = … }`.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum ShapeTable {
    DrinkingGlass,
    Bowl,
    Vase,
    DinnerPlate,
    PiggyBank,
    Rabbit,
    Statuette,
    CoffeeCup,
    BrickSolid,
    HammerHead,
    WineGlass,
    Chandelier,
    Candelabrum,
    Coral,
    Box([f64; 3]),
    Pane(PaneTable),
    Revolution(Vec<StationTable>),
}

/// A pane with round corners, bent or flat.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PaneTable {
    pub(super) size: [f64; 3],
    #[serde(default)]
    pub(super) corner: f64,
    #[serde(default)]
    pub(super) bow: f64,
}

/// Adhesive that bonds bodies over their faces.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct AdhesiveTable {
    pub(super) strength: f64,
    pub(super) patch: f64,
}

/// A station of a profile.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StationTable {
    pub(super) outer: [f64; 2],
    pub(super) inner: [f64; 2],
    #[serde(default)]
    pub(super) corner: bool,
}

/// Support of a body: one region, and the axes along which it is held.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SupportTable {
    pub(super) below: Option<f64>,
    pub(super) above: Option<f64>,
    pub(super) side: Option<String>,
    pub(super) at: Option<f64>,
    pub(super) plane: Option<PlaneTable>,
    #[serde(rename = "box")]
    pub(super) cuboid: Option<[[f64; 3]; 2]>,
    pub(super) sphere: Option<SphereTable>,
    pub(super) group: Option<String>,
    pub(super) axes: Option<String>,
}

/// A plane; the part of the body behind it is held.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PlaneTable {
    pub(super) point: [f64; 3],
    pub(super) normal: [f64; 3],
}

/// A ball.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SphereTable {
    pub(super) centre: [f64; 3],
    pub(super) radius: f64,
}

/// A preset with some numbers changed; the keys are the fields of `frangible::Material`.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialTable {
    pub(super) preset: Option<String>,
    pub(super) name: Option<String>,
    pub(super) youngs_modulus: Option<f64>,
    pub(super) poisson_ratio: Option<f64>,
    pub(super) density: Option<f64>,
    pub(super) stiffness_damping: Option<f64>,
    pub(super) mass_damping: Option<f64>,
    pub(super) strength: Option<f64>,
    pub(super) fracture_energy: Option<f64>,
    pub(super) energy_depth: Option<f64>,
    pub(super) weak_point_density: Option<f64>,
    pub(super) branching_constant: Option<f64>,
    pub(super) roughness_amplitude: Option<f64>,
    pub(super) roughness_wavelength: Option<f64>,
    pub(super) crushing_pressure: Option<f64>,
    pub(super) restitution: Option<f64>,
    pub(super) friction: Option<f64>,
    pub(super) residual_stress: Option<f64>,
    pub(super) laminate: Option<LaminateTable>,
}

/// Plies and films of a laminated wall; what is missing is that of PVB. The keys are the fields of `Laminate`.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct LaminateTable {
    pub(super) plies: Option<f64>,
    pub(super) ply: Option<f64>,
    pub(super) interlayer: Option<f64>,
    pub(super) shear_modulus: Option<f64>,
    pub(super) strength: Option<f64>,
    pub(super) stretch: Option<f64>,
}

/// A rotation: about an axis by an angle, or a unit quaternion (x, y, z, w).
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RotationTable {
    pub(super) axis: Option<AxisTable>,
    pub(super) degrees: Option<f64>,
    pub(super) quaternion: Option<[f64; 4]>,
}

/// A `[[projectile]]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ProjectileTable {
    #[serde(default)]
    pub(super) kind: KindName,
    pub(super) mass: f64,
    pub(super) radius: f64,
    pub(super) speed: f64,
    pub(super) material: Option<String>,
    pub(super) crown: Option<f64>,
    pub(super) target: Option<String>,
    pub(super) at: Option<[f64; 3]>,
    pub(super) toward: Option<[f64; 3]>,
    pub(super) delay: Option<f64>,
    pub(super) stays: Option<f64>,
}

/// `[pieces]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct PiecesTable {
    pub(super) generations: Option<u32>,
    pub(super) least_mass: Option<f64>,
    pub(super) method: Option<MethodName>,
}

/// Method by which the modes of pieces are found.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum MethodName {
    Auto,
    ParentModes,
    Reanalysis,
}

/// Form of a projectile.
#[derive(Clone, Copy, Default, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
pub(super) enum KindName {
    #[default]
    Ball,
    Hammer,
}

/// `[fracture]`: what differs from the model that it names; the keys are the fields of `frangible::FractureConfig`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FractureTable {
    pub(super) model: Option<ModelName>,
    pub(super) duration: Option<DurationTable>,
    pub(super) admissible_duration: Option<bool>,
    pub(super) residual: Option<bool>,
    pub(super) near_field: Option<NearFieldName>,
    pub(super) samples_per_period: Option<f64>,
    pub(super) crumb_share: Option<f64>,
    pub(super) load_duration: Option<f64>,
    pub(super) culling: Option<bool>,
    pub(super) sized_flaws: Option<bool>,
}

/// Model that gives all switches and numbers that the table does not.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum ModelName {
    Ours,
    GivenImpulses,
    Paper,
}

/// Contact duration models.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(super) enum DurationTable {
    Integrated,
    Hertz,
    ModalHertz,
    AsPrinted { c: f64 },
}

/// Theory of the near field of a contact on a wall.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum NearFieldName {
    Off,
    Kirchhoff,
    Layer,
}

/// `[output]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OutputTable {
    pub(super) glb: Option<SwitchOrName>,
    pub(super) wav: Option<SwitchOrName>,
    pub(super) picture: Option<SwitchOrName>,
    pub(super) contact_sheet: Option<SwitchOrName>,
    pub(super) json: Option<SwitchOrName>,
    pub(super) seeds: Option<usize>,
    pub(super) drawing: Option<DrawingName>,
}

/// `drawing`.
#[derive(Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum DrawingName {
    Full,
    Light,
    Fine,
}
