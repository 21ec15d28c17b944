//! Report of `frangible-lab compare`: a table for people, JSON for scripts.

use std::fmt::Write;

use frangible_compare::{Broken, Method};
use frangible_lab::page::table;
use frangible_scenes::FirstBreak;
use serde::Serialize;

/// An impact, with the result of each method. SI units unless a name says otherwise.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct CompareReport {
    pub(crate) scene: String,
    pub(crate) seed: u64,
    pub(crate) body: String,
    pub(crate) material: String,
    /// Time of the impact, s.
    pub(crate) time_s: f64,
    pub(crate) contacts: usize,
    pub(crate) impulse_n_s: f64,
    pub(crate) approach_speed_m_s: f64,
    /// Kinetic energy of approach that the contacts took up, J.
    pub(crate) approach_energy_j: f64,
    pub(crate) volume_m3: f64,
    pub(crate) methods: Vec<MethodReport>,
    pub(crate) files: Vec<String>,
    pub(crate) notes: Vec<String>,
}

/// A method's row.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct MethodReport {
    pub(crate) method: &'static str,
    pub(crate) pieces: usize,
    pub(crate) largest_share: f64,
    pub(crate) crack_area_cm2: f64,
    pub(crate) between_pieces_cm2: f64,
    pub(crate) energy_j: f64,
    pub(crate) strain_energy_j: f64,
    pub(crate) milliseconds: f64,
    /// Σ of the pieces' volumes over that of the body, less one.
    pub(crate) volume_error: f64,
    #[serde(skip)]
    pub(crate) title: &'static str,
}

impl MethodReport {
    fn new(broken: &Broken, volume: f64) -> Self {
        let sum: f64 = broken.fragments.iter().map(|f| f.mass.volume).sum();
        let whole = broken.fragments.is_empty();
        Self {
            method: broken.method.name(),
            title: broken.method.title(),
            pieces: broken.pieces(),
            largest_share: broken.largest_share(),
            crack_area_cm2: 1e4 * broken.crack_area,
            between_pieces_cm2: 1e4 * broken.border_area,
            energy_j: broken.energy,
            strain_energy_j: broken.available,
            milliseconds: 1e3 * broken.seconds,
            volume_error: if whole { 0.0 } else { sum / volume - 1.0 },
        }
    }

    fn cells(&self) -> [String; 7] {
        let held = self.pieces == 1;
        [
            self.title.into(),
            if held {
                "held".into()
            } else {
                self.pieces.to_string()
            },
            format!("{:.1} %", 100.0 * self.largest_share),
            format!("{:.1}", self.crack_area_cm2),
            format!("{:.1}", self.between_pieces_cm2),
            format!("{:.4}", self.energy_j),
            format!("{:.0}", self.milliseconds),
        ]
    }
}

const HEADINGS: [&str; 7] = [
    "method",
    "pieces",
    "largest",
    "crack area, cm²",
    "between pieces, cm²",
    "energy, J",
    "ms",
];

impl CompareReport {
    pub(crate) fn new(scene: &str, seed: u64, found: &FirstBreak, all: &[Broken]) -> Self {
        let asset = found.body.asset();
        let hardest = found.contacts.iter().map(|c| c.approach_speed);
        let impulses = found.contacts.iter().map(|c| f64::from(c.impulse));
        let volume = asset.fracture().total_volume();
        Self {
            scene: scene.into(),
            seed,
            body: found.name.clone(),
            material: asset.material().name.clone(),
            time_s: found.time,
            contacts: found.contacts.len(),
            impulse_n_s: impulses.sum(),
            approach_speed_m_s: f64::from(hardest.fold(0.0, f32::max)),
            approach_energy_j: frangible::internals::contact::approach_energy(&found.contacts),
            volume_m3: asset.mass().volume,
            methods: all.iter().map(|b| MethodReport::new(b, volume)).collect(),
            files: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// The row of a method, if it was run.
    pub(crate) fn of(&self, method: Method) -> Option<&MethodReport> {
        self.methods.iter().find(|row| row.method == method.name())
    }

    /// The impact, in a line.
    pub(crate) fn impact(&self) -> String {
        let contacts = match self.contacts {
            1 => "one contact".into(),
            n => format!("{n} contacts"),
        };
        format!(
            "{}, {}, seed {}: {:.2} m/s, {:.3} N·s, {:.3} J, {contacts}",
            self.body,
            self.material,
            self.seed,
            self.approach_speed_m_s,
            self.impulse_n_s,
            self.approach_energy_j
        )
    }

    /// Text for the terminal.
    pub(crate) fn text(&self) -> String {
        let rows: Vec<[String; 7]> = self.methods.iter().map(MethodReport::cells).collect();
        let all = std::iter::once(HEADINGS.map(String::from)).chain(rows);
        let all: Vec<[String; 7]> = all.collect();
        let widths: [usize; 7] = std::array::from_fn(|column| {
            let cells = all.iter().map(|row| row[column].chars().count());
            cells.max().unwrap_or(0)
        });
        let mut text = format!("  {}\n", self.impact());
        for row in &all {
            text.push(' ');
            for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                let _ = match column {
                    0 => write!(text, " {cell:<width$}"),
                    _ => write!(text, "  {cell:>width$}"),
                };
            }
            text.push('\n');
        }
        for file in &self.files {
            let _ = writeln!(text, "  wrote {file}");
        }
        for note in &self.notes {
            let _ = writeln!(text, "  note  {note}");
        }
        text
    }

    /// The report as Markdown, without a heading.
    pub(crate) fn markdown(&self) -> String {
        let rows: Vec<Vec<String>> = self.methods.iter().map(|m| m.cells().into()).collect();
        table(&HEADINGS, &rows)
    }
}
