//! Fig. 6: how one crack runs through a coarse mesh.

use frangible::glam::Vec3;
use frangible::internals::{ElementTrace, TetMesh};
use image::RgbImage;

use super::coarse::{Broken, add_edges, bar};
use crate::figures::FigureError;
use crate::figures::draw::{Colour, INK, Look, Model, below, beside, crossing};
use crate::figures::figure::{Claim, Figure, Findings, Picture, Table};
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig6",
    title: "Fig. 6: propagation of one crack in a coarse mesh",
    shows: "above, the elements cut so far, from the one where the crack starts to the last; below, the crack's surface inside them. \"The neighbors \
            that cross the surface are added in a breadth-first search manner.\"",
    compute,
};

/// Shares of the crack drawn.
const SHARES: [f64; 4] = [0.0, 0.12, 0.4, 1.0];

const CUT: Colour = [0.80, 0.30, 0.04, 1.0];
const SURFACE: Colour = [0.10, 0.30, 0.62, 1.0];

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    workshop.tell("looking for a blow", 0.1);
    let broken = bar()?;
    let mesh = broken.asset.fracture();
    let crack = broken
        .trace
        .cracks
        .iter()
        .max_by_key(|elements| elements.len())
        .ok_or(FigureError::Nothing("no crack in the bar"))?;
    workshop.tell("drawing", 0.5);
    let (mut above, mut under) = (Vec::new(), Vec::new());
    for share in SHARES {
        let count = ((share * crack.len() as f64).round() as usize).clamp(1, crack.len());
        let label = if count == 1 {
            "1 element".into()
        } else {
            format!("{count} elements")
        };
        above.push(elements(&broken, &crack[..count], &label)?);
        under.push(surface(&broken, &crack[..count])?);
    }
    let depths = depths(mesh, crack);
    let ordered = depths.windows(2).filter(|w| w[0] <= w[1]).count();
    let connected = depths.iter().all(|d| *d < usize::MAX);
    let waves = depths
        .iter()
        .copied()
        .filter(|d| *d < usize::MAX)
        .max()
        .unwrap_or(0);
    let twice = crack.len() - {
        let mut tets: Vec<u32> = crack.iter().map(|e| e.tet).collect();
        tets.sort_unstable();
        tets.dedup();
        tets.len()
    };
    Ok(Findings {
        picture: Picture {
            image: below(&[beside(&above), beside(&under)]),
            caption: "elements cut, step by step, and the crack's surface in them".into(),
        },
        text: format!(
            "A porcelain bar of 160 × 60 × 50 mm in {} tetrahedra, hit from above by 0.2 kg of steel at {:.1} m/s, the paper's model; the elements in \
             the order in which `impact_traced` says they joined. The crack starts on the side that is stretched, away from the hit, and passes {} \
             elements in {waves} waves of neighbours. Its surface is straight, whatever the elements' faces do.",
            mesh.tets.len(),
            broken.speed,
            crack.len()
        ),
        claims: vec![
            Claim::new(
                "the neighbours of the cut elements are added breadth-first (of two elements that follow each other, the later is never nearer to the start)",
                format!("{ordered} of {} pairs", depths.len().saturating_sub(1)),
                connected && ordered + 1 == depths.len(),
            ),
            Claim::new(
                "every element is crossed by the surface, and cut once",
                format!(
                    "{} of {} crossed, {twice} twice",
                    crack
                        .iter()
                        .filter(|e| !crossing(mesh, e).is_empty())
                        .count(),
                    crack.len()
                ),
                twice == 0 && crack.iter().all(|e| !crossing(mesh, e).is_empty()),
            ),
        ],
        tables: vec![waves_table(&depths)],
    })
}

/// Distance of each element from the first, in steps across faces through elements that joined before it.
fn depths(mesh: &TetMesh, crack: &[ElementTrace]) -> Vec<usize> {
    let mut depths: Vec<usize> = Vec::with_capacity(crack.len());
    for (i, element) in crack.iter().enumerate() {
        let near = mesh.neighbours[element.tet as usize];
        let from = crack[..i]
            .iter()
            .zip(&depths)
            .filter(|(e, _)| near.contains(&e.tet));
        let nearest = from.map(|(_, d)| *d).min();
        depths.push(if i == 0 {
            0
        } else {
            nearest.map_or(usize::MAX, |d| d.saturating_add(1))
        });
    }
    depths
}

fn waves_table(depths: &[usize]) -> Table {
    let mut table = Table::new(["steps from the start", "elements added"]);
    let last = depths
        .iter()
        .copied()
        .filter(|d| *d < usize::MAX)
        .max()
        .unwrap_or(0);
    let spans = [
        (0, 0),
        (1, 1),
        (2, 2),
        (3, 5),
        (6, 10),
        (11, 20),
        (21, usize::MAX - 1),
    ];
    for (from, to) in spans.into_iter().filter(|(from, _)| *from <= last) {
        let count = depths.iter().filter(|d| (from..=to).contains(d)).count();
        let name = if from == to {
            from.to_string()
        } else {
            format!("{from} to {}", to.min(last))
        };
        table.row([name, count.to_string()]);
    }
    table
}

pub(super) const LOOK: Look = Look {
    from: Vec3::new(0.55, -1.0, 0.55),
    up: Vec3::Z,
    width: 495,
    height: 330,
};

fn frame(broken: &Broken) -> Model {
    let mut model = Model::default();
    let mesh = broken.asset.fracture();
    add_edges(
        &mut model,
        mesh,
        &broken.asset.surface().triangles,
        INK,
        1.8e-4,
    );
    model
}

fn elements(broken: &Broken, cut: &[ElementTrace], label: &str) -> Result<RgbImage, FigureError> {
    let mut model = frame(broken);
    let mesh = broken.asset.fracture();
    for element in cut {
        let x = mesh.corners(element.tet as usize);
        for [i, j, k] in [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]] {
            model.flat(CUT, [x[i], x[j], x[k]]);
        }
        for [i, j] in [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]] {
            model.bar(INK, [x[i], x[j]], 2.5e-4);
        }
    }
    Ok(Look {
        width: 247,
        height: 190,
        ..LOOK
    }
    .at(&model, label)?)
}

fn surface(broken: &Broken, cut: &[ElementTrace]) -> Result<RgbImage, FigureError> {
    let mut model = frame(broken);
    for element in cut {
        for triangle in crossing(broken.asset.fracture(), element) {
            model.sheet(SURFACE, triangle);
            let [a, b, c] = triangle;
            for edge in [[a, b], [b, c], [c, a]] {
                model.bar(INK, edge, 1.2e-4);
            }
        }
    }
    Ok(Look {
        width: 247,
        height: 190,
        ..LOOK
    }
    .at(&model, "its surface")?)
}
