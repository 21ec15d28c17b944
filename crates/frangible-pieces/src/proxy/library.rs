//! Stored shapes with their modes.

use frangible::glam::{DMat3, DVec3};
use frangible_bake::eigen::{Constraints, quick_modes};
use frangible_bake::fem::{Elasticity, Elements, QuadraticMesh, assemble};

use crate::PieceError;
use crate::dense::eigen;
use crate::proxy::shape::ProxyShape;

/// Second and third side over the first: from a rod to a cube to a thin plate.
const PROPORTIONS: [[f64; 2]; 12] = [
    [1.0, 1.0],
    [1.0, 0.5],
    [1.0, 0.25],
    [1.0, 0.1],
    [1.0, 0.05],
    [0.5, 0.5],
    [0.5, 0.25],
    [0.5, 0.1],
    [0.5, 0.05],
    [0.25, 0.25],
    [0.25, 0.1],
    [0.25, 0.05],
];

/// Taper of plan and of thickness: box, wedge, triangular shard.
const TAPERS: [[f64; 2]; 3] = [[0.0, 0.0], [0.0, 0.7], [0.8, 0.0]];

/// What lopsidedness counts beside proportions.
const SKEWNESS_WEIGHT: f64 = 0.5;

/// A database of shapes with their modes: for bodies of one Poisson's ratio.
#[derive(Clone, Debug)]
pub struct ProxyLibrary {
    poisson_ratio: f64,
    proxies: Vec<Proxy>,
}

/// A shape about its centre of mass, along its principal axes, of stiffness, density and mass 1.
#[derive(Clone, Debug)]
pub(crate) struct Proxy {
    shape: ProxyShape,
    /// The centre of mass in the shape's own coordinates, and the principal axes there.
    shift: DVec3,
    axes: DMat3,
    pub(crate) stature: Stature,
    pub(crate) mesh: QuadraticMesh,
    pub(crate) eigenvalues: Vec<f64>,
    /// Row per unknown of a node, one column per mode.
    pub(crate) shapes: Vec<f64>,
}

/// Where a solid is, how long it is each way, and how lopsided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stature {
    pub(crate) centre: DVec3,
    /// Principal axes, the longest first, right-handed.
    pub(crate) axes: DMat3,
    /// Sides of the box of the same moments of inertia, m.
    pub(crate) extents: DVec3,
    /// Third moments along the axes over mass and extents cubed.
    pub(crate) skewness: DVec3,
}

impl Stature {
    /// Of tetrahedra.
    ///
    /// # Errors
    /// No volume.
    pub(crate) fn of(positions: &[DVec3], tets: &[[u32; 4]]) -> Result<Self, PieceError> {
        let corners = |tet: &[u32; 4]| tet.map(|v| positions[v as usize]);
        let weighed = tets.iter().map(|tet| {
            let x = corners(tet);
            ((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6.0, x)
        });
        let (mut volume, mut first) = (0.0, DVec3::ZERO);
        for (v, x) in weighed.clone() {
            volume += v;
            first += x.iter().sum::<DVec3>() * (v / 4.0);
        }
        let centre = first / volume;
        // ∫ over a tetrahedron of x xᵀ: V/20 (Σ x xᵀ + Σx Σxᵀ).
        let mut second = DMat3::ZERO;
        let outer = |v: DVec3| DMat3::from_cols(v * v.x, v * v.y, v * v.z);
        for (v, x) in weighed.clone() {
            let x = x.map(|x| x - centre);
            let sum: DVec3 = x.iter().sum();
            let squares = x.iter().fold(outer(sum), |m, &x| m + outer(x));
            second += squares * (v / (20.0 * volume));
        }
        let matrix = faer::Mat::from_fn(3, 3, |i, j| second.col(j)[i]);
        let (values, vectors) = eigen(matrix.as_ref())?;
        let value = |k: usize| values[k].max(f64::MIN_POSITIVE);
        let vector = |k: usize| DVec3::from_array([0, 1, 2].map(|i| vectors[(i, k)]));
        let (long, middle) = (vector(2), vector(1));
        let axes = DMat3::from_cols(long, middle, long.cross(middle));
        // Of a box of side a: ∫ x² / V = a²/12.
        let extents = DVec3::new(value(2), value(1), value(0)).map(|s| (12.0 * s).sqrt());
        let mut skewness = DVec3::ZERO;
        for (v, x) in weighed {
            // One point per tetrahedron will do.
            let at = axes.transpose() * (x.iter().sum::<DVec3>() / 4.0 - centre) / extents;
            skewness += at * at * at * (v / volume);
        }
        Ok(Self {
            centre,
            axes,
            extents,
            skewness,
        })
    }
}

impl ProxyLibrary {
    /// Bakes the database: 36 shapes, about a second.
    ///
    /// # Errors
    /// Poisson's ratio outside -1 … 0.5.
    pub fn new(poisson_ratio: f64, modes: usize) -> Result<Self, PieceError> {
        let mut proxies = Vec::new();
        for [second, third] in PROPORTIONS {
            for [narrows, thins] in TAPERS {
                let shape = ProxyShape {
                    sides: DVec3::new(1.0, second, third),
                    narrows,
                    thins,
                };
                proxies.push(Proxy::new(shape, poisson_ratio, modes)?);
            }
        }
        Ok(Self {
            poisson_ratio,
            proxies,
        })
    }

    /// Poisson's ratio that it was baked for.
    #[must_use]
    pub fn poisson_ratio(&self) -> f64 {
        self.poisson_ratio
    }

    /// The shape that is most like this one, and how it lies best: signs along its axes.
    pub(crate) fn closest(&self, stature: &Stature) -> (&Proxy, DVec3) {
        let proportions = |s: &Stature| s.extents / s.extents.element_product().cbrt();
        let flips = [
            DVec3::new(1.0, 1.0, 1.0),
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
        ];
        let mut best = (f64::INFINITY, &self.proxies[0], flips[0]);
        for proxy in &self.proxies {
            let ratio = proportions(stature) / proportions(&proxy.stature);
            let stretched = ratio.map(f64::ln).length_squared();
            for flip in flips {
                let skew = proxy.stature.skewness - flip * stature.skewness;
                let unlike = stretched + SKEWNESS_WEIGHT * (100.0 * skew).length_squared();
                if unlike < best.0 {
                    best = (unlike, proxy, flip);
                }
            }
        }
        (best.1, best.2)
    }
}

impl Proxy {
    fn new(shape: ProxyShape, poisson_ratio: f64, modes: usize) -> Result<Self, PieceError> {
        let mut body = shape.mesh();
        let mut stature = Stature::of(&body.positions, &body.tets)?;
        let (shift, axes) = (stature.centre, stature.axes);
        for p in &mut body.positions {
            *p = axes.transpose() * (*p - shift);
        }
        (stature.centre, stature.axes) = (DVec3::ZERO, DMat3::IDENTITY);
        let mesh = QuadraticMesh::new(&body);
        let material = Elasticity {
            youngs_modulus: 1.0,
            poisson_ratio,
            density: 1.0,
        };
        let system = assemble(
            &mesh.positions,
            Elements::Quadratic(&mesh.elements),
            &material,
        );
        let found = quick_modes(&system, &Constraints::default(), modes)?;
        // Of mass 1: shapes times the root of the mass they were normalised with.
        let root = body.volume().sqrt();
        let count = found.eigenvalues.len();
        let shapes = (0..found.unknowns)
            .flat_map(|row| (0..count).map(move |mode| (mode, row)))
            .map(|(mode, row)| found.shape(mode)[row] * root)
            .collect();
        Ok(Self {
            shape,
            shift,
            axes,
            stature,
            mesh,
            eigenvalues: found.eigenvalues,
            shapes,
        })
    }

    /// Element and barycentric coordinates of a place, of the nearest one for a place outside.
    pub(crate) fn locate(&self, p: DVec3) -> (u32, [f32; 4]) {
        let own = self.shift + self.axes * p;
        let c = self.shape.coordinates(own);
        let inside = self.axes.transpose() * (self.shape.place(c) - self.shift);
        let n = self.shape.cells();
        let c = c.to_array();
        let at = [0, 1, 2].map(|k| ((c[k] * n[k] as f64) as usize).min(n[k] - 1));
        let cell = (at[0] * n[1] + at[1]) * n[2] + at[2];
        let mut best = (f64::NEG_INFINITY, 0, [0.25; 4]);
        for element in 6 * cell..6 * cell + 6 {
            let corners = self.mesh.corners(element);
            let edges = DMat3::from_cols(
                corners[1] - corners[0],
                corners[2] - corners[0],
                corners[3] - corners[0],
            );
            let l = edges.inverse() * (inside - corners[0]);
            let l = [1.0 - l.x - l.y - l.z, l.x, l.y, l.z];
            let least = l.iter().copied().fold(f64::INFINITY, f64::min);
            if least > best.0 {
                best = (least, element as u32, l);
            }
        }
        (best.1, best.2.map(|l| l as f32))
    }
}
