//! Whether the arrays of an asset fit together: linear in their size, since every new body asks.

use glam::Vec3;

use super::{Asset, EmbeddedPoint, RenderSurface, SurfaceWalls};
use crate::error::InputError;
use crate::mesh::{FACES, MassProperties, NO_NEIGHBOUR, TetMesh};

/// What is wrong, as a clause.
type Check = Result<(), String>;

impl Asset {
    /// Checks that all arrays fit together, that every index names something, that every number is finite
    /// and that every tetrahedron is right-handed. Linear in the size of the asset.
    ///
    /// # Errors
    /// [`InputError::Asset`] with the first array at fault.
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
                "it is that of a piece, which lives as long as its body; keep the asset that the piece came from, \
                 `Asset::root`, and replay its impacts"
                    .into(),
            );
        }
        mass(&self.mass)?;
        tetrahedra(&self.fracture)?;
        neighbours(&self.fracture)?;
        self.check_surface()?;
        self.check_analysis()?;
        self.check_modes()?;
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
                    "surface triangle {t} names tetrahedron {tet} of {}",
                    mesh.tets.len()
                ));
            };
            let open = mesh.neighbours.get(tet as usize);
            let mut faces = FACES.iter().zip(open.into_iter().flatten());
            let is = |face: &[usize; 3]| face.iter().all(|&i| triangle.contains(&behind[i]));
            if !faces.any(|(face, &neighbour)| neighbour == NO_NEIGHBOUR && is(face)) {
                return Err(format!(
                    "surface triangle {t} is no outer face of tetrahedron {tet}, which it names"
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

    fn check_analysis(&self) -> Check {
        let analysis = &self.analysis;
        let (nodes, elements) = (analysis.nodes.len(), analysis.elements.len());
        finite("analysis node", &analysis.nodes)?;
        below("analysis element", &analysis.elements, nodes, "node")?;
        let gradients = analysis.barycentric_gradients.len();
        one_each("analysis element", elements, "gradient row", gradients)?;
        all(
            &analysis.barycentric_gradients,
            |g| g.iter().all(|g| g.is_finite()),
            |e| format!("a barycentric gradient of analysis element {e} is not finite"),
        )?;
        let (tets, centroids) = (self.fracture.tets.len(), self.embedding.tets.len());
        one_each("tetrahedron", tets, "embedded centroid", centroids)?;
        let nodes = self.fracture.positions.len();
        one_each("node", nodes, "embedded point", self.embedding.nodes.len())?;
        embedded("centroid", &self.embedding.tets, elements)?;
        embedded("node", &self.embedding.nodes, elements)
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
                "{stress} stress bounds are no whole rows of {modes} modes"
            ));
        }
        let clusters = stress / modes;
        all(
            &bounds.cluster_of_tet,
            |&c| (c as usize) < clusters,
            |e| format!("tetrahedron {e} is in a cluster that is not there, of {clusters}"),
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

    fn check_modes(&self) -> Check {
        let modes = &self.modes;
        let (count, rows) = (modes.count(), self.analysis.nodes.len().saturating_mul(3));
        if modes.shapes.len() != rows.saturating_mul(count) {
            return Err(format!(
                "mode shapes hold {} numbers, not {rows} × {count}",
                modes.shapes.len()
            ));
        }
        one_each("mode", count, "peak stress", modes.peak_stress.len())?;
        if modes.residual_modes > 0 && modes.residual_modes >= count {
            return Err(format!(
                "{} of its {count} modes are to answer statically, and none is left to follow; follow one at least",
                modes.residual_modes
            ));
        }
        all(
            &modes.eigenvalues,
            |&l| l.is_finite() && l > 0.0,
            |i| format!("the eigenvalue of mode {i} is not a finite number above zero"),
        )?;
        if !modes.eigenvalues.is_sorted() {
            return Err("the modes are not sorted by rising frequency".into());
        }
        all(
            &modes.peak_stress,
            |&p| p.is_finite() && p >= 0.0,
            |i| format!("the peak stress of mode {i} is not a finite number, zero or above"),
        )?;
        // A fold over a row has no early exit, so that the compiler can test many numbers at once.
        let mut shapes = modes.shapes.chunks(count.max(1));
        let bad = shapes.position(|row| !row.iter().fold(true, |ok, x| ok & x.is_finite()));
        bad.map_or(Ok(()), |row| {
            Err(format!("row {row} of the mode shapes is not finite"))
        })
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
            |i| format!("supported node {i} lies beyond the {nodes} nodes there are"),
        )?;
        let rising = supported.is_sorted_by(|a, b| a < b);
        rising
            .then_some(())
            .ok_or_else(|| "the supported nodes do not rise from one to the next".into())
    }
}

/// All three lists or none; infinity is a number like others here: no wall, no edge.
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

fn tetrahedra(mesh: &TetMesh) -> Check {
    if mesh.tets.is_empty() {
        return Err("it has no tetrahedra".into());
    }
    finite("node", &mesh.positions)?;
    below("tetrahedron", &mesh.tets, mesh.positions.len(), "node")?;
    let flat = (0..mesh.tets.len()).find(|&e| mesh.volume(e) <= 0.0);
    flat.map_or(Ok(()), |e| {
        Err(format!(
            "the volume of tetrahedron {e} is {} m³, not above zero",
            mesh.volume(e)
        ))
    })
}

/// Whoever names a neighbour is named by it, across the same three nodes.
fn neighbours(mesh: &TetMesh) -> Check {
    let tets = mesh.tets.len();
    one_each("tetrahedron", tets, "neighbour row", mesh.neighbours.len())?;
    for (e, (tet, row)) in mesh.tets.iter().zip(&mesh.neighbours).enumerate() {
        for (face, &other) in FACES.iter().zip(row) {
            if other == NO_NEIGHBOUR {
                continue;
            }
            let o = other as usize;
            let (Some(other_tet), Some(back)) = (mesh.tets.get(o), mesh.neighbours.get(o)) else {
                return Err(format!("tetrahedron {e} names neighbour {o} of {tets}"));
            };
            let same = |f: &[usize; 3]| {
                let theirs = f.map(|i| other_tet[i]);
                face.iter().all(|&i| theirs.contains(&tet[i]))
            };
            let returned = FACES.iter().zip(back);
            if o == e
                || !returned
                    .into_iter()
                    .any(|(f, &b)| b as usize == e && same(f))
            {
                return Err(format!(
                    "tetrahedra {e} and {o} do not name each other across one face"
                ));
            }
        }
    }
    Ok(())
}

fn embedded(what: &str, points: &[EmbeddedPoint], elements: usize) -> Check {
    all(
        points,
        |p| (p.element as usize) < elements,
        |i| {
            format!("embedded {what} {i} names an analysis element beyond the {elements} there are")
        },
    )?;
    let sound =
        |p: &EmbeddedPoint| p.barycentric.iter().all(|b| b.is_finite()) && p.offset.is_finite();
    all(points, sound, |i| {
        format!("embedded {what} {i} is not finite")
    })
}

fn render(surface: &RenderSurface) -> Check {
    let vertices = surface.positions.len();
    finite("render vertex", &surface.positions)?;
    finite("render normal", &surface.normals)?;
    all(
        &surface.uvs,
        |uv| uv.iter().all(|x| x.is_finite()),
        |v| format!("the texture coordinates of render vertex {v} are not finite"),
    )?;
    none_or_one_each("render vertex", vertices, "normal", surface.normals.len())?;
    none_or_one_each(
        "render vertex",
        vertices,
        "texture coordinate",
        surface.uvs.len(),
    )?;
    none_or_one_each("render vertex", vertices, "colour", surface.colors.len())?;
    all(
        &surface.colors,
        |color| color.iter().all(|x| (0.0..=1.0).contains(x)),
        |v| format!("the colour of render vertex {v} lies outside 0 to 1"),
    )?;
    below("render triangle", &surface.triangles, vertices, "vertex")?;
    let (triangles, materials) = (surface.triangles.len(), surface.materials.len());
    let numbers = surface.material_of_triangle.len();
    none_or_one_each("render triangle", triangles, "material number", numbers)?;
    all(
        &surface.material_of_triangle,
        |&m| (m as usize) < materials,
        |t| {
            format!(
                "the material number of render triangle {t} lies beyond the {materials} materials"
            )
        },
    )?;
    let unit = |x: &f32| (0.0..=1.0).contains(x);
    all(
        &surface.materials,
        |m| m.base_color.iter().all(unit) && unit(&m.metallic) && unit(&m.roughness),
        |m| format!("a number of render material {m} lies outside 0 to 1"),
    )
}

fn all<T>(rows: &[T], sound: impl Fn(&T) -> bool, problem: impl Fn(usize) -> String) -> Check {
    match rows.iter().position(|row| !sound(row)) {
        Some(at) => Err(problem(at)),
        None => Ok(()),
    }
}

fn finite(what: &str, points: &[Vec3]) -> Check {
    all(
        points,
        |p| p.is_finite(),
        |i| format!("{what} {i} is not finite"),
    )
}

fn below<const N: usize>(what: &str, rows: &[[u32; N]], limit: usize, named: &str) -> Check {
    all(
        rows,
        |row| row.iter().all(|&v| (v as usize) < limit),
        |i| format!("{what} {i} names a {named} beyond the {limit} there are"),
    )
}

fn one_each(of: &str, wanted: usize, what: &str, found: usize) -> Check {
    if found == wanted {
        return Ok(());
    }
    Err(format!(
        "it wants one {what} per {of}: {wanted}, not {found}"
    ))
}

fn none_or_one_each(of: &str, wanted: usize, what: &str, found: usize) -> Check {
    if found == 0 {
        Ok(())
    } else {
        one_each(of, wanted, what, found)
    }
}
