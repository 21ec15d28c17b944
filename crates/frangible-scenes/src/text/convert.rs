//! Conversion of the keys of a file to a scene.

use std::path::Path;

use frangible::glam::Vec3;
use frangible::internals::DurationModel;
use frangible::internals::near_field::PlateTheory;
use frangible::{FractureConfig, Material};
use frangible_mesh::did_you_mean;

use super::body::body;
use super::either::SwitchOrName;
use super::schema::{
    DrawingName, DurationTable, FractureTable, KindName, MethodName, ModelName, NearFieldName,
    OutputTable, PiecesTable, ProjectileTable, SceneTable,
};
use crate::body::BodySpec;
use crate::check::Fault;
use crate::error::SceneError;
use crate::output::{Drawing, FileWish, Output};
use crate::projectile::{Projectile, ProjectileKind};
use crate::scene::{Adhesive, PieceSpec, Scene};
use frangible_bake::pieces::Method;

pub(super) fn scene(table: SceneTable, folder: &Path, name: &str) -> Result<Scene, Fault> {
    let name = table.name.unwrap_or_else(|| name.into());
    let count = table.body.len();
    let mut bodies: Vec<BodySpec> = Vec::with_capacity(count);
    for (i, entry) in table.body.into_iter().enumerate() {
        let usual = if count == 1 {
            name.clone()
        } else {
            format!("{name} {}", i + 1)
        };
        let body = body(entry, usual, folder).map_err(|fault| fault.of("body", i))?;
        if bodies.iter().any(|b| b.name == body.name) {
            let clash = format!("there are two bodies `{}`; rename one", body.name);
            return Err(Fault::new("name", SceneError::Clash(clash)).of("body", i));
        }
        bodies.push(body);
    }
    let mut projectiles = Vec::with_capacity(table.projectile.len());
    for (i, entry) in table.projectile.into_iter().enumerate() {
        projectiles.push(projectile(entry, &bodies).map_err(|fault| fault.of("projectile", i))?);
    }
    let floor = match table.floor {
        None | Some(SwitchOrName::Switch(true)) => Some("stone".to_string()),
        Some(SwitchOrName::Switch(false)) => None,
        Some(SwitchOrName::Name(material)) => {
            Some(preset("floor", &material).map(|floor| floor.name)?)
        }
    };
    Ok(Scene {
        name,
        summary: table.summary.unwrap_or_default(),
        bodies,
        projectiles,
        floor,
        seed: table.seed.unwrap_or(1),
        fracture: table
            .fracture
            .map_or_else(FractureConfig::default, fracture),
        pieces: table.pieces.map_or_else(PieceSpec::default, pieces),
        mortar: table.mortar,
        adhesive: table.adhesive.map(|layer| Adhesive {
            strength: layer.strength,
            patch: layer.patch,
        }),
        duration: table.duration.unwrap_or(8.0),
        look_from: table.look_from.map_or(Vec3::new(0.55, 0.5, 1.0), vector),
        output: table.output.map_or_else(Output::default, output),
    })
}

fn projectile(table: ProjectileTable, bodies: &[BodySpec]) -> Result<Projectile, Fault> {
    let kind = match (table.kind, table.crown) {
        (KindName::Ball, None) => ProjectileKind::Ball,
        (KindName::Ball, Some(_)) => {
            let clash = "a ball has no `crown`; set kind = \"hammer\", or remove it";
            return Err(Fault::new("crown", SceneError::Clash(clash.into())));
        }
        (KindName::Hammer, None) => ProjectileKind::HAMMER,
        (KindName::Hammer, Some(crown)) => ProjectileKind::Hammer { crown },
    };
    let target = match &table.target {
        None => 0,
        Some(name) => bodies.iter().position(|b| b.name == *name).ok_or_else(|| {
            let hint = did_you_mean(name, bodies.iter().map(|b| b.name.as_str()));
            let unknown = format!("there is no body `{}` to aim at{hint}", short(name));
            Fault::new("target", SceneError::Clash(unknown))
        })?,
    };
    let material = match table.material {
        None => "steel".into(),
        Some(name) => preset("material", &name)?.name,
    };
    Ok(Projectile {
        kind,
        mass: table.mass,
        radius: table.radius,
        speed: table.speed,
        material,
        target,
        at: table.at.map_or(Vec3::ZERO, vector),
        toward: table.toward.map_or(Vec3::NEG_Z, vector),
        delay: table.delay.unwrap_or(0.0),
        stays: table.stays,
    })
}

fn pieces(table: PiecesTable) -> PieceSpec {
    let mut spec = PieceSpec::default();
    set(&mut spec.generations, table.generations);
    set(&mut spec.least_mass, table.least_mass);
    let method = table.method.map(|name| match name {
        MethodName::Auto => Method::Auto,
        MethodName::ParentModes => Method::ParentModes,
        MethodName::Reanalysis => Method::Reanalysis,
    });
    set(&mut spec.method, method);
    spec
}

fn fracture(table: FractureTable) -> FractureConfig {
    let mut config = match table.model {
        None | Some(ModelName::Ours) => FractureConfig::default(),
        Some(ModelName::GivenImpulses) => FractureConfig::with_given_impulses(),
        Some(ModelName::Paper) => FractureConfig::as_in_the_paper(),
    };
    match table.duration {
        None => {}
        Some(DurationTable::Integrated) => config.duration = DurationModel::Integrated,
        Some(DurationTable::Hertz) => config.duration = DurationModel::Hertz,
        Some(DurationTable::ModalHertz) => config.duration = DurationModel::ModalHertz,
        Some(DurationTable::AsPrinted { c }) => config.duration = DurationModel::AsPrinted { c },
    }
    match table.near_field {
        None => {}
        Some(NearFieldName::Off) => config.near_field = None,
        Some(NearFieldName::Kirchhoff) => config.near_field = Some(PlateTheory::Kirchhoff),
        Some(NearFieldName::Layer) => config.near_field = Some(PlateTheory::Layer),
    }
    set(&mut config.residual, table.residual);
    set(&mut config.admissible_duration, table.admissible_duration);
    set(&mut config.samples_per_period, table.samples_per_period);
    set(&mut config.crumb_share, table.crumb_share);
    set(&mut config.load_duration, table.load_duration);
    set(&mut config.culling, table.culling);
    set(&mut config.sized_flaws, table.sized_flaws);
    config
}

fn output(table: OutputTable) -> Output {
    let mut output = Output::default();
    let wish = |given| match given {
        SwitchOrName::Switch(true) => FileWish::Yes,
        SwitchOrName::Switch(false) => FileWish::No,
        SwitchOrName::Name(name) => FileWish::Named(name),
    };
    set(&mut output.glb, table.glb.map(wish));
    set(&mut output.wav, table.wav.map(wish));
    set(&mut output.picture, table.picture.map(wish));
    set(&mut output.contact_sheet, table.contact_sheet.map(wish));
    set(&mut output.json, table.json.map(wish));
    set(&mut output.seeds, table.seeds);
    output.drawing = match table.drawing {
        Some(DrawingName::Light) => Drawing::Light,
        Some(DrawingName::Fine) => Drawing::Fine,
        Some(DrawingName::Full) | None => Drawing::Full,
    };
    output
}

pub(super) fn preset(key: &'static str, name: &str) -> Result<Material, Fault> {
    Material::preset(name).map_err(|error| Fault::new(key, error))
}

pub(super) fn set<T>(field: &mut T, given: Option<T>) {
    if let Some(given) = given {
        *field = given;
    }
}

pub(super) fn vector(v: [f64; 3]) -> Vec3 {
    Vec3::from_array(v.map(|x| x as f32))
}

/// A text of the file, cut for a message.
pub(super) fn short(text: &str) -> String {
    text.chars().take(60).collect()
}
