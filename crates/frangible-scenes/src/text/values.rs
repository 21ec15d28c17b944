//! Values as TOML text.

use std::fmt::Write;

use frangible::Material;
use frangible::glam::Vec3;
use frangible::internals::Laminate;
use frangible_bake::Shape;

use crate::rescale::MaterialEdit;

pub(super) fn shape_text(shape: &Shape) -> String {
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
        Shape::Pane(pane) => format!(
            "{{ pane = {{ size = {}, corner = {}, bow = {} }} }}",
            numbers(&pane.size),
            number(pane.corner),
            number(pane.bow),
        ),
        // Shapes of meshes have no text of their own: a scene names their file.
        _ => quoted("mesh"),
    }
}

/// Differences from a baked body's material, as text.
pub(super) fn edit_text(edit: &MaterialEdit) -> String {
    let texts = [("preset", &edit.preset), ("name", &edit.name)].into_iter();
    let texts = texts.filter_map(|(key, text)| Some(format!("{key} = {}", quoted(text.as_ref()?))));
    let numbers = MaterialEdit::KEYS.iter().zip(edit.numbers);
    let numbers = numbers.filter_map(|(key, value)| Some(format!("{key} = {}", number(value?))));
    let laminate = edit.laminate.map(|given| {
        let given = Laminate::KEYS.iter().zip(given);
        laminate_text(given.filter_map(|(key, value)| Some((*key, value?))))
    });
    let parts: Vec<String> = texts.chain(numbers).chain(laminate).collect();
    format!("{{ {} }}", parts.join(", "))
}

/// A laminate's numbers as text.
fn laminate_text<'a>(numbers: impl Iterator<Item = (&'a str, f64)>) -> String {
    let numbers = numbers.map(|(key, value)| format!("{key} = {}", number(value)));
    let numbers: Vec<String> = numbers.collect();
    format!("laminate = {{ {} }}", numbers.join(", "))
}

/// The preset's name, or the preset with what differs from it.
pub(super) fn material_text(material: &Material) -> String {
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
            ("branching_constant", m.branching_constant),
            ("roughness_amplitude", m.roughness_amplitude),
            ("roughness_wavelength", m.roughness_wavelength),
            ("crushing_pressure", m.crushing_pressure),
            ("restitution", m.restitution),
            ("friction", m.friction),
            ("residual_stress", m.residual_stress),
        ]
    };
    let differs = |ours: f64, theirs: f64| ours.to_bits() != theirs.to_bits();
    // One of these alone would change the others when it is read.
    let together = ["strength", "fracture_energy", "energy_depth"];
    let resists = differs(material.strength, preset.strength)
        || differs(material.fracture_energy, preset.fracture_energy)
        || differs(material.energy_depth, preset.energy_depth);
    for ((key, ours), (_, theirs)) in fields(material).into_iter().zip(fields(&preset)) {
        if differs(ours, theirs) || (resists && together.contains(&key)) {
            parts.push(format!("{key} = {}", number(ours)));
        }
    }
    if let Some(laminate) = material.laminate
        && material.laminate != preset.laminate
    {
        let numbers = Laminate::KEYS.into_iter().zip(laminate.numbers());
        parts.push(laminate_text(numbers));
    }
    format!("{{ {} }}", parts.join(", "))
}

pub(super) fn vector(v: Vec3) -> String {
    list(&v.to_array())
}

pub(super) fn list(values: &[f32]) -> String {
    let texts: Vec<String> = values.iter().map(|&x| single(x)).collect();
    format!("[{}]", texts.join(", "))
}

pub(super) fn numbers(values: &[f64]) -> String {
    let texts: Vec<String> = values.iter().map(|&x| number(x)).collect();
    format!("[{}]", texts.join(", "))
}

/// The shortest text that reads back as the same bits.
pub(super) fn number(value: f64) -> String {
    if value.is_nan() {
        "nan".into()
    } else {
        format!("{value:?}")
    }
}

/// The shortest text whose f64 rounds to the same f32.
pub(super) fn single(value: f32) -> String {
    let short = format!("{value:?}");
    let same = |x: f64| (x as f32).to_bits() == value.to_bits();
    if value.is_finite() && short.parse().is_ok_and(same) {
        short
    } else {
        number(f64::from(value))
    }
}

/// A TOML string in double quotes.
pub(super) fn quoted(text: &str) -> String {
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
