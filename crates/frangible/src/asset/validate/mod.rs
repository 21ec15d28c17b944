//! Checks that the arrays of an asset fit together: linear in their size, since every new body is checked.

mod elements;
mod meshes;
mod render;
mod rows;
mod state;

pub(crate) use elements::{analysis, embedded, modes};
use meshes::{neighbours, tetrahedra};
use render::render;
use rows::{Check, all, one_each};

use super::{Asset, SurfaceWalls};
use crate::error::InputError;
use crate::mesh::{FACES, MassProperties, NO_NEIGHBOUR};

impl Asset {
    /// Checks that all arrays fit together, that every index names something, that every number is finite
    /// and that every tetrahedron is right-handed. Linear in the size of the asset.
    ///
    /// # Errors
    /// [`InputError::Asset`] with the first array at fault.
    #[doc(hidden)]
    pub fn validate(&self) -> Result<(), InputError> {
        self.material.validate()?;
        self.check().map_err(|problem| InputError::Asset {
            asset: self.name.clone(),
            problem,
        })
    }

    fn check(&self) -> Check {
        if self.portion.is_some() {
            return Err(
                "it belongs to a piece, which exists only as long as its body; keep the asset that the piece came from, `Asset::root`, and replay its impacts"
                    .into(),
            );
        }
        mass(&self.mass)?;
        tetrahedra(&self.fracture)?;
        neighbours(&self.fracture)?;
        self.check_surface()?;
        self.check_elements()?;
        modes(&self.modes, self.analysis.nodes.len())?;
        self.check_peak_stress()?;
        self.check_bounds()?;
        self.check_cells()?;
        self.check_supported()?;
        self.render.as_ref().map_or(Ok(()), render)
    }

    fn check_surface(&self) -> Check {
        let (mesh, surface) = (&self.fracture, &self.surface);
        let count = surface.triangles.len();
        let faces = mesh.neighbours.iter().flatten();
        let outer = faces.filter(|&&n| n == NO_NEIGHBOUR).count();
        one_each("outer face", outer, "surface triangle", count)?;
        one_each("surface triangle", count, "tetrahedron", surface.tets.len())?;
        one_each(
            "surface triangle",
            count,
            "normal row",
            surface.normals.len(),
        )?;
        let radii = surface.curvature_radius.len();
        one_each("surface triangle", count, "curvature radius", radii)?;
        for (t, (triangle, &tet)) in surface.triangles.iter().zip(&surface.tets).enumerate() {
            let Some(behind) = mesh.tets.get(tet as usize) else {
                return Err(format!(
                    "surface triangle {t} refers to tetrahedron {tet}, but there are only {}",
                    mesh.tets.len()
                ));
            };
            let open = mesh.neighbours.get(tet as usize);
            let mut faces = FACES.iter().zip(open.into_iter().flatten());
            let is = |face: &[usize; 3]| face.iter().all(|&i| triangle.contains(&behind[i]));
            if !faces.any(|(face, &neighbour)| neighbour == NO_NEIGHBOUR && is(face)) {
                return Err(format!(
                    "surface triangle {t} is not an outer face of its tetrahedron {tet}"
                ));
            }
        }
        all(
            &surface.normals,
            |n| n.iter().all(|n| n.is_finite()),
            |t| format!("a normal of surface triangle {t} is not finite"),
        )?;
        all(
            &surface.curvature_radius,
            |&r| r > 0.0,
            |t| format!("the curvature radius of surface triangle {t} is not above zero"),
        )?;
        walls(&surface.walls, count)
    }

    fn check_elements(&self) -> Check {
        analysis(&self.analysis)?;
        let elements = self.analysis.elements.len();
        let (tets, centroids) = (self.fracture.tets.len(), self.embedding.tets.len());
        one_each("tetrahedron", tets, "embedded centroid", centroids)?;
        let nodes = self.fracture.positions.len();
        one_each("node", nodes, "embedded point", self.embedding.nodes.len())?;
        embedded("centroid", &self.embedding.tets, elements)?;
        embedded("node", &self.embedding.nodes, elements)
    }

    fn check_peak_stress(&self) -> Check {
        let peaks = &self.modes.peak_stress;
        one_each("mode", self.modes.count(), "peak stress", peaks.len())?;
        all(
            peaks,
            |&p| p.is_finite() && p >= 0.0,
            |i| format!("the peak stress of mode {i} is not a finite number, zero or above"),
        )
    }

    fn check_bounds(&self) -> Check {
        let (bounds, modes) = (&self.bounds, self.modes.count());
        if bounds.is_empty() && bounds.stress.is_empty() && bounds.gradient.is_empty() {
            return Ok(());
        }
        let (tets, numbers) = (self.fracture.tets.len(), bounds.cluster_of_tet.len());
        one_each("tetrahedron", tets, "cluster number", numbers)?;
        let (stress, gradient) = (bounds.stress.len(), bounds.gradient.len());
        one_each("stress bound", stress, "gradient bound", gradient)?;
        if modes == 0 || stress % modes != 0 {
            return Err(format!(
                "{stress} stress bounds are not a whole number of rows of {modes} modes"
            ));
        }
        let clusters = stress / modes;
        all(
            &bounds.cluster_of_tet,
            |&c| (c as usize) < clusters,
            |e| format!("tetrahedron {e} is in a cluster beyond the {clusters} that exist"),
        )?;
        for rows in [&bounds.stress, &bounds.gradient] {
            all(
                rows,
                |&x| x.is_finite() && x >= 0.0,
                |i| format!("stress bound {i} is not a finite number, zero or above"),
            )?;
        }
        Ok(())
    }

    fn check_cells(&self) -> Check {
        all(
            &self.cells,
            |c| !c.points.is_empty(),
            |c| format!("convex cell {c} has no points"),
        )?;
        all(
            &self.cells,
            |c| c.points.iter().all(|p| p.is_finite()),
            |c| format!("a point of convex cell {c} is not finite"),
        )?;
        let (tets, numbers) = (self.fracture.tets.len(), self.cell_of_tet.len());
        one_each("tetrahedron", tets, "cell number", numbers)?;
        all(
            &self.cell_of_tet,
            |&c| (c as usize) < self.cells.len(),
            |e| {
                format!(
                    "the cell number of tetrahedron {e} lies beyond the {} cells",
                    self.cells.len()
                )
            },
        )
    }

    fn check_supported(&self) -> Check {
        let (supported, nodes) = (&self.supported, self.fracture.positions.len());
        all(
            supported,
            |&v| (v as usize) < nodes,
            |i| format!("supported node {i} lies beyond the {nodes} nodes that exist"),
        )?;
        let rising = supported.is_sorted_by(|a, b| a < b);
        rising
            .then_some(())
            .ok_or_else(|| "the supported nodes are not in ascending order".into())
    }
}

/// Checks that there are all three lists or none; infinity is a number like others here: no wall, no edge.
fn walls(walls: &SurfaceWalls, triangles: usize) -> Check {
    if walls.is_empty() {
        return Ok(());
    }
    let lists = [
        ("wall thickness", &walls.thickness),
        ("wall stiffening", &walls.stiffening),
        ("wall margin", &walls.margin),
    ];
    for (what, list) in lists {
        one_each("surface triangle", triangles, what, list.len()).map_err(|problem| {
            format!("{problem}; give every list of its walls, or none of them")
        })?;
    }
    all(
        &walls.thickness,
        |&h| h > 0.0,
        |t| {
            format!(
                "the wall thickness of surface triangle {t} is {}, not above zero; give metres, or infinity where there is no wall",
                walls.thickness[t]
            )
        },
    )?;
    all(
        &walls.stiffening,
        |&k| k >= 0.0,
        |t| {
            format!(
                "the wall stiffening of surface triangle {t} is {}, not zero or above; give 0 for a flat wall",
                walls.stiffening[t]
            )
        },
    )?;
    all(
        &walls.margin,
        |&m| m >= 0.0,
        |t| {
            format!(
                "the wall margin of surface triangle {t} is {}, not zero or above; give infinity for a wall without an edge",
                walls.margin[t]
            )
        },
    )
}

fn mass(mass: &MassProperties) -> Check {
    for (what, value) in [("mass", mass.mass), ("volume", mass.volume)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(format!(
                "its {what} is {value}, not a finite number above zero"
            ));
        }
    }
    if !mass.centre.is_finite() {
        return Err("its centre of mass is not finite".into());
    }
    let inertia = &mass.inertia;
    let diagonal = [inertia.x_axis.x, inertia.y_axis.y, inertia.z_axis.z];
    if !inertia.is_finite() || diagonal.iter().any(|&i| i <= 0.0) || inertia.determinant() <= 0.0 {
        return Err("its inertia is not finite and positive about every axis".into());
    }
    Ok(())
}
