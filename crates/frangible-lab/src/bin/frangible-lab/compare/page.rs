//! `docs/compare.md`: the methods and their results. Every sentence about an outcome is made from its numbers.

use std::fmt::Write;

use frangible_compare::{DEFAULT_SITES, DEFAULT_STEP, Method};

use super::report::{CompareReport, MethodReport};

/// Scenes of the page.
pub(crate) const SCENES: [&str; 5] = ["glass", "pane", "vase", "rabbit", "piggy-bank"];

/// The page. `pictures`: folder of its pictures.
pub(crate) fn page(reports: &[CompareReport], pictures: &str) -> String {
    let mut text = introduction();
    text.push_str("\n## What one sees\n\n");
    for line in summary(reports) {
        let _ = writeln!(text, "- {line}");
    }
    for report in reports {
        let _ = write!(
            text,
            "\n## {0}\n\n![the impact, and the pieces of five methods, drawn apart]({pictures}/{0}.png)\n\n{1}.\n\n{2}\n{3}\n",
            report.scene,
            report.impact(),
            report.markdown(),
            sentences(report).join(" ")
        );
    }
    text
}

fn introduction() -> String {
    let step = 1e3 * DEFAULT_STEP;
    format!(
        "# One impact, five methods

Written by `frangible-lab compare --write docs`, pictures, tables and sentences alike. The first blow that breaks something in a scene is
given to five methods; `frangible-lab compare --scene NAME` does it with any scene. The pieces of every method tile the body (their
volumes sum up to its own within rounding), and the same seed gives the same pieces. Code: `crates/frangible-compare`.

| method | stress from | parts along | asks for strength | asks for energy |
|---|---|---|---|---|
| ours | the vibration, step by step | implicit surfaces that the stress steers | yes | yes |
| quasi-static | a steady state: the impulse as a force over {step:.2} ms | the same | yes | yes |
| element faces | the vibration at its worst moment | faces of the fracture mesh | yes | yes |
| Voronoi by energy | the vibration at its most strained moment | cells of {DEFAULT_SITES} sites drawn by strain energy | no | yes |
| Voronoi at impact | nothing | cells of sites drawn around the impact | no | no |

- **Ours** is `impact`, as the world calls it.
- **Quasi-static**, after Müller, McMillan, Dorsey, Jagnow (*Real-time simulation of deformation and fracture of stiff materials*, 2001)
  and the upper row of the paper's Fig. 4: no contact model. The impulse becomes a force over a time step, here that of the scenes'
  rigid bodies, and the body is in the steady state under it (balanced by its inertia; Müller et al. anchor it) for that time. What the striker is
  made of does not matter, the step does (`--step`). Weak points, cracks and their energy are ours.
- **Element faces**, after Müller et al. 2001 and Smith, Witkin, Baraff (*Fast and controllable simulation of the shattering of brittle
  objects*, 2001): tetrahedra stay whole, faces between them open. Weak points above their strength start a plane each, the most stressed first; it opens
  the faces between neighbours whose middles it parts, as long as that can be paid, and takes the tension across it from what is near. Left
  out: Smith et al.'s solver and their weakening beside open faces; nothing happens in time.
- **Voronoi by energy**, after Zheng, James (*Rigid-body fracture sound with precomputed soundbanks*, 2010): sites are drawn by strain energy density, and
  no more surface is made than there is strain energy for. Here {DEFAULT_SITES} sites are drawn (`--sites`; theirs are drawn until the energy is
  spent); two cells grow together where their border asks for more than it gets, G_c A against γ η A, and then, worst first, until
  all borders together ask for no more than the strain energy. Left out: their quasi-static solver (the moment is one of our vibration), their sequence
  of events within a contact, the sound.
- **Voronoi at impact** is what most tools do: sites around the impact point, their density falling to 1/e over a quarter of the largest
  distance, as many as ours has pieces (`--cells`). Parts of a cell that do not hang together are pieces of their own.

*Crack area*: one side; of cracks that part nothing too, where a method has such. *Energy*: crack area times G_c, asked for or not. *ms*: from
the contacts to the pieces, fastest of three runs on the machine that wrote this page, to be compared with one another only. Crumbs below 2e-4 of the volume stay
with a neighbour in all five. In the pictures, pieces are drawn apart.
"
    )
}

/// Rows of one method, scene by scene, with that of ours.
fn rows(
    reports: &[CompareReport],
    method: Method,
) -> Vec<(&CompareReport, &MethodReport, &MethodReport)> {
    let rows = reports
        .iter()
        .filter_map(|report| Some((report, report.of(method)?, report.of(Method::Ours)?)));
    rows.collect()
}

/// Sentences on all scenes, with the number of scenes in which each holds.
fn summary(reports: &[CompareReport]) -> Vec<String> {
    let n = reports.len();
    let mut lines = Vec::new();
    let quasi = rows(reports, Method::QuasiStatic);
    let more = quasi
        .iter()
        .filter(|(_, r, ours)| r.crack_area_cm2 > ours.crack_area_cm2);
    let stored = |(report, r, _): &(&CompareReport, &MethodReport, &MethodReport)| {
        r.strain_energy_j / report.approach_energy_j
    };
    let beyond = quasi.iter().filter(|row| stored(row) > 1.0).count();
    let shares: Vec<String> = quasi
        .iter()
        .map(|row| format!("{:.2}", stored(row)))
        .collect();
    lines.push(format!(
        "A steady state has no duration of its own. Quasi-static initiation cracks more than ours in {} of {n} scenes; in {beyond} of them the steady state \
         holds more strain energy than the blow brings ({} times as much: {}).",
        more.count(),
        shares.join(", "),
        SCENES.join(", ")
    ));
    let faces = rows(reports, Method::Elements);
    let fewer = faces.iter().filter(|(_, r, ours)| r.pieces < ours.pieces);
    lines.push(format!(
        "Along element faces there are fewer pieces than with ours in {} of {n} scenes, and every crack face is jagged by the size of an element.",
        fewer.count()
    ));
    let energy = rows(reports, Method::EnergyVoronoi);
    let all = energy
        .iter()
        .filter(|(_, r, _)| r.pieces * 20 >= DEFAULT_SITES * 19);
    lines.push(format!(
        "Cells drawn by strain energy tend to be small where the body is strained. In {} of {n} scenes there are 95 pieces or more for 100 sites: nearly every border pays, and how many \
         there are is decided by how many sites are drawn.",
        all.count()
    ));
    let blind = rows(reports, Method::Voronoi);
    let dearer = blind
        .iter()
        .filter(|(_, r, ours)| r.energy_j > ours.energy_j);
    let beyond = blind
        .iter()
        .filter(|(_, r, ours)| r.energy_j > ours.strain_energy_j);
    lines.push(format!(
        "Voronoi cells around the impact know nothing of the blow. For about as many pieces they ask for more energy than ours in {} of {n} scenes, for more than there is strain energy \
         in {}; a tap breaks the body as well as a hammer.",
        dearer.count(),
        beyond.count()
    ));
    lines
}

/// Sentences on one scene.
fn sentences(report: &CompareReport) -> Vec<String> {
    let mut text = Vec::new();
    let Some(ours) = report.of(Method::Ours) else {
        return text;
    };
    text.push(format!(
        "Ours spends {:.3} J of the {:.2} J of strain energy that the vibration holds at most.",
        ours.energy_j, ours.strain_energy_j
    ));
    if let Some(row) = report.of(Method::QuasiStatic) {
        text.push(format!(
            "The steady state holds {:.2} J, the blow brings {:.2} J; it gives {} and {} the crack area of ours.",
            row.strain_energy_j,
            report.approach_energy_j,
            pieces(row),
            times(row.crack_area_cm2 / ours.crack_area_cm2)
        ));
    }
    if let Some(row) = report.of(Method::Elements) {
        text.push(format!(
            "Along element faces there are {}, with {} the crack area of ours.",
            pieces(row),
            times(row.crack_area_cm2 / ours.crack_area_cm2)
        ));
    }
    if let Some(row) = report.of(Method::EnergyVoronoi) {
        text.push(format!(
            "The {DEFAULT_SITES} cells drawn by strain energy leave {}, the largest of them {:.1} % of the body.",
            pieces(row),
            100.0 * row.largest_share
        ));
    }
    if let Some(row) = report.of(Method::Voronoi) {
        text.push(format!(
            "Cells around the impact ask for {:.3} J, {} what ours spends.",
            row.energy_j,
            times(row.energy_j / ours.energy_j)
        ));
    }
    text
}

fn pieces(row: &MethodReport) -> String {
    match row.pieces {
        1 => "no pieces (it held)".into(),
        n => format!("{n} pieces"),
    }
}

fn times(ratio: f64) -> String {
    format!("{ratio:.1} times")
}
