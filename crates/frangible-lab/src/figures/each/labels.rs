//! Fig. 9: fragments as sets of nodes.

use std::collections::BTreeSet;

use frangible::glam::Vec3;
use frangible::internals::TetMesh;
use image::RgbImage;

use super::coarse::{Broken, add_edges, plate};
use crate::figures::FigureError;
use crate::figures::draw::{Colour, INK, LABELS, Look, Model, beside, surface_trace};
use crate::figures::figure::{Claim, Figure, Findings, Picture, Table};
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig9",
    title: "Fig. 9: fragments from marked elements",
    shows: "a block opened by two fractures: (a) the elements marked by each; (b) \"each region of nodes with the same ID forms a fragment\"; the thick \
            contours are the fracture surfaces, sampled on the edges of the marked elements.",
    compute,
};

const PLAIN: Colour = [0.62, 0.63, 0.65, 1.0];
const EDGE: Colour = [0.30, 0.31, 0.33, 1.0];

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    workshop.tell("looking for a blow", 0.1);
    let broken = plate()?;
    workshop.tell("drawing", 0.7);
    let image = beside(&[marks(&broken)?, regions(&broken)?]);
    let mesh = broken.asset.fracture();
    let (trace, fracture) = (&broken.trace, &broken.fracture);
    let own = components(&broken);
    let same = same_partition(&own, &trace.fragment_of_node);
    let count = own.iter().collect::<BTreeSet<_>>().len();
    let mut table = Table::new(["fragment", "nodes", "share of the volume"]);
    let whole: f64 = mesh.total_volume();
    for (i, fragment) in fracture.fragments.iter().enumerate() {
        let nodes = trace
            .fragment_of_node
            .iter()
            .filter(|l| **l as usize == i)
            .count();
        table.row([
            (i + 1).to_string(),
            nodes.to_string(),
            format!("{:.1} %", 100.0 * fragment.mass.volume / whole),
        ]);
    }
    Ok(Findings {
        picture: Picture {
            image,
            caption: "left, the elements of each crack; right, nodes coloured by fragment, with the cracks".into(),
        },
        text: format!(
            "A porcelain plate of 120 × 90 × 8 mm, one layer of {} tetrahedra, hit in its middle by 0.2 kg of steel at {:.1} m/s, the paper's model, seen \
             from above. Left: the elements of each of the {} cracks. Right: nodes coloured by fragment; elements whose nodes belong to several are \
             white, and the lines are the cracks on the upper face. An element is fractured by one crack only, so no element is marked twice as \
             in the paper's picture; a crack that meets another stops there.",
            mesh.tets.len(), broken.speed, trace.cracks.len()
        ),
        claims: vec![
            Claim::new(
                "fragments are found by flood filling the nodes (the same sets as those connected over edges that no crack cuts, found by another program)",
                format!("{} fragments, {count} sets, {}", fracture.fragments.len(), if same { "the same" } else { "not the same" }),
                same && count == fracture.fragments.len(),
            ),
            Claim::new(
                "the fragments are the body (volumes sum to its volume within 1e-6; no piece of its own where three cracks' edges meet)",
                format!("{:.0e}", fracture.report.volume_error.abs()),
                fracture.report.volume_error.abs() < 1e-6,
            ),
        ],
        tables: vec![table],
    })
}

/// The smallest node of each node's set: nodes connected over mesh edges that no crack cuts.
fn components(broken: &Broken) -> Vec<u32> {
    let mesh = broken.asset.fracture();
    let mut cut = BTreeSet::new();
    for element in broken.trace.cracks.iter().flatten() {
        let nodes = mesh.tets[element.tet as usize];
        for (i, j) in pairs() {
            if (element.values[i] < 0.0) != (element.values[j] < 0.0) {
                cut.insert((nodes[i].min(nodes[j]), nodes[i].max(nodes[j])));
            }
        }
    }
    let mut least: Vec<u32> = (0..mesh.positions.len() as u32).collect();
    // Passes until nothing changes: slow, and plainly right.
    loop {
        let mut changed = false;
        for tet in &mesh.tets {
            for (i, j) in pairs() {
                let (a, b) = (tet[i].min(tet[j]), tet[i].max(tet[j]));
                let low = least[a as usize].min(least[b as usize]);
                if !cut.contains(&(a, b)) && least[a as usize] != least[b as usize] {
                    least[a as usize] = low;
                    least[b as usize] = low;
                    changed = true;
                }
            }
        }
        if !changed {
            return least;
        }
    }
}

fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j)))
}

/// Returns true if two labellings divide the nodes alike.
fn same_partition(a: &[u32], b: &[u32]) -> bool {
    let both: BTreeSet<(u32, u32)> = a.iter().copied().zip(b.iter().copied()).collect();
    let labels = |list: &[u32]| list.iter().copied().collect::<BTreeSet<_>>().len();
    a.len() == b.len() && both.len() == labels(a) && both.len() == labels(b)
}

const LOOK: Look = Look {
    from: Vec3::new(0.0, -0.25, 1.0),
    up: Vec3::Y,
    width: 498,
    height: 400,
};

fn marks(broken: &Broken) -> Result<RgbImage, FigureError> {
    let mut crack_of_tet = vec![usize::MAX; broken.asset.fracture().tets.len()];
    for (crack, elements) in broken.trace.cracks.iter().enumerate() {
        for element in elements {
            crack_of_tet[element.tet as usize] = crack;
        }
    }
    let mut model = Model::default();
    paint(&mut model, broken, |tet| {
        let crack = crack_of_tet[tet as usize];
        if crack == usize::MAX {
            PLAIN
        } else {
            LABELS[crack % LABELS.len()]
        }
    });
    Ok(LOOK.at(&model, "elements by crack")?)
}

fn regions(broken: &Broken) -> Result<RgbImage, FigureError> {
    let mesh = broken.asset.fracture();
    let labels = &broken.trace.fragment_of_node;
    let mut model = Model::default();
    paint(&mut model, broken, |tet| {
        let l = mesh.tets[tet as usize].map(|v| labels[v as usize]);
        if l.iter().all(|x| *x == l[0]) {
            PLAIN
        } else {
            [0.95, 0.95, 0.95, 1.0]
        }
    });
    let edge = mesh.mean_edge();
    for triangle in &broken.asset.surface().triangles {
        for &v in triangle {
            let colour = LABELS[labels[v as usize] as usize % LABELS.len()];
            model.dot(colour, mesh.positions[v as usize], 0.16 * edge);
        }
    }
    lines(&mut model, broken, mesh);
    Ok(LOOK.at(&model, "nodes by fragment")?)
}

fn lines(model: &mut Model, broken: &Broken, mesh: &TetMesh) {
    for element in broken.trace.cracks.iter().flatten() {
        for line in surface_trace(mesh, element) {
            model.bar(INK, line, 5e-4);
        }
    }
}

/// The outside, each triangle in the colour of its tetrahedron, with its edges.
fn paint(model: &mut Model, broken: &Broken, colour: impl Fn(u32) -> Colour) {
    let (mesh, surface) = (broken.asset.fracture(), broken.asset.surface());
    for (triangle, &tet) in surface.triangles.iter().zip(&surface.tets) {
        model.flat(colour(tet), triangle.map(|v| mesh.positions[v as usize]));
    }
    add_edges(model, mesh, &surface.triangles, EDGE, 1.5e-4);
}
