//! Asset to bytes.

use super::SaveOptions;
use super::drawn;
use super::sections::{self as s, Section};
use super::writer::Writer;
use crate::asset::half::{Half, half_scales};
use crate::asset::{Asset, EmbeddedPoint, Embedding};
use crate::material::Material;
use crate::mesh::MassProperties;

impl Asset {
    /// The asset as a file, as `docs/asset-format.md` describes it; [`Asset::from_bytes`] gives it back bit for bit.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        self.to_bytes_with(&SaveOptions::default())
    }

    /// The asset as bytes, in the form that the options ask for. Compact mode shapes come back as [`Asset::with_compact_shapes`] gives them.
    #[doc(hidden)]
    #[must_use]
    pub fn to_bytes_with(&self, options: &SaveOptions) -> Vec<u8> {
        let mut w = Writer::default();
        w.text(s::NAME, &self.name);
        w.text(s::MATERIAL_NAME, &self.material.name);
        w.rows(s::MATERIAL, &[material_numbers(&self.material)]);
        w.rows(s::MASS, &[mass_numbers(&self.mass)]);
        if self.material.residual_stress.to_bits() != 0 {
            w.rows(s::RESIDUAL_STRESS, &[self.material.residual_stress]);
        }
        if let Some(laminate) = &self.material.laminate {
            w.rows(s::LAMINATE, &[laminate.numbers()]);
        }
        w.rows(s::POSITIONS, &self.fracture.positions);
        w.rows(s::TETS, &self.fracture.tets);
        w.rows(s::NEIGHBOURS, &self.fracture.neighbours);
        w.rows(s::SURFACE_TRIANGLES, &self.surface.triangles);
        w.rows(s::SURFACE_TETS, &self.surface.tets);
        w.rows(s::SURFACE_NORMALS, &self.surface.normals);
        w.rows(s::SURFACE_CURVATURE, &self.surface.curvature_radius);
        let walls = &self.surface.walls;
        if !walls.is_empty() {
            w.rows(s::WALL_THICKNESS, &walls.thickness);
            w.rows(s::WALL_STIFFENING, &walls.stiffening);
            w.rows(s::WALL_MARGIN, &walls.margin);
        }
        w.rows(s::ANALYSIS_NODES, &self.analysis.nodes);
        w.rows(s::ANALYSIS_ELEMENTS, &self.analysis.elements);
        w.rows(s::ANALYSIS_GRADIENTS, &self.analysis.barycentric_gradients);
        let Embedding { tets, nodes } = &self.embedding;
        let of_tets = [s::TET_ELEMENTS, s::TET_BARYCENTRIC, s::TET_OFFSETS];
        embedded(&mut w, of_tets, tets);
        let of_nodes = [s::NODE_ELEMENTS, s::NODE_BARYCENTRIC, s::NODE_OFFSETS];
        embedded(&mut w, of_nodes, nodes);
        w.rows(s::EIGENVALUES, &self.modes.eigenvalues);
        if options.compact {
            let scales = half_scales(&self.modes);
            w.rows(s::HALF_SCALES, &scales);
            let shapes = self.modes.shapes.chunks(scales.len().max(1));
            let scaled: Vec<Half> = shapes
                .flat_map(|row| row.iter().zip(&scales))
                .map(|(x, scale)| Half::of(x / scale))
                .collect();
            w.rows(s::HALF_SHAPES, &scaled);
        } else {
            w.rows(s::MODE_SHAPES, &self.modes.shapes);
        }
        w.rows(s::PEAK_STRESS, &self.modes.peak_stress);
        w.rows(s::RESIDUAL_MODES, &[self.modes.residual_modes as u32]);
        // Rounded shapes have other bounds: they are found when a body is made.
        if !(self.bounds.is_empty() || options.compact) {
            w.rows(s::BOUND_CLUSTERS, &self.bounds.cluster_of_tet);
            w.rows(s::STRESS_BOUNDS, &self.bounds.stress);
            w.rows(s::GRADIENT_BOUNDS, &self.bounds.gradient);
        }
        w.each(
            s::CELL_SIZES,
            self.cells.iter().map(|c| c.points.len() as u32),
        );
        let points: Vec<_> = self.cells.iter().flat_map(|c| &c.points).copied().collect();
        w.rows(s::CELL_POINTS, &points);
        w.rows(s::CELL_OF_TET, &self.cell_of_tet);
        if self.is_supported() {
            w.rows(s::SUPPORTED, &self.supported);
        }
        if let Some(surface) = &self.render {
            drawn::encode(&mut w, surface);
        }
        w.finish()
    }
}

fn material_numbers(m: &Material) -> [f64; 15] {
    [
        m.youngs_modulus,
        m.poisson_ratio,
        m.density,
        m.stiffness_damping,
        m.mass_damping,
        m.strength,
        m.fracture_energy,
        m.energy_depth,
        m.weak_point_density,
        m.branching_constant,
        m.roughness_amplitude,
        m.roughness_wavelength,
        m.crushing_pressure,
        m.restitution,
        m.friction,
    ]
}

fn mass_numbers(m: &MassProperties) -> [f64; 14] {
    let [x, y, z] = m.centre.to_array();
    let [a, b, c, d, e, f, g, h, i] = m.inertia.to_cols_array();
    [m.mass, m.volume, x, y, z, a, b, c, d, e, f, g, h, i]
}

/// Returns true if all offsets are zero, to the bit.
fn are_unmoved(points: &[EmbeddedPoint]) -> bool {
    let bits = |p: &EmbeddedPoint| p.offset.to_array().map(f32::to_bits);
    points.iter().all(|p| bits(p) == [0; 3])
}

fn embedded(
    w: &mut Writer,
    [elements, barycentric, offsets]: [Section; 3],
    points: &[EmbeddedPoint],
) {
    w.each(elements, points.iter().map(|p| p.element));
    w.each(barycentric, points.iter().map(|p| p.barycentric));
    if !are_unmoved(points) {
        w.each(offsets, points.iter().map(|p| p.offset));
    }
}
