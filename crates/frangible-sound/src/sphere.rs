//! The equivalent sphere, which gives the sound of a vibrating surface in closed form.
//!
//! A body's surface is spread over a sphere of the same outer area. The place of each point on it follows from the ellipsoid of the surface's
//! second moments, shrunk to a ball, so that both faces of a plate fill a half each. The flow through each place is kept. On the
//! sphere it is a sum of spherical harmonics, and each of them sends a wave that is known exactly. Three choices are about bodies that are no
//! spheres:
//! - degree 0 is the flow through the whole surface, inside of cups included: what leaves by the wall comes back by the mouth;
//! - from degree 1 on only the surface that looks away from the centre counts, since the inside of a cup or a hollow body sends nothing of these;
//! - degree 1 is scaled along each axis so that the body shaken as a whole moves as much air as its ellipsoid ([`moved_air`]).
//!
//! For a sphere all three change nothing and the result is exact. What is lost otherwise: waves bent around edges, cavities, and patterns
//! finer than [`MOST_DEGREE`](crate::MOST_DEGREE).

use glam::{DMat3, DQuat, DVec3};
use num_complex::Complex64;

use crate::air::{AIR_DENSITY, SPEED_OF_SOUND};
use crate::ellipsoid::moved_air;
use crate::error::{SoundError, within};
use crate::waves::{HARMONICS, degree, efficiencies, hankel, hankel_slopes, harmonics};

/// A small part of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceElement {
    /// Position, m, from the body's centre of mass.
    pub place: DVec3,
    /// Area vector (outward normal times area), m².
    pub area: DVec3,
}

/// The equivalent sphere of a body for sound radiation.
#[derive(Clone, Debug, PartialEq)]
pub struct EquivalentSphere {
    /// Radius, m, of a sphere with the area of the part of the surface that faces away from the centre.
    pub radius: f64,
    /// Rotation from the frame of the harmonics, which is along the principal axes of the surface, to the body's.
    pub axes: DQuat,
    /// Volume of the body plus that of the air moving with it, along each axis, m³.
    pub moved_air: [f64; 3],
    /// Semi-axes of the ellipsoid of the surface's second moments, m.
    semi_axes: [f64; 3],
    /// Factor of degree 1 along each axis.
    shaken: [f64; 3],
}

/// Thinnest ellipsoid: shortest semi-axis over the longest. A plate as thin as a sheet of paper has more.
const THINNEST: f64 = 1e-3;

impl EquivalentSphere {
    /// Creates the equivalent sphere of a ball.
    ///
    /// # Errors
    /// The radius is not positive.
    pub fn ball(radius: f64) -> Result<Self, SoundError> {
        within(
            || "the radius of a ball".into(),
            radius,
            radius > 0.0,
            "above zero, in m",
        )?;
        Ok(Self {
            radius,
            axes: DQuat::IDENTITY,
            moved_air: moved_air([radius; 3]),
            semi_axes: [radius; 3],
            shaken: [1.0; 3],
        })
    }

    /// Creates the equivalent sphere of a closed surface.
    ///
    /// # Errors
    /// No part of the surface faces away from its centre.
    pub fn of(surface: &[SurfaceElement]) -> Result<Self, SoundError> {
        let outward = || surface.iter().filter(|e| looks_out(e));
        let area: f64 = outward().map(|e| e.area.length()).sum();
        within(
            || "the area of a body's surface that looks away from its centre of mass".into(),
            area,
            area > 0.0,
            "above zero, in m²; the triangles may be inside out",
        )?;
        let moment = |f: fn(DVec3) -> DVec3| {
            outward()
                .map(|e| f(e.place) * e.area.length())
                .sum::<DVec3>()
                / area
        };
        let (diagonal, mixed) = (
            moment(|p| p * p),
            moment(|p| DVec3::new(p.y * p.z, p.x * p.z, p.x * p.y)),
        );
        let (axes, moments) = principal(diagonal, mixed);
        let longest = moments.max_element().max(f64::MIN_POSITIVE).sqrt();
        let semi_axes = moments
            .to_array()
            .map(|m| 3.0_f64.sqrt() * m.max(0.0).sqrt().max(THINNEST * longest));
        let mut sphere = Self {
            radius: (area / (4.0 * std::f64::consts::PI)).sqrt(),
            axes,
            moved_air: moved_air(semi_axes),
            semi_axes,
            shaken: [1.0; 3],
        };
        sphere.shaken = sphere.found_shaken(surface);
        Ok(sphere)
    }

    /// Returns the semi-axes, m, of the ellipsoid with the surface's second moments, along the axes of the harmonics.
    #[must_use]
    pub fn semi_axes(&self) -> [f64; 3] {
        self.semi_axes
    }

    /// Factors of degree 1 with which the shaken body moves the ellipsoid's air.
    fn found_shaken(&self, surface: &[SurfaceElement]) -> [f64; 3] {
        let mut shaken = [0.0; 3];
        for element in surface.iter().filter(|e| looks_out(e)) {
            let y = harmonics(self.direction(element.place));
            let normal = self.axes.inverse() * element.area;
            for (axis, sum) in shaken.iter_mut().enumerate() {
                *sum += normal[axis] * y[DIPOLE[axis]] / (self.radius * self.radius);
            }
        }
        // A sphere that moves with 1 m/s has √(4π/3) there and a dipole of 2πa³.
        let whole = (4.0 * std::f64::consts::PI / 3.0).sqrt();
        let sphere = 2.0 * std::f64::consts::PI * self.radius.powi(3);
        std::array::from_fn(|axis| {
            let found = sphere * shaken[axis] / whole;
            (self.moved_air[axis] / found.max(f64::MIN_POSITIVE)).clamp(0.05, 20.0)
        })
    }

    /// Place on the sphere of a place of the body's surface: a direction in the frame of the harmonics, not of unit length.
    fn direction(&self, place: DVec3) -> DVec3 {
        let place = self.axes.inverse() * place;
        place / DVec3::from_array(self.semi_axes)
    }

    /// Returns the weights that convert the displacement of an element, m, to the normal displacement of the sphere, m: one vector for each
    /// harmonic, whose scalar product with the displacement is its contribution.
    #[must_use]
    pub fn weights(&self, element: &SurfaceElement) -> [DVec3; HARMONICS] {
        let y = harmonics(self.direction(element.place));
        let flow = element.area / (self.radius * self.radius);
        let outward = looks_out(element);
        let mut weights = [DVec3::ZERO; HARMONICS];
        weights[0] = flow * y[0];
        if outward {
            for (weight, y) in weights.iter_mut().zip(y).skip(1) {
                *weight = flow * y;
            }
            for (axis, place) in DIPOLE.into_iter().enumerate() {
                weights[place] *= self.shaken[axis];
            }
        }
        weights
    }

    /// Returns the radiation loss rate of a mode, 1/s, from its motion on the sphere per unit of modal velocity, 1/√kg, and its angular
    /// frequency, rad/s. A mode of unit modal mass and velocity v̂ holds v̂²/2 and sends ½ ρ c a² Σ |c_lm v̂|² σ_l(ka).
    #[must_use]
    pub fn radiation_loss(&self, motion: &[f32], frequency: f64) -> f64 {
        let efficiency = efficiencies(frequency * self.radius / SPEED_OF_SOUND);
        let sum: f64 = (motion.iter().enumerate())
            .map(|(place, &c)| f64::from(c).powi(2) * efficiency[degree(place)])
            .sum();
        AIR_DENSITY * SPEED_OF_SOUND * self.radius * self.radius * sum
    }

    /// Pressure per velocity of each degree at a distance of the centre, m, complex, Pa·s/m, for an angular frequency, rad/s. The delay of the
    /// way from the sphere's surface is left out. Nearer than the surface counts as on it.
    pub(crate) fn waves(&self, frequency: f64, distance: f64) -> Vec<Complex64> {
        let k = frequency / SPEED_OF_SOUND;
        let there = hankel(k * distance.max(self.radius));
        let here = hankel_slopes(k * self.radius);
        // −iρc h_l(kr)/h_l'(ka), the phase e^{−ik(r−a)} left out.
        let impedance = Complex64::new(0.0, -AIR_DENSITY * SPEED_OF_SOUND);
        (there.iter().zip(here))
            .map(|(&h, slope)| impedance * h * slope.inv())
            .collect()
    }
}

/// Places of x, y and z among the harmonics.
const DIPOLE: [usize; 3] = [3, 1, 2];

fn looks_out(element: &SurfaceElement) -> bool {
    element.area.dot(element.place) > 0.0
}

/// Principal axes of a symmetric matrix, given by its diagonal and (yz, xz, xy), and the moments along them: Jacobi's rotations.
fn principal(diagonal: DVec3, mixed: DVec3) -> (DQuat, DVec3) {
    let mut a = [
        [diagonal.x, mixed.z, mixed.y],
        [mixed.z, diagonal.y, mixed.x],
        [mixed.y, mixed.x, diagonal.z],
    ];
    let mut v = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let size = a[p][p].abs() + a[q][q].abs();
            // Axes with no more than rounding between them are kept.
            if a[p][q].abs() <= 1e-9 * size {
                continue;
            }
            let angle = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
            let (sin, cos) = angle.sin_cos();
            for row in &mut a {
                (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
            }
            for k in 0..3 {
                (a[p][k], a[q][k]) = (cos * a[p][k] - sin * a[q][k], sin * a[p][k] + cos * a[q][k]);
            }
            for row in &mut v {
                (row[p], row[q]) = (cos * row[p] - sin * row[q], sin * row[p] + cos * row[q]);
            }
        }
    }
    // Columns of v are the axes; rotations keep their handedness.
    let column = |j: usize| DVec3::new(v[0][j], v[1][j], v[2][j]);
    let axes = DMat3::from_cols(column(0), column(1), column(2));
    (
        DQuat::from_mat3(&axes).normalize(),
        DVec3::new(a[0][0], a[1][1], a[2][2]),
    )
}
