//! Output of `frangible modes`.

use std::f64::consts::TAU;
use std::fmt::Write;

use frangible::internals::stress::Symmetric3;
use frangible_bake::mode_field::mode_on_fracture_mesh;
use frangible_scenes::BakedBody;
use serde::Serialize;

use crate::mode_files::principal;

/// Figures of a body's modes; the lists have one entry per mode. SI units.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct ModeReport {
    pub(crate) name: String,
    pub(crate) material: String,
    pub(crate) mass_kg: f64,
    pub(crate) supported: bool,
    pub(crate) supported_nodes: usize,
    /// Motions without deformation, which are not among the modes. Not known of a held body that came baked.
    pub(crate) rigid_motions: Option<usize>,
    pub(crate) analysis_nodes: usize,
    pub(crate) analysis_elements: usize,
    pub(crate) fracture_nodes: usize,
    pub(crate) fracture_tets: usize,
    /// Known of bodies baked in this run.
    pub(crate) largest_residual: Option<f64>,
    pub(crate) strength_pa: f64,
    pub(crate) modes: usize,
    /// Natural frequencies, without damping.
    pub(crate) frequencies_hz: Vec<f64>,
    /// Share of the critical damping; from 1 on a mode creeps back and does not swing.
    pub(crate) damping_ratios: Vec<f64>,
    /// Largest principal stress at any node, as tension half a period earlier or later counts as well, per length of
    /// the largest displacement.
    pub(crate) peak_stress_pa_per_m: Vec<f64>,
    pub(crate) files: Vec<String>,
    pub(crate) notes: Vec<String>,
}

impl ModeReport {
    pub(crate) fn new(body: &BakedBody, files: Vec<String>, notes: Vec<String>) -> Self {
        let asset = &*body.asset;
        let modes = asset.modes();
        let all = 0..modes.count();
        let damping_ratio =
            |i: usize| modes.damping(i, asset.material()) / (2.0 * TAU * modes.frequency(i));
        // Not the asset's own bound: that is taken amid the tetrahedra, and misses the skin of a thin plate.
        let peak = |i: usize| {
            let field = mode_on_fracture_mesh(asset, i);
            let moved = field.largest_displacement().max(f32::MIN_POSITIVE);
            let stresses = field.stresses.iter().map(largest_tension);
            f64::from(stresses.fold(0.0, f32::max)) / f64::from(moved)
        };
        let free = (!asset.is_supported()).then_some(6);
        Self {
            name: asset.name().to_owned(),
            material: asset.material().name.clone(),
            mass_kg: asset.mass().mass,
            supported: asset.is_supported(),
            supported_nodes: asset.supported().len(),
            rigid_motions: body.report.as_ref().map(|r| r.rigid_motions).or(free),
            analysis_nodes: asset.analysis().nodes.len(),
            analysis_elements: asset.analysis().elements.len(),
            fracture_nodes: asset.fracture().positions.len(),
            fracture_tets: asset.fracture().tets.len(),
            largest_residual: body.report.as_ref().map(|r| r.max_residual),
            strength_pa: asset.material().strength,
            modes: modes.count(),
            frequencies_hz: all.clone().map(|i| modes.frequency(i)).collect(),
            damping_ratios: all.clone().map(damping_ratio).collect(),
            peak_stress_pa_per_m: all.map(peak).collect(),
            files,
            notes,
        }
    }

    /// Table for people: the first `listed` modes, and the range of the others.
    pub(crate) fn table(&self, listed: usize) -> String {
        let mut text = String::new();
        let mut row = |name: &str, value: String| {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "  {name:<15} {value}");
        };
        row("body", format!("{}, {}", self.name, self.material));
        row("mass", format!("{:.4} kg", self.mass_kg));
        row("supports", self.supports());
        let (first, last) = (self.frequencies_hz.first(), self.frequencies_hz.last());
        if let (Some(first), Some(last)) = (first, last) {
            let residual = self
                .largest_residual
                .map_or(String::new(), |r| format!(" (residual {r:.0e})"));
            row(
                "modes",
                format!(
                    "{}, {first:.1} to {last:.1} Hz{residual}, on {} quadratic elements",
                    self.modes, self.analysis_elements
                ),
            );
        }
        text += "\n  number   frequency   damping ratio            largest principal   reaches the strength at\n";
        for i in 0..listed.min(self.modes) {
            let per_metre = self.peak_stress_pa_per_m[i];
            let ratio = self.damping_ratios[i];
            let kind = if ratio < 1.0 { "damped" } else { "overdamped" };
            let _ = writeln!(
                text,
                "  {:>6}  {:>9.1} Hz  {ratio:<9.3e} {kind:<10} {:>10} MPa/mm   {:>12} mm",
                i + 1,
                self.frequencies_hz[i],
                digits(1e-9 * per_metre),
                digits(1e3 * self.strength_pa / per_metre.max(f64::MIN_POSITIVE)),
            );
        }
        if listed < self.modes {
            let overdamped = self.damping_ratios.iter().filter(|&&z| z >= 1.0).count();
            let _ = writeln!(
                text,
                "  and {} more; overdamped in total: {overdamped} (--json lists them all)",
                self.modes - listed
            );
        }
        text += "  stress per mm of the mode's largest displacement; last column: the largest displacement at which the stress reaches the strength\n\n";
        for (name, list) in [("wrote", &self.files), ("note", &self.notes)] {
            for value in list {
                let _ = writeln!(text, "  {name:<15} {value}");
            }
        }
        text
    }

    fn supports(&self) -> String {
        let motions = |count: usize| match count {
            0 => "no rigid-body mode left".to_string(),
            1 => "one rigid-body mode left, not listed".to_string(),
            n => format!("{n} rigid-body modes left, not listed"),
        };
        match (self.supported, self.rigid_motions) {
            (false, _) => "none: the body is free, its six rigid-body modes are not listed".into(),
            (true, None) => format!("at {} nodes", self.supported_nodes),
            (true, Some(n)) => format!("at {} nodes, {}", self.supported_nodes, motions(n)),
        }
    }
}

/// The largest eigenvalue of a stress or of its opposite, Pa.
fn largest_tension(stress: &Symmetric3) -> f32 {
    let opposite = Symmetric3 {
        diagonal: stress.diagonal.map(|s| -s),
        off: stress.off.map(|s| -s),
    };
    principal(stress).max(principal(&opposite))
}

/// Three digits, also of the very small and the very large.
fn digits(value: f64) -> String {
    match value.abs() {
        a if !(1e-3..1e5).contains(&a) => format!("{value:.2e}"),
        a if a >= 100.0 => format!("{value:.0}"),
        a if a >= 10.0 => format!("{value:.1}"),
        a if a >= 1.0 => format!("{value:.2}"),
        _ => format!("{value:.4}"),
    }
}
