//! A scene as TOML text that gives the same scene, bit for bit.

use std::fmt::{Display, Write};

use frangible::glam::{Quat, Vec3};
use frangible::{CrackPath, CrackTiming, DurationModel, FractureConfig, Material};
use frangible_bake::Shape;

use crate::body::{BodySpec, Place, Support};
use crate::output::{FileWish, Output};
use crate::projectile::{Projectile, ProjectileKind};
use crate::scene::Scene;
use crate::source::BodySource;

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

fn write_body(t: &mut Text, body: &BodySpec) {
    t.line("name", quoted(&body.name));
    let own_material = match &body.source {
        BodySource::Shape(shape) => {
            t.line("shape", shape_text(shape));
            true
        }
        BodySource::Mesh {
            path,
            size,
            up,
            resolution,
        } => {
            t.line("mesh", quoted(&path.to_string_lossy()));
            if let Some(size) = size {
                t.noted("size", number(*size), "m, the longest side");
            }
            t.line("up", quoted(up.name()));
            if let Some(tets) = resolution {
                t.noted("resolution", tets, "tetrahedra of the fracture mesh");
            }
            true
        }
        BodySource::Asset(path) => {
            t.line("asset", quoted(&path.to_string_lossy()));
            false
        }
    };
    if own_material {
        t.line("material", material_text(&body.material));
        t.line("modes", body.modes);
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
}

fn write_fracture(t: &mut Text, config: &FractureConfig) {
    let default = FractureConfig::default();
    if *config == default {
        return;
    }
    t.table("[fracture]");
    match config.duration {
        DurationModel::ModalHertz => t.line("duration", quoted("modal_hertz")),
        DurationModel::AsPrinted { c } => {
            t.line(
                "duration",
                format!("{{ as_printed = {{ c = {} }} }}", number(c)),
            );
        }
        _ => t.line("duration", quoted("hertz")),
    }
    t.line("admissible_duration", config.admissible_duration);
    t.line("samples_per_period", number(config.samples_per_period));
    match config.timing {
        CrackTiming::TimeResolved {
            speed,
            release_reach,
        } => {
            let (speed, reach) = (number(speed), number(release_reach));
            let value =
                format!("{{ time_resolved = {{ speed = {speed}, release_reach = {reach} }} }}");
            t.line("timing", value);
        }
        _ => t.line("timing", quoted("instant")),
    }
    match config.path {
        CrackPath::Steered { turning_length } => {
            let length = number(turning_length);
            t.line(
                "path",
                format!("{{ steered = {{ turning_length = {length} }} }}"),
            );
        }
        _ => t.line("path", quoted("planar")),
    }
    t.line("crumb_share", number(config.crumb_share));
}

fn write_output(t: &mut Text, output: &Output) {
    if *output == Output::default() {
        return;
    }
    t.table("[output]");
    for (key, wish) in [
        ("glb", &output.glb),
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
}

fn shape_text(shape: &Shape) -> String {
    let ready = [
        ("drinking_glass", Shape::drinking_glass()),
        ("bowl", Shape::bowl()),
        ("vase", Shape::vase()),
        ("dinner_plate", Shape::dinner_plate()),
    ];
    if let Some((name, _)) = ready.iter().find(|(_, ready)| ready == shape) {
        return quoted(name);
    }
    match shape {
        Shape::Revolution { profile } => {
            let stations: Vec<String> = profile
                .iter()
                .map(|s| {
                    let corner = if s.corner { ", corner = true" } else { "" };
                    let (outer, inner) = (numbers(&s.outer), numbers(&s.inner));
                    format!("  {{ outer = {outer}, inner = {inner}{corner} }},\n")
                })
                .collect();
            format!("{{ revolution = [ # (r, z), m\n{}] }}", stations.concat())
        }
        Shape::Box { size } => format!("{{ box = {} }}", numbers(size)),
        // Shapes of meshes have no text of their own: a scene names their file.
        _ => quoted("mesh"),
    }
}

fn support_text(support: &Support) -> String {
    match support {
        Support::Below(z) => format!("{{ below = {} }}", number(*z)),
        Support::Box([low, high]) => {
            format!("{{ box = [{}, {}] }}", numbers(low), numbers(high))
        }
        Support::Sphere { centre, radius } => format!(
            "{{ sphere = {{ centre = {}, radius = {} }} }}",
            numbers(centre),
            number(*radius)
        ),
    }
}

/// The preset's name, or the preset with what differs from it.
fn material_text(material: &Material) -> String {
    let (preset, named) = match Material::preset(&material.name) {
        Ok(preset) => (preset, true),
        Err(_) => match Material::preset("glass") {
            Ok(glass) => (glass, false),
            Err(_) => return quoted(&material.name),
        },
    };
    if preset == *material {
        return quoted(&material.name);
    }
    let mut parts = vec![format!("preset = {}", quoted(&preset.name))];
    if !named || preset.name != material.name {
        parts.push(format!("name = {}", quoted(&material.name)));
    }
    let fields = |m: &Material| {
        [
            ("youngs_modulus", m.youngs_modulus),
            ("poisson_ratio", m.poisson_ratio),
            ("density", m.density),
            ("stiffness_damping", m.stiffness_damping),
            ("mass_damping", m.mass_damping),
            ("strength", m.strength),
            ("fracture_energy", m.fracture_energy),
            ("energy_depth", m.energy_depth),
            ("weak_point_density", m.weak_point_density),
            ("roughness_amplitude", m.roughness_amplitude),
            ("roughness_wavelength", m.roughness_wavelength),
            ("restitution", m.restitution),
            ("friction", m.friction),
        ]
    };
    for ((key, ours), (_, theirs)) in fields(material).into_iter().zip(fields(&preset)) {
        if ours.to_bits() != theirs.to_bits() {
            parts.push(format!("{key} = {}", number(ours)));
        }
    }
    format!("{{ {} }}", parts.join(", "))
}

fn vector(v: Vec3) -> String {
    list(&v.to_array())
}

fn list(values: &[f32]) -> String {
    let texts: Vec<String> = values.iter().map(|&x| single(x)).collect();
    format!("[{}]", texts.join(", "))
}

fn numbers(values: &[f64]) -> String {
    let texts: Vec<String> = values.iter().map(|&x| number(x)).collect();
    format!("[{}]", texts.join(", "))
}

/// The shortest text that reads back as the same bits.
fn number(value: f64) -> String {
    if value.is_nan() {
        "nan".into()
    } else {
        format!("{value:?}")
    }
}

/// The shortest text whose f64 rounds to the same f32.
fn single(value: f32) -> String {
    let short = format!("{value:?}");
    let same = |x: f64| (x as f32).to_bits() == value.to_bits();
    if value.is_finite() && short.parse().is_ok_and(same) {
        short
    } else {
        number(f64::from(value))
    }
}

/// A TOML string in double quotes.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
