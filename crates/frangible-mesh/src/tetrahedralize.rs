//! The main entry point of the mesher: a solid in, tetrahedra out.

use std::fmt;
use std::ops::ControlFlow;

use crate::error::TetError;
use crate::quality::dihedral_range;
use crate::solid::Solid;
use crate::stuffing::{Lattice, counted_volume, cut, warp};
use crate::tets::features::{Features, snap};
use crate::tets::fill::fill;
use crate::tets::improve::improve;
use crate::tets::jitter::jitter;
use crate::tets::manifold::make_manifold;
use crate::tets::pieces::keep_largest;
use crate::tets::{Draft, TetBody};
use crate::watch::Watch;

/// Guaranteed smallest dihedral angle, degrees.
pub const SMALLEST_ANGLE: f64 = 10.0;

/// Number of lattice cells per wall thickness needed for a sound mesh; measured, see the tests.
pub const CELLS_PER_WALL: f64 = 1.5;

/// Tetrahedra with a smaller angle than this, degrees, are worked on.
const WORTH_IMPROVING: f64 = 18.0;

/// Times that features are snapped and angles improved in turn: better angles let more features in.
const SNAP_ROUNDS: usize = 3;

/// A body whose largest piece holds less than this share of its volume has no main piece.
const MAIN_PIECE: f64 = 0.75;

/// Share of the volume that may be missing; beyond it the lattice is refined.
const VOLUME_OFF: f64 = 0.03;

/// Tetrahedra per lattice cube of a wall of [`CELLS_PER_WALL`] cells; in a thick body they are 12.6.
const TETS_PER_WALL_CUBE: f64 = 14.3;

/// Number of tetrahedra, or their size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution {
    /// About this many tetrahedra, within 15 %; more if thin walls or a volume error above 3 % require them.
    Tets(usize),
    /// Lattice cubes with this side length, m, of about a dozen tetrahedra each.
    Cell(f64),
}

/// Volume of the tetrahedra. They lie within curved surfaces, and miss 0.3 to 3 % of the solid unless these are moved out by a fraction of a
/// cell.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum VolumeAim {
    /// The volume that the lattice gives.
    #[default]
    Lattice,
    /// The volume of the solid, measured on a grid four times as fine as the lattice, to about 0.2 %.
    Counted,
    /// This volume, m³.
    Exact(f64),
}

/// Options of [`tetrahedralize`].
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TetOptions {
    /// Number or size of the tetrahedra. Default 40 000 tetrahedra.
    pub resolution: Resolution,
    /// Largest number of tetrahedra, default 400 000.
    pub most: usize,
    /// Thickness of the thinnest walls, m, if known: the lattice is refined until they hold [`CELLS_PER_WALL`] cells.
    pub wall: Option<f64>,
    /// Snaps surface vertices to sharp edges and corners, default true.
    pub snap: bool,
    /// Random seed for making the mesh irregular; `None` (default): keep the lattice.
    pub irregular: Option<u64>,
    /// Compares the volume with that on a grid four times as fine, default true.
    pub check_volume: bool,
    /// Volume that the tetrahedra are given, default that of the lattice.
    pub volume: VolumeAim,
}

impl Default for TetOptions {
    fn default() -> Self {
        Self {
            resolution: Resolution::Tets(40_000),
            most: 400_000,
            wall: None,
            snap: true,
            irregular: None,
            check_volume: true,
            volume: VolumeAim::Lattice,
        }
    }
}

/// Report of a meshing.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TetReport {
    /// Number of nodes.
    pub nodes: usize,
    /// Number of tetrahedra.
    pub tets: usize,
    /// Side of a lattice cube, m.
    pub cell: f64,
    /// Smallest dihedral angle, degrees.
    pub smallest_angle: f64,
    /// Largest dihedral angle, degrees.
    pub largest_angle: f64,
    /// Volume of the tetrahedra, m³.
    pub volume: f64,
    /// Volume of the solid, measured on a grid four times as fine as the lattice, m³.
    pub counted_volume: Option<f64>,
    /// Number of separate pieces; only the largest was kept.
    pub pieces: usize,
    /// Share of the volume that was kept.
    pub kept: f64,
    /// Sharp features, found and not reproduced.
    pub features: Features,
    /// Volume before the surface was moved to give the tetrahedra that of [`TetOptions::volume`], m³; `None` where it was not moved.
    pub lattice_volume: Option<f64>,
    /// Number of tetrahedra removed where parts were joined only along an edge.
    pub pinches: usize,
}

impl fmt::Display for TetReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} tetrahedra, {} nodes, angles {:.1}° to {:.1}°, volume {:.4e} m³",
            self.tets, self.nodes, self.smallest_angle, self.largest_angle, self.volume
        )?;
        if let Some(counted) = self.counted_volume {
            write!(
                f,
                " ({:+.2} % of the solid's)",
                100.0 * (self.volume / counted - 1.0)
            )?;
        }
        if self.features.sharp > 0 {
            write!(
                f,
                ", {} of {} sharp features not snapped",
                self.features.not_snapped, self.features.sharp
            )?;
        }
        if self.pieces > 1 {
            write!(
                f,
                "; {} disconnected piece{} dropped ({:.2} % of the volume)",
                self.pieces - 1,
                if self.pieces == 2 { "" } else { "s" },
                100.0 * (1.0 - self.kept)
            )?;
        }
        Ok(())
    }
}

/// Fills a solid with tetrahedra: one face-connected piece, closed manifold surface, no dihedral angle below 10°.
///
/// Isosurface stuffing [Labelle & Shewchuk 2007]: a body-centred cubic lattice, its vertices near the surface moved onto
/// it, its tetrahedra cut along it. Then sharp features are snapped and bad angles improved.
///
/// # Errors
/// An invalid number, walls too thin for the allowed number of tetrahedra, or a body in several pieces.
pub fn tetrahedralize(
    solid: &dyn Solid,
    options: &TetOptions,
) -> Result<(TetBody, TetReport), TetError> {
    tetrahedralize_watched(solid, options, &mut |_| ControlFlow::Continue(()))
}

/// Like [`tetrahedralize`], with a callback that receives the completed share, from 0 to 1, and can cancel with [`ControlFlow::Break`].
///
/// # Errors
/// [`TetError::Cancelled`] when stopped, and those of [`tetrahedralize`].
pub fn tetrahedralize_watched(
    solid: &dyn Solid,
    options: &TetOptions,
    watch: &mut dyn FnMut(f64) -> ControlFlow<()>,
) -> Result<(TetBody, TetReport), TetError> {
    let watch = &mut Watch::new(watch);
    watch.reach(0.0)?;
    let [low, high] = solid.bounds();
    let longest = (high - low).max_element();
    if !(longest.is_finite() && longest > 0.0) {
        return Err(TetError::NotPositive {
            what: "the longest side of the body, in m,",
            value: longest,
        });
    }
    let mut cell = first_cell(solid, options, longest)?;
    let wall_cell = options
        .wall
        .map_or(f64::INFINITY, |wall| wall / CELLS_PER_WALL);
    if wall_cell < cell {
        cell = wall_cell;
        too_thin(solid, options, cell, longest)?;
    }
    watch.reach(0.05)?;
    let mut draft = stuff(solid, cell)?;
    watch.reach(0.15)?;
    let Resolution::Tets(wanted) = options.resolution else {
        let done = finish(solid, options, draft, cell, watch)?;
        watch.reach(1.0)?;
        return Ok(done);
    };
    // The estimate from the volume is a few per cent off, more for thin walls: a correction or two land within 15 %.
    for attempt in 1..=3 {
        let ratio = draft.body.tets.len() as f64 / wanted as f64;
        let next = (cell * ratio.cbrt()).min(wall_cell);
        if (ratio - 1.0).abs() < 0.1 || (next / cell - 1.0).abs() < 0.01 {
            break;
        }
        cell = next;
        draft = stuff(solid, cell)?;
        watch.reach(0.15 + 0.05 * f64::from(attempt))?;
    }
    loop {
        if draft.body.tets.len() > options.most {
            return Err(TetError::TooThin {
                wall: options.wall.unwrap_or(cell * CELLS_PER_WALL),
                needed: needed(solid, draft, cell),
                limit: options.most,
            });
        }
        let tets = draft.body.tets.len();
        let (body, report) = finish(solid, options, draft, cell, watch)?;
        // What the lattice lost, before the rest was moved out to make up for it.
        let filled = report.lattice_volume.unwrap_or(report.volume);
        let off = report
            .counted_volume
            .map_or(0.0, |v| (filled / v - 1.0).abs());
        if off <= VOLUME_OFF {
            watch.reach(1.0)?;
            return Ok((body, report));
        }
        // Parts thinner than the lattice are lost: the missing volume shrinks with the square of the cell.
        cell *= (VOLUME_OFF / off).sqrt().clamp(0.5, 0.85);
        log::info!(
            "{tets} tetrahedra miss {:.1} % of the volume: refined",
            100.0 * off
        );
        watch.start_over();
        draft = stuff(solid, cell)?;
        watch.reach(0.3)?;
    }
}

/// Tetrahedra that resolve a body of which a draft misses a part, so that a caller who requests them is not told a larger number next.
fn needed(solid: &dyn Solid, mut draft: Draft, cell: f64) -> usize {
    let tets = draft.body.tets.len();
    keep_largest(&mut draft);
    let counted = counted_volume(solid, 0.25 * cell);
    let off = (draft.body.volume() / counted - 1.0).abs();
    // The missing volume shrinks with the square of the cell, and the number grows with its cube.
    let finer = (off / VOLUME_OFF).max(1.0).powf(1.5);
    let needed = tets as f64 * finer;
    if needed.is_finite() {
        needed as usize
    } else {
        tets
    }
}

/// Refuses walls that would need far more tetrahedra than allowed, before they are made.
fn too_thin(
    solid: &dyn Solid,
    options: &TetOptions,
    cell: f64,
    longest: f64,
) -> Result<(), TetError> {
    // Walls thinner than the grid are counted as thick as half of it.
    let wall = cell * CELLS_PER_WALL;
    let volume = counted_volume(solid, longest / (1.5 * longest / wall).clamp(96.0, 256.0));
    let needed = TETS_PER_WALL_CUBE * volume / cell.powi(3);
    if needed > 1.5 * options.most as f64 {
        return Err(TetError::TooThin {
            wall,
            needed: needed as usize,
            limit: options.most,
        });
    }
    Ok(())
}

/// Lattice cell for the wanted number of tetrahedra, from a rough volume.
fn first_cell(solid: &dyn Solid, options: &TetOptions, longest: f64) -> Result<f64, TetError> {
    match options.resolution {
        Resolution::Cell(cell) if cell.is_finite() && cell > 0.0 => Ok(cell),
        Resolution::Cell(cell) => Err(TetError::NotPositive {
            what: "the lattice cell, in m,",
            value: cell,
        }),
        Resolution::Tets(0) => Err(TetError::NotPositive {
            what: "the number of tetrahedra",
            value: 0.0,
        }),
        Resolution::Tets(wanted) => {
            let mut volume = 0.0;
            for divisions in [24.0, 48.0, 96.0, 192.0] {
                volume = counted_volume(solid, longest / divisions);
                // A few hundred points inside tell the volume within some per cent.
                if volume > 400.0 * (longest / divisions).powi(3) {
                    break;
                }
            }
            if volume <= 0.0 {
                return Err(TetError::Nothing {
                    cell: longest / 192.0,
                });
            }
            Ok((12.6 * volume / wanted as f64).cbrt())
        }
    }
}

/// Lattice tetrahedra cut to the solid.
fn stuff(solid: &dyn Solid, cell: f64) -> Result<Draft, TetError> {
    let lattice = Lattice::new(solid, cell)?;
    let warped = warp(solid, &lattice);
    let cut = cut(&lattice, &warped);
    if cut.tets.is_empty() {
        return Err(TetError::Nothing { cell });
    }
    let mut draft = Draft {
        body: TetBody {
            positions: cut.positions,
            tets: cut.tets,
        },
        on_surface: cut.on_surface,
    };
    draft.compact();
    Ok(draft)
}

fn finish(
    solid: &dyn Solid,
    options: &TetOptions,
    mut draft: Draft,
    cell: f64,
    watch: &mut Watch<'_>,
) -> Result<(TetBody, TetReport), TetError> {
    let dropped = keep_largest(&mut draft);
    if dropped.kept < MAIN_PIECE {
        return Err(TetError::Pieces {
            pieces: dropped.pieces,
            share: 100.0 * dropped.kept,
        });
    }
    let mut pinches = make_manifold(&mut draft)?;
    if pinches > 0 {
        // Removing a pinch may part what hung on it.
        keep_largest(&mut draft);
        pinches += make_manifold(&mut draft)?;
    }
    let mut fixed = vec![false; draft.body.positions.len()];
    let mut features = Features::default();
    watch.reach(0.35)?;
    improve(&mut draft, &fixed, solid, cell, WORTH_IMPROVING);
    watch.reach(0.45)?;
    for round in 0..if options.snap { SNAP_ROUNDS } else { 0 } {
        let found = snap(&mut draft, &mut fixed, solid, cell, SMALLEST_ANGLE + 2.0);
        features = if round == 0 {
            found
        } else {
            Features {
                not_snapped: found.not_snapped,
                ..features
            }
        };
        watch.reach(0.5 + 0.1 * round as f64)?;
        if found.sharp == 0 {
            break;
        }
        improve(&mut draft, &fixed, solid, cell, WORTH_IMPROVING);
        watch.reach(0.55 + 0.1 * round as f64)?;
    }
    watch.reach(0.8)?;
    if let Some(seed) = options.irregular {
        jitter(&mut draft, &fixed, solid, cell, seed);
    }
    watch.reach(0.9)?;
    let lattice_volume = draft.body.volume();
    let counted_volume = options
        .check_volume
        .then(|| counted_volume(solid, 0.25 * cell));
    let aim = match options.volume {
        VolumeAim::Lattice => None,
        VolumeAim::Counted => counted_volume,
        VolumeAim::Exact(volume) => Some(volume),
    };
    let is_filled = aim
        .filter(|_| dropped.pieces == 1)
        .is_some_and(|volume| fill(&mut draft, &fixed, volume, SMALLEST_ANGLE));
    let body = draft.body;
    let (smallest_angle, largest_angle) = angles(&body);
    if smallest_angle < SMALLEST_ANGLE {
        return Err(TetError::Sliver {
            angle: smallest_angle,
            limit: SMALLEST_ANGLE,
        });
    }
    let report = TetReport {
        nodes: body.positions.len(),
        tets: body.tets.len(),
        cell,
        smallest_angle,
        largest_angle,
        volume: body.volume(),
        counted_volume,
        pieces: dropped.pieces,
        kept: dropped.kept,
        features,
        lattice_volume: is_filled.then_some(lattice_volume),
        pinches,
    };
    Ok((body, report))
}

fn angles(body: &TetBody) -> (f64, f64) {
    (0..body.tets.len())
        .map(|e| dihedral_range(body.corners(e)))
        .fold((180.0, 0.0), |(low, high): (f64, f64), (a, b)| {
            (low.min(a), high.max(b))
        })
}
