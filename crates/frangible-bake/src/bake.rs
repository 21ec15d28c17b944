//! The front door: shape and material in, asset out.

use std::time::Instant;

use frangible::asset::{AnalysisMesh, Embedding};
use frangible::glam::DVec3;
use frangible::modal::ModalBasis;
use frangible::{Asset, MassProperties, Material, TetMesh};

use crate::cells::convex_cells;
use crate::eigen::lowest_modes;
use crate::embed::Locator;
use crate::error::BakeError;
use crate::fem::{Elasticity, Elements, QuadraticMesh, assemble};
use crate::mesh::barycentric_gradients;
use crate::peak_stress::peak_stress;
use crate::report::{BakeReport, MeshReport, Progress, Stage};
use crate::shapes::{MeshSize, Shape};
use crate::surface::outer_surface;

/// What to bake.
#[derive(Clone, Debug)]
pub struct BakeSpec {
    /// Name of the asset, shown in reports.
    pub name: String,
    /// Geometry.
    pub shape: Shape,
    /// Material; only E, ν and ρ matter to the modes, the rest is passed on.
    pub material: Material,
    /// Elements of the analysis mesh; `None`: about 3 000 of them.
    pub analysis: Option<MeshSize>,
    /// Elements of the fracture mesh; `None`: about 42 000 of them.
    pub fracture: Option<MeshSize>,
    /// Number of vibration modes, 1 and up, default 120. More modes resolve sharper impacts, at
    /// proportional cost in memory and time per step.
    pub modes: usize,
    /// Seed of the irregularity of the fracture mesh, default 1.
    pub seed: u64,
}

impl BakeSpec {
    /// Default sizes, modes and seed.
    #[must_use]
    pub fn new(name: impl Into<String>, shape: Shape, material: Material) -> Self {
        Self {
            name: name.into(),
            shape,
            material,
            analysis: None,
            fracture: None,
            modes: 120,
            seed: 1,
        }
    }
}

/// Bakes an asset: meshes the shape twice, finds its modes, and ties the two meshes together.
///
/// The body frame has its origin at the centre of mass of the fracture mesh and the axes of the shape.
///
/// # Errors
/// The first number, station, mode or point at fault; each message says how to mend it.
pub fn bake(
    spec: &BakeSpec,
    progress: &mut dyn FnMut(Progress),
) -> Result<(Asset, BakeReport), BakeError> {
    spec.material.validate()?;
    if spec.modes == 0 {
        return Err(BakeError::Modes {
            wanted: 0,
            available: usize::MAX,
        });
    }
    let mut clock = Clock {
        started: Instant::now(),
        seconds: Vec::new(),
        progress,
    };

    clock.enter(Stage::Mesh);
    let analysis_size = spec
        .analysis
        .map_or_else(|| spec.shape.analysis_size(), Ok)?;
    let fracture_size = spec
        .fracture
        .map_or_else(|| spec.shape.fracture_size(), Ok)?;
    let mut coarse = spec.shape.analysis_mesh(analysis_size)?;
    let mut fine = spec.shape.fracture_mesh(fracture_size, spec.seed)?;
    let corners = (0..fine.tets.len()).map(|e| fine.corners(e));
    let centre = MassProperties::of_tetrahedra(spec.material.density, corners).centre;
    coarse.translate(-centre);
    fine.translate(-centre);
    let fracture = TetMesh::new(
        fine.positions.iter().map(|p| p.as_vec3()).collect(),
        fine.tets.clone(),
    );
    // Of the mesh as stored, so that the masses of its pieces sum to it exactly.
    let corners = (0..fine.tets.len()).map(|e| fracture.corners(e).map(|p| p.as_dvec3()));
    let mut mass = MassProperties::of_tetrahedra(spec.material.density, corners);
    // Zero but for rounding: the frame is defined by it.
    mass.centre = DVec3::ZERO;
    let quadratic = QuadraticMesh::new(&coarse);

    clock.enter(Stage::Assemble);
    let elasticity = Elasticity::from(&spec.material);
    let system = assemble(
        &quadratic.positions,
        Elements::Quadratic(&quadratic.elements),
        &elasticity,
    );

    clock.enter(Stage::Modes);
    let modes = lowest_modes(&system, spec.modes, &mut |share| {
        (clock.progress)(Progress {
            stage: Stage::Modes,
            fraction: share,
        });
    })?;

    clock.enter(Stage::Embed);
    let locator = Locator::new(&quadratic);
    let centroids = (0..fine.tets.len()).map(|e| fine.corners(e).iter().sum::<DVec3>() / 4.0);
    let embedding = Embedding {
        tets: centroids
            .map(|p| locator.embed(p))
            .collect::<Result<_, _>>()?,
        nodes: fine
            .positions
            .iter()
            .map(|&p| locator.embed(p))
            .collect::<Result<_, _>>()?,
    };

    clock.enter(Stage::Surface);
    let surface = outer_surface(&fracture);
    let cells = convex_cells(&fracture, &fine.cell_of_tet, fine.cells);

    clock.enter(Stage::Stress);
    let analysis = analysis_of(&quadratic);
    let mut basis = ModalBasis {
        shapes: row_major(&modes.shapes, modes.unknowns),
        peak_stress: Vec::new(),
        eigenvalues: modes.eigenvalues.clone(),
    };
    basis.peak_stress = peak_stress(&analysis, &embedding.tets, &basis, &elasticity);

    let report = BakeReport {
        analysis: MeshReport {
            nodes: quadratic.positions.len(),
            ..MeshReport::of(&coarse)
        },
        fracture: MeshReport::of(&fine),
        unknowns: modes.unknowns,
        frequencies: (0..spec.modes.min(10))
            .map(|i| modes.frequency(i))
            .collect(),
        max_residual: modes.max_residual,
        cells: fine.cells,
        mass: mass.mass,
        seconds: clock.finish(),
    };
    let asset = Asset {
        name: spec.name.clone(),
        material: spec.material.clone(),
        fracture,
        surface,
        analysis,
        embedding,
        modes: basis,
        mass,
        cells,
        cell_of_tet: fine.cell_of_tet,
        render: None,
    };
    asset.validate()?;
    Ok((asset, report))
}

fn analysis_of(mesh: &QuadraticMesh) -> AnalysisMesh {
    let gradients = |e: usize| barycentric_gradients(mesh.corners(e)).map(|g| g.as_vec3());
    AnalysisMesh {
        nodes: mesh.positions.iter().map(|p| p.as_vec3()).collect(),
        barycentric_gradients: (0..mesh.elements.len()).map(gradients).collect(),
        elements: mesh.elements.clone(),
    }
}

/// One row per unknown, one column per mode, in f32.
fn row_major(shapes: &[f64], unknowns: usize) -> Vec<f32> {
    let modes = shapes.len() / unknowns;
    (0..unknowns)
        .flat_map(|row| (0..modes).map(move |mode| shapes[mode * unknowns + row] as f32))
        .collect()
}

/// Times the stages and reports them.
struct Clock<'a> {
    started: Instant,
    seconds: Vec<(Stage, f64)>,
    progress: &'a mut dyn FnMut(Progress),
}

impl Clock<'_> {
    fn enter(&mut self, stage: Stage) {
        self.stop();
        self.seconds.push((stage, 0.0));
        (self.progress)(Progress {
            stage,
            fraction: 0.0,
        });
    }

    fn stop(&mut self) {
        if let Some(last) = self.seconds.last_mut() {
            last.1 = self.started.elapsed().as_secs_f64();
        }
        self.started = Instant::now();
    }

    fn finish(mut self) -> Vec<(Stage, f64)> {
        self.stop();
        (self.progress)(Progress {
            stage: Stage::Stress,
            fraction: 1.0,
        });
        self.seconds
    }
}
