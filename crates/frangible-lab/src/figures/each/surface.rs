//! Fig. 10: a crack's surface against the mesh that it cuts.

use frangible::glam::{DVec3, Vec3};

use super::coarse::{Broken, add_edges, bar};
use super::propagation::LOOK;
use crate::figures::FigureError;
use crate::figures::draw::{Colour, INK, Look, Model, beside, crossing};
use crate::figures::figure::{Claim, Figure, Findings, Picture};
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig10",
    title: "Fig. 10: surface mesh and physical mesh",
    shows: "a coloured section \"that cut the body straight through the physical mesh. Although the visual mesh represents with fidelity the fracture \
            surfaces computed, the underlying physical mesh (in wire frame) is not updated.\"",
    compute,
};

const OUTSIDE: Colour = [0.66, 0.66, 0.64, 1.0];
const SECTION: Colour = [0.80, 0.30, 0.04, 1.0];

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    workshop.tell("looking for a blow", 0.1);
    let broken = bar()?;
    workshop.tell("drawing", 0.7);
    let look = Look {
        width: 498,
        height: 400,
        ..LOOK
    };
    let image = beside(&[
        look.at(&piece(&broken), "one piece, and the mesh")?,
        Look {
            from: facing(&broken) + 0.25 * Vec3::Z - 0.2 * Vec3::Y,
            ..look
        }
        .at(&section(&broken), "the section, and the elements it cuts")?,
    ]);
    let (surface, nodes) = deviations(&broken);
    let mesh = broken.asset.fracture();
    Ok(Findings {
        picture: Picture {
            image,
            caption: "a piece with its crack face, over the wire frame of the whole mesh".into(),
        },
        text: format!(
            "The bar of Fig. 6, in {} tetrahedra with edges of {:.1} mm: one of its two pieces, its crack face coloured, inside the edges of the mesh. The \
             edges go on behind the section: the mesh is the unbroken body's, only its edges carry cut points. Triangles of the section are \
             drawn with their edges: one or two per tetrahedron.",
            mesh.tets.len(),
            1e3 * mesh.mean_edge()
        ),
        claims: vec![Claim::new(
            "the section runs straight through the mesh and not along its faces (its points lie nearer to the crack's plane than a quarter of what \
             the nodes of the cut elements do, root mean square)",
            format!("{:.2} mm against {:.2} mm", 1e3 * surface, 1e3 * nodes),
            surface < 0.25 * nodes,
        )],
        tables: Vec::new(),
    })
}

/// The smaller piece in place, and the wire frame of the whole.
fn piece(broken: &Broken) -> Model {
    let mut model = Model::default();
    let mesh = broken.asset.fracture();
    add_edges(
        &mut model,
        mesh,
        &broken.asset.surface().triangles,
        [0.12, 0.13, 0.15, 1.0],
        1.6e-4,
    );
    if let Some(piece) = broken.fracture.fragments.last() {
        let centre = piece.mass.centre.as_vec3();
        let surface = &piece.mesh;
        for (i, triangle) in surface.triangles.iter().enumerate() {
            let corners = triangle.map(|v| centre + surface.positions[v as usize]);
            if i < surface.outer_triangles {
                model.flat(OUTSIDE, corners);
            } else {
                model.flat(SECTION, corners);
                let [a, b, c] = corners;
                for edge in [[a, b], [b, c], [c, a]] {
                    model.bar(INK, edge, 1.6e-4);
                }
            }
        }
    }
    model
}

/// Direction out of the crack face of the smaller piece.
fn facing(broken: &Broken) -> Vec3 {
    let centres = broken
        .fracture
        .fragments
        .iter()
        .map(|f| f.mass.centre.as_vec3());
    let [first, .., last] = centres.collect::<Vec<_>>()[..] else {
        return Vec3::X;
    };
    (first - last).normalize_or(Vec3::X)
}

/// The crack's surface, and the edges of the elements that it cuts.
fn section(broken: &Broken) -> Model {
    let mut model = Model::default();
    let mesh = broken.asset.fracture();
    let mut edges = std::collections::BTreeSet::new();
    for element in broken.trace.cracks.iter().flatten() {
        for triangle in crossing(mesh, element) {
            model.sheet(SECTION, triangle);
        }
        let nodes = mesh.tets[element.tet as usize];
        for (i, j) in (0..4).flat_map(|i| (i + 1..4).map(move |j| (i, j))) {
            edges.insert((nodes[i].min(nodes[j]), nodes[i].max(nodes[j])));
        }
    }
    for (v, w) in edges {
        let ends = [v, w].map(|v| mesh.positions[v as usize]);
        model.bar(INK, ends, 1.6e-4);
    }
    model
}

/// Root mean square distances from the plane of the longest crack, m: of its own points, and of the nodes of its elements.
fn deviations(broken: &Broken) -> (f64, f64) {
    let mesh = broken.asset.fracture();
    let Some(crack) = broken.trace.cracks.iter().max_by_key(|c| c.len()) else {
        return (0.0, 0.0);
    };
    let points: Vec<DVec3> = crack
        .iter()
        .flat_map(|e| crossing(mesh, e))
        .flatten()
        .map(|p| p.as_dvec3())
        .collect();
    let centre = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    // The mean normal of its triangles, all turned to one side.
    let mut normal = DVec3::ZERO;
    for [a, b, c] in crack.iter().flat_map(|e| crossing(mesh, e)) {
        let area = (b - a).cross(c - a).as_dvec3();
        normal += if area.dot(normal) < 0.0 { -area } else { area };
    }
    let normal = normal.normalize_or(DVec3::X);
    let rms = |points: &mut dyn Iterator<Item = DVec3>| {
        let (mut sum, mut count) = (0.0, 0.0);
        for p in points {
            sum += (p - centre).dot(normal).powi(2);
            count += 1.0;
        }
        (sum / f64::max(count, 1.0)).sqrt()
    };
    let mut nodes = crack
        .iter()
        .flat_map(|e| mesh.corners(e.tet as usize))
        .map(|p| p.as_dvec3());
    (rms(&mut points.iter().copied()), rms(&mut nodes))
}
