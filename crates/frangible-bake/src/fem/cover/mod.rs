//! Quadratic elements of a regular lattice that covers a body without conforming to it, for shapes whose walls are too thin
//! for a conforming mesh of few elements.
//!
//! Stiffness and mass are integrated exactly over the body only, by cutting its tetrahedra along the planes of the
//! lattice. This is a Ritz method: frequencies converge from above as the number of elements increases.
//!
//! If two walls pass through the same cell of the lattice, the cell is duplicated for each of them. Barycentric coordinates of embedded points
//! may be slightly negative.

mod cut;
mod lattice;
mod moments;
mod size;
mod slivers;
mod springs;
mod topology;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::asset::{AnalysisMesh, EmbeddedPoint, Embedding};

use crate::error::{BakeError, positive};
use crate::fem::assembly::System;
use crate::fem::element::Elasticity;
use crate::fem::mass::Mass;
use crate::fem::pattern::Pattern;
use crate::fem::quadratic::QuadraticMesh;
use crate::mesh::{BodyMesh, barycentric_gradients, tet_volume};
use cut::{Parts, cut};
use lattice::{CELL_VOLUME, Cell, Frame, Lattice, in_sides};
use moments::Moments;
use size::choose_lattice;
use springs::add_springs;
use topology::{Fragment, Topology, face_pairs};

/// Stiffness and mass added to the whole of each element, as a share of the material's: keeps the nodes outside the
/// body from swinging (17 times the largest displacement of a glass without it, where slivers are kept).
const FICTITIOUS: f64 = 1e-8;

/// A cell whose volume is off by no more than this share is full: rounding of the cuts.
const FULL: f64 = 1e-9;

/// Relative error in the number of elements that will do.
const NEAR: f64 = 0.02;
/// Relative error in the number of elements that will do for a piece, where each attempt costs as much as a tenth of its modes.
const NEAR_OF_PIECE: f64 = 0.2;

/// A part of a piece's tetrahedron below this share of its element is integrated as if products of strains were quadratic in
/// it: the error goes with the fourth power of its size over the element's.
const SMALL: f64 = 1.0 / 24.0;

/// A lattice of quadratic elements that covers a body.
#[derive(Clone, Debug)]
pub struct Cover {
    /// The elements; they are duplicated where parts of the body are close but not connected.
    pub mesh: QuadraticMesh,
    /// Element that contains the centroid of each tetrahedron of the body.
    pub element_of_tet: Vec<u32>,
    /// Element that contains each node of the body.
    pub element_of_node: Vec<u32>,
    /// Side of the lattice's cubes, m; an element has a twelfth of their volume.
    pub side: f64,
    moments: Vec<Moments>,
}

impl Cover {
    /// Covers a body with `elements_wanted` elements to within a few per cent; the cubes are no smaller than a sixteenth of the
    /// body's longest edge.
    ///
    /// # Errors
    /// The body has no tetrahedra, a tetrahedron has no volume or an invalid node, or `elements_wanted` is 0.
    pub fn new(body: &BodyMesh, elements_wanted: usize) -> Result<Self, BakeError> {
        Self::of(body, &face_pairs(body), elements_wanted, false)
    }

    /// Covers a body whose tetrahedra are connected at `faces`, given as pairs of tetrahedra; elements on opposite sides of a
    /// crack are not connected.
    ///
    /// For speed at run time, the requested number of elements is met to within a fifth. The work runs on the calling thread
    /// only, since pieces are covered in parallel.
    ///
    /// # Errors
    /// Errors of [`Cover::new`].
    pub fn of_joined(
        body: &BodyMesh,
        faces: &[[u32; 2]],
        elements_wanted: usize,
    ) -> Result<Self, BakeError> {
        Self::of(body, faces, elements_wanted, true)
    }

    fn of(
        body: &BodyMesh,
        faces: &[[u32; 2]],
        elements_wanted: usize,
        piece: bool,
    ) -> Result<Self, BakeError> {
        positive("the number of elements wanted", elements_wanted as f64)?;
        let mut volume = 0.0;
        for (tet, nodes) in body.tets.iter().enumerate() {
            let there = nodes.iter().all(|&v| (v as usize) < body.positions.len());
            let of_tet = if there {
                tet_volume(body.corners(tet))
            } else {
                f64::NAN
            };
            if !(of_tet.is_finite() && of_tet > 0.0) {
                return Err(BakeError::Inverted {
                    tet,
                    volume: of_tet,
                });
            }
            volume += of_tet;
        }
        positive("the volume of the body, in m³,", volume)?;
        let near = if piece { NEAR_OF_PIECE } else { NEAR };
        let (lattice, topology) = choose_lattice(body, faces, volume, elements_wanted, near);
        let (elements, points) = topology.nodes(faces);
        let mesh = QuadraticMesh {
            positions: points.into_iter().map(|q| lattice.position(q)).collect(),
            elements,
        };
        Ok(Self {
            element_of_tet: elements_of_tets(body, &topology, &lattice),
            element_of_node: elements_of_nodes(body, &topology, &lattice),
            side: lattice.side,
            moments: integrate(body, &topology, &lattice, piece),
            mesh,
        })
    }

    /// Returns the elements in the format of the asset.
    #[must_use]
    pub fn analysis_mesh(&self) -> AnalysisMesh {
        self.mesh.stored()
    }

    /// Barycentric coordinates of a point in an element.
    fn barycentric(&self, element: u32, p: DVec3) -> [f64; 4] {
        let corners = self.mesh.corners(element as usize);
        let from_first = p - corners[0];
        let l = barycentric_gradients(corners).map(|g| g.dot(from_first));
        [1.0 - l[1] - l[2] - l[3], l[1], l[2], l[3]]
    }

    /// The first element that holds a point, on its faces too. Looks at all of them.
    pub(crate) fn element_at(&self, p: DVec3) -> Option<u32> {
        (0..self.mesh.elements.len() as u32)
            .find(|&e| self.barycentric(e, p).iter().all(|&l| l > -1e-9))
    }

    /// Locates the tetrahedra and nodes of the body in the elements. Barycentric coordinates are slightly
    /// negative where a sliver of the body is assigned to a neighbouring element.
    #[must_use]
    pub fn embedding(&self, body: &BodyMesh) -> Embedding {
        let embed = |element: u32, p: DVec3| EmbeddedPoint {
            element,
            barycentric: self.barycentric(element, p).map(|x| x as f32),
            offset: Vec3::ZERO,
        };
        let centroids = (0..body.tets.len()).map(|t| body.corners(t).iter().sum::<DVec3>() / 4.0);
        Embedding {
            tets: centroids
                .zip(&self.element_of_tet)
                .map(|(p, &e)| embed(e, p))
                .collect(),
            nodes: body
                .positions
                .iter()
                .zip(&self.element_of_node)
                .map(|(&p, &e)| embed(e, p))
                .collect(),
        }
    }
}

/// Assembles K and the consistent M of a covered body.
#[must_use]
pub fn assemble_cover(cover: &Cover, material: &Elasticity) -> System {
    assemble_supported_cover(cover, material, &BodyMesh::default(), &[])
}

/// Assembles the elements of a body with supported nodes.
///
/// `held` lists the fixed axes of each node of `body`, the covered body, or is empty. The supports are springs, as stiff as the
/// elements can resolve.
#[must_use]
pub fn assemble_supported_cover(
    cover: &Cover,
    material: &Elasticity,
    body: &BodyMesh,
    held: &[[bool; 3]],
) -> System {
    let mesh = &cover.mesh;
    let pattern = Pattern::new(mesh.positions.len(), &mesh.elements);
    let mut stiffness = vec![0.0; pattern.entries()];
    let mut mass = vec![0.0; pattern.blocks()];
    for (e, (element, moments)) in mesh.elements.iter().zip(&cover.moments).enumerate() {
        let gradients = barycentric_gradients(mesh.corners(e));
        pattern.add(
            &mut stiffness,
            element,
            &moments.stiffness(&gradients, material),
        );
        pattern.add_scalars(&mut mass, element, &moments.mass(), material.density);
    }
    add_springs(&mut stiffness, &pattern, cover, body, held, material);
    System {
        positions: mesh.positions.clone(),
        stiffness: pattern.matrix(stiffness),
        mass: Mass::Consistent(pattern.scalar_matrix(mass)),
    }
}

fn elements_of_tets(body: &BodyMesh, topology: &Topology, lattice: &Lattice) -> Vec<u32> {
    let holder = |t: usize| {
        let centroid = body.corners(t).iter().sum::<DVec3>() / 4.0;
        let cell = Cell::at(lattice.in_sides(centroid));
        let fragments = topology.of(t);
        let holds = fragments.iter().find(|f| f.cell == cell);
        // Within rounding of a plane the cell may have no part of the tetrahedron.
        let largest = || {
            fragments
                .iter()
                .max_by(|a, b| a.volume.total_cmp(&b.volume))
        };
        holds.or_else(largest).map_or(0, |f| f.element)
    };
    (0..body.tets.len()).map(holder).collect()
}

/// For each node the element that it lies deepest in, among those of the tetrahedra around it.
fn elements_of_nodes(body: &BodyMesh, topology: &Topology, lattice: &Lattice) -> Vec<u32> {
    let frames: Vec<Frame> = topology.cells.iter().map(|c| c.frame()).collect();
    let mut best = vec![(f64::NEG_INFINITY, 0); body.positions.len()];
    for (t, tet) in body.tets.iter().enumerate() {
        for fragment in topology.of(t) {
            let frame = &frames[fragment.element as usize];
            for &v in tet {
                let l = frame.barycentric(lattice.in_sides(body.positions[v as usize]));
                let depth = l.iter().copied().fold(f64::INFINITY, f64::min);
                let (deepest, element) = &mut best[v as usize];
                if depth > *deepest || (depth == *deepest && fragment.element < *element) {
                    (*deepest, *element) = (depth, fragment.element);
                }
            }
        }
    }
    best.into_iter().map(|b| b.1).collect()
}

/// Elements whose own cell the body fills: their integrals are those of the cell.
fn full_elements(topology: &Topology) -> Vec<bool> {
    let mut volumes = vec![0.0; topology.cells.len()];
    for f in &topology.fragments {
        if f.cell == topology.cells[f.element as usize] {
            volumes[f.element as usize] += f.volume;
        }
    }
    let full = |v: f64| (v / CELL_VOLUME - 1.0).abs() < FULL;
    volumes.into_iter().map(full).collect()
}

/// Moments of the body in each element, m³; the same on one thread and on several. Those of a piece are found on this
/// thread alone, and a little less exactly.
fn integrate(body: &BodyMesh, topology: &Topology, lattice: &Lattice, piece: bool) -> Vec<Moments> {
    /// Shares of the work: fixed, and summed in order, so that the bits do not depend on the number of threads.
    const SHARES: usize = 8;
    let cube = lattice.side.powi(3);
    let frames: Vec<Frame> = topology.cells.iter().map(|c| c.frame()).collect();
    let tets = body.tets.len();
    let full = &full_elements(topology);
    let done =
        |f: &Fragment| full[f.element as usize] && f.cell == topology.cells[f.element as usize];
    let share = &|number: usize| {
        let mut moments = vec![Moments::ZERO; frames.len()];
        let mut parts = Parts::default();
        for t in number * tets / SHARES..(number + 1) * tets / SHARES {
            let fragments = topology.of(t);
            if fragments.iter().all(done) {
                continue;
            }
            let x = body.corners(t).map(|p| lattice.in_sides(p));
            cut(x, &mut parts, &mut |cell, part, volume| {
                let mut with_cell = fragments.iter().filter(|f| f.cell == cell);
                if let Some(fragment) = with_cell.next().filter(|f| !done(f)) {
                    let e = fragment.element as usize;
                    let corners = part.map(|p| frames[e].barycentric(p));
                    if piece && volume < SMALL * CELL_VOLUME {
                        moments[e].add_small(corners, volume * cube);
                    } else {
                        moments[e].add(corners, volume * cube);
                    }
                }
            });
        }
        moments
    };
    let mut moments = vec![Moments::ZERO; frames.len()];
    for (e, moments) in moments.iter_mut().enumerate() {
        let corners = topology.cells[e].corners();
        let corners = corners.map(|c| frames[e].barycentric(in_sides(c)));
        let filled = if full[e] { 1.0 } else { 0.0 };
        moments.add(corners, (filled + FICTITIOUS) * CELL_VOLUME * cube);
    }
    let mut merge = |share: &[Moments]| moments.iter_mut().zip(share).for_each(|(a, b)| a.merge(b));
    // A browser's module has one thread.
    if piece || cfg!(target_family = "wasm") {
        (0..SHARES).for_each(|number| merge(&share(number)));
        return moments;
    }
    std::thread::scope(|scope| {
        let shares: Vec<_> = (0..SHARES)
            .map(|number| scope.spawn(move || share(number)))
            .collect();
        for share in shares {
            match share.join() {
                Ok(share) => merge(&share),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
    });
    moments
}
