//! The section of a solid in which large cracks lie, and the energy that the whole body sets free when they grow across it (beyond the paper).
//!
//! The stress of the unbroken body tells only what acts ahead of a small crack. A crack that takes much of a section loads the rest of it: a bent
//! bar that is cut to its middle has no tension there, and goes on cracking. A section is flat, and divided into columns about as wide as they
//! are high. Force N and moment M of a column act on its crack and its ligament together, and the crack adds the compliance C of an edge crack in a
//! strip (H. Tada, P. Paris, G. Irwin, *The Stress Analysis of Cracks Handbook*; J. Rice, N. Levy, J. Appl. Mech. 39 (1972) 185). With
//! f = (N, M), the energy release rate is `½ fᵀ (∂C/∂A) f`, which is K²/E'. The cracks relax f: `f = (1 + G Λ⁻¹ Gᵀ C)⁻¹ f₀`, where the rows of G
//! are the N and M of the modes, and f₀ those of the motion without the cracks.

use std::sync::Arc;

use glam::{Vec2, Vec3};

use super::squares::{Squares, spread};
use super::strip;
use crate::asset::Asset;
use crate::motion::Motion;
use crate::stress::{Shape, dot};

/// Cosine of the largest angle between a section and a crack that runs along it.
pub(super) const ALONG: f32 = 0.7;

/// Distance, in mean edges, and cosine of the angle up to which two planes have one section.
const SAME_PLACE: f32 = 0.25;
const SAME_WAY: f32 = 0.9986;

/// Least distance of the cracked part's centroid from the middle of a column, over its height: a crack nearer to the middle is no edge crack.
const ASIDE: f64 = 0.05;

/// A square counts as cracked when less than this share of it is left.
const LEFT: f32 = 0.1;

/// Columns of a section, at most.
const MOST_COLUMNS: usize = 12;

/// A section, and the cracks in it.
pub(super) struct Section {
    pub(super) plane: Plane,
    squares: Squares,
    columns: Vec<Column>,
    /// Analysis nodes whose displacements give the resultants.
    pub(super) nodes: Vec<u32>,
    /// Their factors in N, N/m, and M, N, of each column: `[node][column]`.
    pub(super) factors: Vec<[Vec3; 2]>,
    /// G: resultants of the modes that are followed, of unit amplitude: `[resultant][mode]`, N and M of each column one after the other.
    pub(super) of_modes: Vec<f32>,
    /// Those of the shapes that follow the forces, per newton.
    of_shapes: Vec<(Arc<Shape>, Vec<f64>)>,
    /// G Λ⁻¹ Gᵀ.
    pub(super) stiffness: Vec<f64>,
    /// N and M of the columns in the motion, N and N m, and the time step.
    resultants: Vec<f64>,
    pub(super) step: usize,
    /// Cracked area when the section was found, m².
    pub(super) found: f64,
    /// False where another section releases this one.
    pub(super) is_fed: bool,
    /// True if the rates are those of the present cracks and step.
    known: bool,
}

/// Plane of a section, with axes along its columns' widths and heights.
#[derive(Clone, Copy)]
pub(super) struct Plane {
    pub(super) origin: Vec3,
    pub(super) normal: Vec3,
    pub(super) axes: [Vec3; 2],
    /// Largest distance from the plane at which a crack runs along it, m.
    pub(super) near: f32,
}

impl Plane {
    pub(super) fn place(&self, at: Vec3) -> Vec2 {
        let off = at - self.origin;
        Vec2::from_array(self.axes.map(|axis| axis.dot(off)))
    }

    /// Returns true if a plane through a point, m, with this unit normal is the same, as far as a mesh with this mean edge, m, tells them apart.
    pub(super) fn is_like(&self, at: Vec3, normal: Vec3, edge: f32) -> bool {
        (at - self.origin).dot(self.normal).abs() < SAME_PLACE * edge
            && normal.dot(self.normal).abs() > SAME_WAY
    }

    /// Returns true if a cut at a place, m, with this normal runs along the plane.
    pub(super) fn has(&self, at: Vec3, normal: Vec3) -> bool {
        (at - self.origin).dot(self.normal).abs() < self.near
            && normal.dot(self.normal).abs() > ALONG
    }
}

/// Part of a section across its width, about as wide as it is high.
#[derive(Clone, Copy, Default)]
pub(super) struct Column {
    /// Area, m², and the part of it that is cracked.
    pub(super) area: f64,
    cracked: f64,
    /// ∫ y dA of all of it and of the cracked part, and ∫ y² dA, m³ and m⁴, with y along the height.
    first: f64,
    first_cracked: f64,
    second: f64,
    /// Energy release rate, J/m².
    rate: f64,
}

impl Column {
    /// Middle, m.
    pub(super) fn middle(&self) -> f64 {
        self.first / self.area
    }

    /// Height of the strip with its area and moment of inertia, t H³ / 12, m.
    pub(super) fn height(&self) -> f64 {
        let inertia = self.second - self.first * self.first / self.area;
        libm::sqrt(12.0 * inertia.max(0.0) / self.area)
    }

    /// Cracked share of the height, and the side of the crack; no share where it lies in the middle.
    fn crack(&self) -> (f64, f64) {
        if self.cracked <= 0.0 {
            return (0.0, 1.0);
        }
        let share = (self.cracked / self.area).min(strip::MOST);
        let off = self.first_cracked / self.cracked - self.middle();
        let is_edge = off.abs() > ASIDE * self.height() || share > 0.9;
        (if is_edge { share } else { 0.0 }, off.signum())
    }
}

impl Section {
    /// A section with the areas, m², that a plane cuts of tetrahedra at these places. `side`: length that is told apart, m.
    pub(super) fn new(plane: Plane, polygons: &[(Vec2, f32)], side: f32) -> Option<Self> {
        let mut squares = Squares::new(polygons, side)?;
        let [wide, high] = [0, 1].map(|axis| spread(polygons, axis));
        let count = ((wide / high.max(f64::MIN_POSITIVE)).round() as usize).clamp(1, MOST_COLUMNS);
        let mut columns = vec![Column::default(); count];
        for k in 0..squares.list.len() {
            let column = (k % squares.count[0]) * count / squares.count[0];
            squares.list[k].2 = column as u32;
            let (area, y) = (f64::from(squares.list[k].0), squares.y(k));
            let column = &mut columns[column];
            column.area += area;
            column.first += area * y;
            column.second += area * (y * y + f64::from(squares.side * squares.side) / 12.0);
        }
        Some(Self {
            plane,
            squares,
            resultants: vec![0.0; 2 * columns.len()],
            columns,
            nodes: Vec::new(),
            factors: Vec::new(),
            of_modes: Vec::new(),
            of_shapes: Vec::new(),
            stiffness: Vec::new(),
            step: usize::MAX,
            found: 0.0,
            is_fed: true,
            known: false,
        })
    }

    pub(super) fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The column at a place in the section, if it is in one.
    pub(super) fn column(&self, place: Vec2) -> Option<usize> {
        let k = self.squares.of(place)?;
        (self.squares.list[k].0 > 0.0).then_some(self.squares.list[k].2 as usize)
    }

    /// Cracked area, m².
    pub(super) fn cracked(&self) -> f64 {
        self.squares.cracked
    }

    /// Takes in a cut of a crack, of this area, m². What several cuts take of a square counts once.
    pub(super) fn cut(&mut self, at: Vec3, normal: Vec3, area: f32) {
        if !self.plane.has(at, normal) {
            return;
        }
        let Some(k) = self.squares.of(self.plane.place(at)) else {
            return;
        };
        let y = self.squares.y(k);
        let (all, cracked, column) = &mut self.squares.list[k];
        let own = (area * normal.dot(self.plane.normal).abs()).min(*all - *cracked);
        *cracked += own;
        let own = f64::from(own);
        let column = &mut self.columns[*column as usize];
        column.cracked += own;
        column.first_cracked += own * y;
        self.squares.cracked += own;
        self.known = false;
    }

    /// Finds the resultants of a time step of a motion.
    pub(super) fn set_step(&mut self, asset: &Asset, motion: &Motion, step: usize) {
        if self.step == step {
            return;
        }
        let residuals = &motion.complement.residuals;
        for (k, residual) in residuals.iter().enumerate() {
            let known = self.of_shapes.get(k).map(|(shape, _)| shape);
            if !known.is_some_and(|shape| Arc::ptr_eq(shape, &residual.shape)) {
                self.of_shapes.truncate(k);
                let own = self.of_shape(asset, &residual.shape);
                self.of_shapes.push((Arc::clone(&residual.shape), own));
            }
        }
        let modes = self.of_modes.chunks(motion.modes.max(1));
        for (k, (sum, row)) in self.resultants.iter_mut().zip(modes).enumerate() {
            *sum = f64::from(dot(row, motion.at(step)));
            for (residual, (_, own)) in residuals.iter().zip(&self.of_shapes) {
                *sum += own[k] * f64::from(residual.force(step));
            }
        }
        (self.step, self.known) = (step, false);
    }

    /// Resultants of a shape of the body.
    fn of_shape(&self, asset: &Asset, shape: &Shape) -> Vec<f64> {
        let mut sums = vec![0.0; self.resultants.len()];
        for (&node, factors) in self
            .nodes
            .iter()
            .zip(self.factors.chunks(self.columns.len()))
        {
            let u = Vec3::from_array(shape.at(asset, node as usize));
            for (sum, factor) in sums.iter_mut().zip(factors.as_flattened()) {
                *sum += f64::from(factor.dot(u));
            }
        }
        sums
    }

    /// The column that feeds a crack which enters the section at a place that is not cracked yet, m, with this normal.
    pub(super) fn feeding(&self, at: Vec3, normal: Vec3) -> Option<usize> {
        if !self.is_fed || !self.plane.has(at, normal) {
            return None;
        }
        let (all, cracked, column) = self.squares.list[self.squares.of(self.plane.place(at))?];
        (all - cracked > LEFT * all).then_some(column as usize)
    }

    /// Energy release rate of a crack in a column, J/m². `modulus`: E/(1−ν²), Pa.
    pub(super) fn release_rate(&mut self, column: usize, modulus: f64) -> f64 {
        if !std::mem::replace(&mut self.known, true) {
            self.find_rates(modulus);
        }
        self.columns[column].rate
    }

    fn find_rates(&mut self, modulus: f64) {
        let n = 2 * self.columns.len();
        // M is positive where it opens a crack at the lower side; the other side's has the opposite sign.
        let cracks: Vec<(f64, f64)> = self.columns.iter().map(Column::crack).collect();
        let compliances: Vec<[f64; 3]> = (self.columns.iter().zip(&cracks))
            .map(|(column, &(share, side))| {
                let height = column.height();
                let [tt, tb, bb] = strip::integrals(share);
                let scale = std::f64::consts::TAU * height / (modulus * column.area);
                let lever = -side * 6.0 / height;
                [scale * tt, scale * lever * tb, scale * lever * lever * bb]
            })
            .collect();
        let mut matrix = vec![0.0; n * n];
        for i in 0..n {
            for (c, [tt, tb, bb]) in compliances.iter().enumerate() {
                let (x, y) = (
                    self.stiffness[i * n + 2 * c],
                    self.stiffness[i * n + 2 * c + 1],
                );
                matrix[i * n + 2 * c] = x * tt + y * tb;
                matrix[i * n + 2 * c + 1] = x * tb + y * bb;
            }
            matrix[i * n + i] += 1.0;
        }
        let mut relaxed = self.resultants.clone();
        solve(&mut matrix, &mut relaxed);
        for (c, (column, &(share, side))) in self.columns.iter_mut().zip(&cracks).enumerate() {
            let (force, moment) = (relaxed[2 * c], relaxed[2 * c + 1]);
            let lever = -side * 6.0 / column.height();
            let sum = strip::tension(share) * force + strip::bending(share) * lever * moment;
            let stress = sum.max(0.0) / column.area;
            column.rate =
                std::f64::consts::PI * share * column.height() * stress * stress / modulus;
        }
    }
}

/// Solves a small dense system by elimination, row by row; the solution replaces the right-hand side.
fn solve(matrix: &mut [f64], right: &mut [f64]) {
    let n = right.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| {
            let size = |i: usize| matrix[i * n + k].abs();
            size(a).total_cmp(&size(b))
        });
        let pivot = pivot.unwrap_or(k);
        if pivot != k {
            for j in 0..n {
                matrix.swap(k * n + j, pivot * n + j);
            }
            right.swap(k, pivot);
        }
        for i in k + 1..n {
            let factor = matrix[i * n + k] / matrix[k * n + k];
            if factor != 0.0 {
                for j in k..n {
                    matrix[i * n + j] -= factor * matrix[k * n + j];
                }
                right[i] -= factor * right[k];
            }
        }
    }
    for k in (0..n).rev() {
        let sum: f64 = (k + 1..n).map(|j| matrix[k * n + j] * right[j]).sum();
        right[k] = (right[k] - sum) / matrix[k * n + k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEIGHT: f32 = 0.1;
    const WIDTH: f32 = 0.3;
    const MODULUS: f64 = 7e10;

    /// A rectangle of 3 columns, cut from below to a share of its height, under this tension and bending, Pa.
    fn section(share: f32, tension: f64, bending: f64) -> Section {
        let plane = Plane {
            origin: Vec3::ZERO,
            normal: Vec3::Z,
            axes: [Vec3::X, Vec3::Y],
            near: 0.01,
        };
        let side = 0.002;
        let [rows, lines] = [HEIGHT, WIDTH].map(|length| (length / side).round() as usize);
        let places = (0..rows * lines).map(|k| {
            let [x, y] = [k % lines, k / lines].map(|n| (n as f32 + 0.5) * side);
            Vec2::new(x, y)
        });
        let polygons: Vec<(Vec2, f32)> = places.map(|at| (at, side * side)).collect();
        let mut section = Section::new(plane, &polygons, side).expect("a section");
        for &(at, area) in polygons.iter().filter(|p| p.0.y < share * HEIGHT) {
            section.cut(at.extend(0.0), Vec3::Z, area);
        }
        let (area, height) = (section.columns[0].area, section.columns[0].height());
        let resultants = [tension * area, bending * area * height / 6.0];
        section.stiffness = vec![0.0; 36];
        section.resultants = resultants.repeat(3);
        section
    }

    /// Energy release rate of a crack at a place, J/m²; zero where the section does not feed it.
    fn rate_at(section: &mut Section, at: Vec3) -> f64 {
        let column = section.feeding(at, Vec3::Z);
        column.map_or(0.0, |column| section.release_rate(column, MODULUS))
    }

    fn rate(share: f32, tension: f64, bending: f64) -> f64 {
        let ahead = Vec3::new(0.5 * WIDTH, HEIGHT * (share + 0.03), 0.0);
        rate_at(&mut section(share, tension, bending), ahead)
    }

    /// K²/E' of an edge crack, with its stress intensities in tension and bending added up.
    #[test]
    fn an_edge_crack_is_fed_by_its_stress_intensity() {
        for (share, tension, bending) in [(0.2, 1e6, 0.0), (0.5, 0.0, 1e6), (0.7, 1e6, 2e6)] {
            let alpha = f64::from(share);
            let stress = tension * strip::tension(alpha) + bending * strip::bending(alpha);
            let expected = std::f64::consts::PI * alpha * f64::from(HEIGHT) * stress * stress;
            let ratio = rate(share, tension, bending) * MODULUS / expected;
            assert!((ratio - 1.0).abs() < 0.05, "{share}: {ratio}");
        }
    }

    #[test]
    fn pressure_and_cut_places_are_not_fed() {
        assert_eq!(rate(0.3, 0.0, -1e6), 0.0);
        let mut cut = section(0.3, 0.0, 1e6);
        let behind = Vec3::new(0.5 * WIDTH, 0.1 * HEIGHT, 0.0);
        assert_eq!(rate_at(&mut cut, behind), 0.0);
        let aside = Vec3::new(0.5 * WIDTH, 0.5 * HEIGHT, 0.02);
        assert_eq!(rate_at(&mut cut, aside), 0.0);
    }

    /// A section that modes hold stiffly loses its force to the crack.
    #[test]
    fn stiff_modes_let_the_crack_relax_the_section() {
        let mut section = section(0.5, 0.0, 1e6);
        let ahead = Vec3::new(0.5 * WIDTH, 0.53 * HEIGHT, 0.0);
        let free = rate_at(&mut section, ahead);
        for k in 0..6 {
            section.stiffness[7 * k] = 1e9;
        }
        section.known = false;
        assert!(rate_at(&mut section, ahead) < 0.2 * free);
    }
}
