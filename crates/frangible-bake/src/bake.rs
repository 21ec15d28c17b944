//! The main entry point of the bake: shape and material in, asset out.
//!
//! A mesh that is too coarse is refined: its volume is compared with that of the solid on a grid four times as fine, and the lattice is
//! refined while more than 3 % is missing. Shells are meshed with one and a half cells per wall from the start. Walls of two faces need no
//! lattice: both meshes follow the wall.
//!
//! Up to 20 000 imported quadratic tetrahedra are used as the analysis mesh; larger meshes are covered by a lattice like any solid.

use std::ops::ControlFlow;

use frangible::glam::DVec3;
use frangible::internals::asset::{AssetParts, RenderSurface};
use frangible::internals::modal::ModalBasis;
use frangible::internals::stress::StressBounds;
use frangible::internals::{MassProperties, TetMesh};
use frangible::{Asset, InputError};
use frangible_mesh::{TetReport, VolumeAim};
use web_time::Instant;

use crate::MOST_MODES;
use crate::analysis::Analysis;
use crate::cancel::CancelToken;
use crate::cells::convex_cells;
use crate::eigen::lowest_supported_modes;
use crate::error::BakeError;
use crate::fem::Elasticity;
use crate::followed::followed;
use crate::laminate::Layers;
use crate::mesh::BodyMesh;
use crate::report::{BakeReport, MeshReport, Progress, Stage};
use crate::shapes::{self, Shape, SolidShape};
use crate::spec::BakeSpec;
use crate::supports::{Holder, check_groups, check_supports};
use crate::surface::{CREASE, SOLID_CREASE, outer_surface};
use crate::walls::walls;

/// Share of the meshing before a solid is covered by elements.
const MESHING: f64 = 0.75;

/// An asset and the report of its bake.
#[derive(Clone, Debug)]
pub struct Baked {
    /// The asset.
    pub asset: Asset,
    /// Report of the bake: meshes, frequencies, times, and the position of the body frame in the frame of the shape.
    pub report: BakeReport,
}

/// Bakes an asset: makes the two meshes, computes the vibration modes, and maps the meshes to each other.
///
/// The body frame has its origin at the centre of mass of the fracture mesh and the axes of the shape. [`bake_with`] also returns a report.
///
/// # Errors
/// The first invalid number, station, mode or point, with a hint how to fix it; [`BakeError::Cancelled`] after a cancellation by
/// [`BakeSpec::cancel`].
pub fn bake(spec: &BakeSpec) -> Result<Asset, BakeError> {
    Ok(bake_with(spec, |_| {})?.asset)
}

/// Bakes an asset like [`bake()`], calls `progress` at every advance, and also returns the report of the bake.
///
/// # Errors
/// The errors of [`bake()`].
pub fn bake_with(spec: &BakeSpec, mut progress: impl FnMut(Progress)) -> Result<Baked, BakeError> {
    check(spec)?;
    baked(spec, &mut progress)
}

fn check(spec: &BakeSpec) -> Result<(), BakeError> {
    spec.material.validate().map_err(InputError::from)?;
    if spec.modes == 0 {
        return Err(BakeError::Modes {
            wanted: 0,
            available: MOST_MODES,
        });
    }
    if spec.modes > MOST_MODES {
        return Err(BakeError::TooManyModes {
            wanted: spec.modes,
            most: MOST_MODES,
        });
    }
    if let Some(wanted) = spec.followed
        && !(1..=spec.modes).contains(&wanted)
    {
        return Err(BakeError::Followed {
            wanted,
            modes: spec.modes,
        });
    }
    check_supports(&spec.supports)?;
    check_groups(&spec.supports, &spec.groups)
}

fn baked(spec: &BakeSpec, progress: &mut dyn FnMut(Progress)) -> Result<Baked, BakeError> {
    let mut clock = Clock {
        started: Instant::now(),
        seconds: Vec::new(),
        progress,
        cancel: &spec.cancel,
    };

    let layers = Layers::of(spec)?;
    clock.enter(Stage::Mesh)?;
    let Meshes {
        mut fine,
        coarse,
        tetrahedra,
    } = meshes(spec, layers.as_ref(), &mut |share| {
        clock.tell(Stage::Mesh, MESHING * share);
        spec.cancel.flow()
    })?;
    let holder = Holder::new(&spec.supports, &spec.groups, &fine.positions)?;
    let held = holder.axes(
        &fine.positions,
        &fine.tets,
        "contains no part of the body; move or enlarge its region",
    )?;
    let closed_volume = match &spec.shape {
        Shape::Solid(SolidShape {
            volume: VolumeAim::Exact(volume),
            ..
        }) => Some(*volume),
        Shape::Wall(shape) => Some(shape.wall.volume()),
        _ => None,
    };
    let corners = (0..fine.tets.len()).map(|e| fine.corners(e));
    let centre = MassProperties::of_tetrahedra(spec.material.density, corners).centre;
    fine.translate(-centre);
    let holder = holder.with_origin(centre);
    let fracture = TetMesh::new(
        fine.positions.iter().map(|p| p.as_vec3()).collect(),
        fine.tets.clone(),
    );
    // The mesh as stored decides, so that the masses of its pieces sum to it exactly.
    let corners = (0..fine.tets.len()).map(|e| fracture.corners(e).map(|p| p.as_dvec3()));
    let mut mass = MassProperties::of_tetrahedra(spec.material.density, corners);
    // Zero but for rounding: the frame is defined by it.
    mass.centre = DVec3::ZERO;
    let analysis = match coarse {
        Coarse::Mesh(mut coarse) => {
            coarse.translate(-centre);
            Analysis::conforming(&coarse)
        }
        Coarse::Cover(elements) => Analysis::covering(&fine, elements)?,
        Coarse::Linear => Analysis::linear(&fine),
    };

    clock.enter(Stage::Assemble)?;
    let elasticity = Elasticity::from(&spec.material);
    let (system, constraints) = analysis.assemble(&elasticity, &fine, &held, &holder)?;

    clock.enter(Stage::Modes)?;
    let mut modes = lowest_supported_modes(&system, &constraints, spec.modes, &mut |share| {
        (clock.progress)(Progress {
            stage: Stage::Modes,
            fraction: share,
        });
        spec.cancel.flow()
    })?;

    if let (Some(layers), Analysis::Conforming(mesh, _)) = (&layers, &analysis) {
        layers.laminate(spec, mesh, &mut modes.eigenvalues, &mut modes.shapes)?;
    }

    clock.enter(Stage::Embed)?;
    let embedding = analysis.embed(&fine)?;

    clock.enter(Stage::Surface)?;
    let crease = match spec.shape {
        Shape::Solid(_) | Shape::Tets(_) => SOLID_CREASE,
        _ => CREASE,
    };
    let mut surface = outer_surface(&fracture, crease);
    let cells = convex_cells(&fracture, &fine.cell_of_tet, fine.cells);
    let supported: Vec<u32> = (0..held.len() as u32)
        .filter(|&v| held[v as usize] != [false; 3])
        .collect();

    clock.enter(Stage::Walls)?;
    surface.walls = walls(&fracture.positions, &surface, &supported, crease);
    if let Some(layers) = &layers {
        layers.thin(&mut surface.walls);
    }

    clock.enter(Stage::Stress)?;
    let basis = ModalBasis {
        shapes: analysis.shapes(
            row_major(&modes.shapes, modes.unknowns),
            modes.eigenvalues.len(),
        ),
        peak_stress: Vec::new(),
        eigenvalues: modes.eigenvalues.clone(),
        ..ModalBasis::default()
    };
    let mut asset = Asset::from_parts(AssetParts {
        name: spec.name.clone(),
        material: spec.material.clone(),
        analysis: analysis.stored(),
        fracture: fracture.into(),
        surface,
        embedding,
        modes: basis,
        bounds: StressBounds::default(),
        mass,
        cells,
        cell_of_tet: fine.cell_of_tet.clone(),
        supported,
        render: spec.render.as_ref().map(|r| moved(r, -centre)),
        portion: None,
    })
    .restressed();

    clock.enter(Stage::Followed)?;
    let kept = asset.modes().count();
    let follow = spec.followed.unwrap_or_else(|| followed(&asset));
    asset.parts_mut().modes.residual_modes = kept - follow;

    let report = BakeReport {
        analysis: analysis.report(&fine),
        fracture: MeshReport::of(&fine),
        tetrahedra,
        unknowns: modes.unknowns - constraints.unknowns().len(),
        rigid_motions: modes.rigid_motions,
        frequencies: (0..spec.modes.min(10))
            .map(|i| modes.frequency(i))
            .collect(),
        modes: kept,
        followed: follow,
        max_residual: modes.max_residual,
        cells: fine.cells,
        mass: mass.mass,
        closed_volume,
        centre,
        seconds: clock.finish(),
        mode_seconds: modes.seconds,
    };
    asset.validate()?;
    asset.check_temper()?;
    Ok(Baked { asset, report })
}

/// The fine mesh in the frame of the shape, and the elements that are to carry its modes.
struct Meshes {
    fine: BodyMesh,
    coarse: Coarse,
    tetrahedra: Option<TetReport>,
}

enum Coarse {
    Mesh(BodyMesh),
    /// A lattice of about this many elements.
    Cover(usize),
    /// The fine mesh itself, with linear elements.
    Linear,
}

fn meshes(
    spec: &BakeSpec,
    layers: Option<&Layers>,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<Meshes, BakeError> {
    if let Shape::Solid(shape) = &spec.shape {
        let cell = spec.fracture.map(|size| size.edge);
        let (fine, report) = shapes::solid::mesh(shape, cell, Some(spec.seed), watch)?;
        let elements = shapes::solid::elements(shape, spec.analysis, fine.volume());
        return Ok(Meshes {
            fine,
            coarse: Coarse::Cover(elements),
            tetrahedra: Some(report),
        });
    }
    if let Shape::Tets(shape) = &spec.shape {
        let fine = shapes::tets::mesh(shape)?;
        let coarse = match (shape.carries_modes(), shape.quadratic) {
            (true, true) => Coarse::Mesh(fine.clone()),
            (true, false) => Coarse::Linear,
            (false, _) => Coarse::Cover(shapes::tets::cover_elements(shape, spec.analysis)),
        };
        return Ok(Meshes {
            fine,
            coarse,
            tetrahedra: None,
        });
    }
    if let Shape::Wall(shape) = &spec.shape {
        let wanted = || spec.shape.size_for(shape.tets as f64);
        let size = spec.fracture.map_or_else(wanted, Ok)?;
        let size = layers.map_or(size, |layers| layers.fracture(size));
        let fine = spec.shape.fracture_mesh(size, spec.seed)?;
        let size = spec
            .analysis
            .map_or_else(|| spec.shape.analysis_size(), Ok)?;
        let coarse = match shapes::wall::analysis_mesh(shape, size)? {
            Some(coarse) => Coarse::Mesh(coarse),
            None => Coarse::Cover(shapes::wall::estimate(shape, size) as usize),
        };
        return Ok(Meshes {
            fine,
            coarse,
            tetrahedra: None,
        });
    }
    let shape = &spec.shape;
    let analysis_size = spec.analysis.map_or_else(|| shape.analysis_size(), Ok)?;
    let fracture_size = spec.fracture.map_or_else(|| shape.fracture_size(), Ok)?;
    let (analysis_size, fracture_size) = match layers {
        Some(layers) => (
            Layers::analysis(analysis_size),
            layers.fracture(fracture_size),
        ),
        None => (analysis_size, fracture_size),
    };
    Ok(Meshes {
        coarse: Coarse::Mesh(shape.analysis_mesh(analysis_size)?),
        fine: shape.fracture_mesh(fracture_size, spec.seed)?,
        tetrahedra: None,
    })
}

/// The drawn surface in the body frame.
fn moved(render: &RenderSurface, by: DVec3) -> RenderSurface {
    let mut render = render.clone();
    for p in &mut render.positions {
        *p = (p.as_dvec3() + by).as_vec3();
    }
    render
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
    cancel: &'a CancelToken,
}

impl Clock<'_> {
    fn enter(&mut self, stage: Stage) -> Result<(), BakeError> {
        self.stop();
        self.seconds.push((stage, 0.0));
        (self.progress)(Progress {
            stage,
            fraction: 0.0,
        });
        match self.cancel.is_cancelled() {
            true => Err(BakeError::Cancelled),
            false => Ok(()),
        }
    }

    fn tell(&mut self, stage: Stage, fraction: f64) {
        (self.progress)(Progress { stage, fraction });
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
            stage: Stage::Followed,
            fraction: 1.0,
        });
        self.seconds
    }
}
