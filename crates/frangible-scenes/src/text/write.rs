//! A scene as TOML text that gives the same scene, bit for bit.

use std::fmt::{Display, Write};

use frangible::FractureConfig;
use frangible::glam::{Quat, Vec3};
use frangible::internals::DurationModel;
use frangible::internals::near_field::PlateTheory;

use super::support::support_text;
use super::values::{edit_text, list, material_text, number, quoted, shape_text, vector};
use super::weakness::{paint_text, patch_text};
use crate::body::{BodySpec, Place};
use crate::output::{Drawing, FileWish, Output};
use crate::projectile::{Projectile, ProjectileKind};
use crate::scene::{Adhesive, PieceSpec, Scene};
use crate::source::BodySource;
use frangible_bake::pieces::Method;
use frangible_mesh::PartChoice;

/// The scene as TOML text; reading it gives the same scene, bit for bit.
#[must_use]
pub fn scene_to_toml(scene: &Scene) -> String {
    let mut t = Text::default();
    t.line("name", quoted(&scene.name));
    t.line("summary", quoted(&scene.summary));
    t.line("seed", scene.seed);
    t.noted("duration", number(scene.duration), "s, at most");
    match &scene.floor {
        Some(material) => t.line("floor", quoted(material)),
        None => t.line("floor", false),
    }
    if let Some(strength) = scene.mortar {
        t.noted("mortar", number(strength), "Pa, between bodies that touch");
    }
    if let Some(Adhesive { strength, patch }) = scene.adhesive {
        let layer = format!(
            "{{ strength = {}, patch = {} }}",
            number(strength),
            number(patch)
        );
        t.noted("adhesive", layer, "Pa and m, bonds faces in patches");
    }
    t.noted(
        "look_from",
        vector(scene.look_from),
        "direction towards the camera; y is up",
    );
    for body in &scene.bodies {
        t.table("[[body]]");
        write_body(&mut t, body);
    }
    for projectile in &scene.projectiles {
        t.table("[[projectile]]");
        write_projectile(&mut t, projectile, &scene.bodies);
    }
    write_fracture(&mut t, &scene.fracture);
    write_pieces(&mut t, &scene.pieces);
    write_output(&mut t, &scene.output);
    t.0
}

/// Lines of TOML. Writing to a string cannot fail.
#[derive(Default)]
struct Text(String);

impl Text {
    fn line(&mut self, key: &str, value: impl Display) {
        let _ = writeln!(self.0, "{key} = {value}");
    }

    fn noted(&mut self, key: &str, value: impl Display, note: &str) {
        let _ = writeln!(self.0, "{key} = {value} # {note}");
    }

    fn table(&mut self, header: &str) {
        let _ = writeln!(self.0, "\n{header}");
    }
}

fn write_pieces(t: &mut Text, pieces: &PieceSpec) {
    if *pieces == PieceSpec::default() {
        return;
    }
    t.table("[pieces]");
    t.noted(
        "generations",
        pieces.generations,
        "of pieces that break again",
    );
    t.noted("least_mass", number(pieces.least_mass), "kg");
    let method = match pieces.method {
        Method::ParentModes => "parent_modes",
        Method::Reanalysis => "reanalysis",
        _ => "auto",
    };
    t.line("method", quoted(method));
}

fn write_body(t: &mut Text, body: &BodySpec) {
    t.line("name", quoted(&body.name));
    let own_material = match &body.source {
        BodySource::Shape(shape) => {
            t.line("shape", shape_text(shape));
            if let Some(tets) = body.resolution {
                t.noted("resolution", tets, "tetrahedra of the fracture mesh");
            }
            true
        }
        BodySource::Ready { name, resolution } => {
            t.line("shape", quoted(name));
            if let Some(tets) = resolution {
                t.noted("resolution", tets, "tetrahedra of the fracture mesh");
            }
            true
        }
        BodySource::Mesh {
            path,
            size,
            up,
            resolution,
            wall,
            parts,
        } => {
            t.line("mesh", quoted(&path.to_string_lossy()));
            if let Some(size) = size {
                t.noted("size", number(*size), "m, the longest side");
            }
            t.line("up", quoted(up.name()));
            if let Some(wall) = wall {
                t.noted("wall", number(*wall), "m, thickness along the surface");
            }
            match parts {
                PartChoice::Auto => {}
                PartChoice::Separate => t.line("parts", quoted("separate")),
                PartChoice::Largest => t.line("parts", quoted("largest")),
                PartChoice::Weld { gap } => {
                    t.line("parts", quoted("weld"));
                    if let Some(gap) = gap {
                        t.noted("gap", number(*gap), "m, the widest that is welded");
                    }
                }
                PartChoice::Only(name) => t.line("part", quoted(name)),
            }
            if let Some(tets) = resolution {
                t.noted("resolution", tets, "tetrahedra of the fracture mesh");
            }
            true
        }
        BodySource::Asset(path) => {
            t.line("asset", quoted(&path.to_string_lossy()));
            if let Some(size) = body.rescale.size {
                t.noted("size", number(size), "m, the longest side");
            }
            if let Some(edit) = &body.rescale.material {
                t.line("material", edit_text(edit));
            }
            false
        }
    };
    if own_material {
        t.line("material", material_text(&body.material));
        t.line("modes", body.modes);
        if let Some(followed) = body.followed {
            t.noted(
                "followed",
                followed,
                "integrated through time, the rest static",
            );
        }
    }
    let (position, height) = match body.place {
        Place::Standing { over } => (Some(over.to_vec()), None),
        Place::Above { height, over } => (Some(over.to_vec()), Some(height)),
        Place::Centre(p) => (Some(p.to_array().to_vec()), None),
    };
    if let Some(position) = position.filter(|p| p.iter().any(|x| x.to_bits() != 0) || p.len() > 2) {
        t.noted("position", list(&position), "m");
    }
    if let Some(height) = height {
        t.noted(
            "drop",
            number(height),
            "m from the floor to its lowest point",
        );
    }
    if body.rotation != Quat::IDENTITY {
        let q = list(&body.rotation.to_array());
        t.line("rotation", format!("{{ quaternion = {q} }}"));
    }
    if body.velocity != Vec3::ZERO {
        t.noted("velocity", vector(body.velocity), "m/s");
    }
    if body.spin != Vec3::ZERO {
        t.noted("spin", vector(body.spin), "rad/s");
    }
    if !body.supports.is_empty() {
        let all: Vec<String> = body.supports.iter().map(support_text).collect();
        t.line("supports", format!("[{}]", all.join(", ")));
    }
    if !(body.weakness.is_empty() && body.paint.is_empty()) {
        let paint = body.paint.iter().map(paint_text);
        let all: Vec<String> = paint.chain(body.weakness.iter().map(patch_text)).collect();
        t.line("weakness", format!("[\n  {},\n]", all.join(",\n  ")));
    }
    if let Some(modulus) = body.weibull_modulus {
        t.line("weibull_modulus", number(modulus));
    }
    if let Some(specimen) = body.specimen {
        t.line("specimen", number(specimen));
    }
    if let Some(fatigue) = body.fatigue {
        let [exponent, rate, increase] =
            [fatigue.exponent, fatigue.rate, fatigue.increase].map(number);
        t.line(
            "fatigue",
            format!("{{ exponent = {exponent}, rate = {rate}, increase = {increase} }}"),
        );
    }
}

fn write_projectile(t: &mut Text, projectile: &Projectile, bodies: &[BodySpec]) {
    t.line("kind", quoted(projectile.kind.name()));
    t.noted("mass", number(projectile.mass), "kg");
    t.noted("radius", number(projectile.radius), "m");
    if let ProjectileKind::Hammer { crown } = projectile.kind {
        t.noted("crown", number(crown), "m, radius of curvature of the face");
    }
    t.noted("speed", number(projectile.speed), "m/s");
    t.line("material", quoted(&projectile.material));
    if let (true, Some(target)) = (bodies.len() > 1, bodies.get(projectile.target)) {
        t.line("target", quoted(&target.name));
    }
    t.noted("at", vector(projectile.at), "m from the centre of mass");
    t.line("toward", vector(projectile.toward));
    if projectile.delay > 0.0 {
        t.noted("delay", number(projectile.delay), "s before it starts");
    }
    if let Some(stays) = projectile.stays {
        t.noted("stays", number(stays), "s before it is removed");
    }
}

fn write_fracture(t: &mut Text, config: &FractureConfig) {
    let default = FractureConfig::default();
    if *config == default {
        return;
    }
    t.table("[fracture]");
    if *config == FractureConfig::as_in_the_paper() {
        t.line("model", quoted("paper"));
        return;
    }
    if config.is_paper() {
        t.line("model", quoted("paper"));
    }
    match config.duration {
        DurationModel::ModalHertz => t.line("duration", quoted("modal_hertz")),
        DurationModel::AsPrinted { c } => {
            t.line(
                "duration",
                format!("{{ as_printed = {{ c = {} }} }}", number(c)),
            );
        }
        DurationModel::Hertz => t.line("duration", quoted("hertz")),
        _ => t.line("duration", quoted("integrated")),
    }
    t.line("residual", config.residual);
    let near_field = match config.near_field {
        None => "off",
        Some(PlateTheory::Kirchhoff) => "kirchhoff",
        Some(PlateTheory::Layer) => "layer",
    };
    t.line("near_field", quoted(near_field));
    t.line("admissible_duration", config.admissible_duration);
    t.line("samples_per_period", number(config.samples_per_period));
    t.line("crumb_share", number(config.crumb_share));
    t.line("load_duration", number(config.load_duration));
    t.line("culling", config.culling);
    t.line("sized_flaws", config.sized_flaws);
}

fn write_output(t: &mut Text, output: &Output) {
    if *output == Output::default() {
        return;
    }
    t.table("[output]");
    for (key, wish) in [
        ("glb", &output.glb),
        ("wav", &output.wav),
        ("picture", &output.picture),
        ("contact_sheet", &output.contact_sheet),
        ("json", &output.json),
    ] {
        match wish {
            FileWish::No => t.line(key, false),
            FileWish::Yes => t.line(key, true),
            FileWish::Named(name) => t.line(key, quoted(name)),
        }
    }
    t.line("seeds", output.seeds);
    match output.drawing {
        Drawing::Full => {}
        Drawing::Light => t.line("drawing", quoted("light")),
        Drawing::Fine => t.line("drawing", quoted("fine")),
    }
}
