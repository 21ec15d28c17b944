//! Energy that feeds a crack's front (beyond the paper): Griffith's energy release rate of a crack of its present size.
//!
//! Per area a crack of area A and live front L gains the energy of a layer of depth `(16/π) A/L` under the tension σ across it, σ²/2E', which is
//! `K² / E'` of a penny; 1.21 times as deep where it starts at a surface. It grows no more once the crack is as large as the body has room for: a
//! penny as wide as the body is thick, or half a penny as deep. The paper's depth γ is the same for cracks of all sizes `[G12 Eq. 12]`.
//!
//! A crack begins as the flaw that it starts from, and a flaw may run at its strength R: until the crack is larger its depth is that which pays for
//! it there, `2 E' G_c / R²`.

use std::f64::consts::PI;

use glam::Vec3;

use super::felt::Felt;
use super::field::StressField;
use super::release::once;
use super::single::{Crack, ElementCut, Front};
use super::system::{CrackSystem, ELSEWHERE, UNCUT};
use crate::mesh::{FACES, NO_NEIGHBOUR};
use crate::stress::Symmetric3;
use crate::tips::crossing_length;

/// Depth over A/L: 2.55 times the radius of a penny.
const PENNY: f64 = 16.0 / PI;

/// More of it at a free surface: the square of 1.1.
const AT_SURFACE: f64 = 1.21;

/// Depth that feeds a crack as large as a body of unit thickness has room for: a penny inside, half a penny at the surface.
const INSIDE_MOST: f64 = PENNY / 4.0;
const AT_SURFACE_MOST: f64 = AT_SURFACE * PENNY / 2.0;

impl CrackSystem<'_> {
    /// Depth of the layer that feeds a front of a crack at a tetrahedron, which is part of a wall or not, m.
    pub(super) fn depth(&self, crack: &Crack, tet: u32, in_wall: bool) -> f64 {
        if self.resistance.is_grooved(tet) {
            return self.paid_at_strength(tet);
        }
        let surface = if crack.at_surface { AT_SURFACE } else { 1.0 };
        let grown = surface * PENNY * crack.area / crack.front.max(f64::MIN_POSITIVE);
        let most = self.most_depth(tet, crack.at_surface || in_wall);
        crack.flaw.max(grown).min(most)
    }

    /// Depth of the layer that feeds the flaw of a weak tetrahedron, m: at its strength it pays for the crack, unless the body has no room for one
    /// that large. `at_surface`: true if it lies on a free surface, or in a wall.
    pub(super) fn flaw_feed(&self, tet: u32, at_surface: bool) -> f64 {
        let depth = self.paid_at_strength(tet);
        match self.resistance.is_grooved(tet) {
            true => depth,
            false => depth.min(self.most_depth(tet, at_surface)),
        }
    }

    /// Depth of the layer whose energy pays for a crack at the strength of a tetrahedron, m.
    fn paid_at_strength(&self, tet: u32) -> f64 {
        let strength = f64::from(self.resistance.strength(tet));
        let toughness = self.resistance.toughness.of(tet);
        2.0 * self.asset.material.contact_modulus() * toughness / (strength * strength)
    }

    /// Depth of the layer that feeds the largest crack that a body has room for at a tetrahedron, m.
    fn most_depth(&self, tet: u32, at_surface: bool) -> f64 {
        let most = match at_surface {
            true => AT_SURFACE_MOST,
            false => INSIDE_MOST,
        };
        most * f64::from(self.thickness[tet as usize])
    }

    /// Energy that an area, m², of a front sets free, J `[G12 Eq. 12]`; where it is no more than `enough`, a bound. `normal`: unit normal of the
    /// crack there, at this place, m.
    ///
    /// In a solid other cracks release the front. In a wall they release only weak points and forks.
    pub(super) fn gain(
        &mut self,
        front: &Front,
        felt: &Felt,
        (normal, at, area): (Vec3, Vec3, f32),
        enough: f64,
        field: &StressField,
    ) -> f64 {
        let material = &self.asset.material;
        if self.config.is_paper() {
            let density = f64::from(felt.state.energy_density);
            return f64::from(area) * material.energy_depth * density;
        }
        let by_section = self.section_feed(front, at, normal, field);
        let crack = &self.cracks[front.crack as usize];
        let modulus = material.contact_modulus();
        let per_area = match self.tip_depth(front) {
            Some(depth) => {
                let opening = felt.opening(normal, material.poisson_ratio);
                depth * 0.5 * opening * opening / modulus
            }
            None => {
                self.depth(crack, front.tet, felt.wall.is_some())
                    * felt.energy_across(normal, modulus)
            }
        };
        let whole = f64::from(area) * per_area.max(by_section);
        if felt.wall.is_some() || per_area <= by_section || whole <= enough {
            return whole;
        }
        // Both are squares of the tension across.
        let across = |stress: &Symmetric3| f64::from(normal.dot(stress.times(normal)));
        let before = across(&felt.state.stress);
        let gain = |left: &Symmetric3| {
            let left = (across(left) / before).max(0.0);
            f64::from(area) * (per_area * left * left).max(by_section)
        };
        let place = (front.crack, at);
        let left = once(
            self,
            place,
            felt.state.stress,
            None,
            front.arrival,
            |left| gain(left) > enough,
        );
        left.map_or(f64::from(area) * by_section, |left| gain(&left))
    }

    /// Keeps the length of the live fronts when a crack cuts a tetrahedron: its own front moves on, and that of a crack which it meets ends.
    pub(super) fn move_front(&mut self, crack: u32, cut: &ElementCut) {
        let mesh = &self.asset.fracture;
        let x = mesh.corners(cut.tet as usize);
        for (face, &n) in FACES.iter().zip(&mesh.neighbours[cut.tet as usize]) {
            if n == NO_NEIGHBOUR {
                continue;
            }
            let by = self.fractured_by[n as usize];
            let corners = face.map(|i| x[i]);
            if by == UNCUT {
                let length = crossing_length(&corners, &face.map(|i| cut.values[i]));
                self.cracks[crack as usize].front += f64::from(length);
            } else if by != ELSEWHERE {
                let met = &mut self.cracks[by as usize];
                let other = met.elements[self.cut_at[n as usize] as usize];
                let nodes = mesh.tets[n as usize];
                let values = face.map(|i| {
                    let node = mesh.tets[cut.tet as usize][i];
                    let at = nodes.iter().position(|&v| v == node);
                    at.map_or(0.0, |at| other.values[at])
                });
                met.front -= f64::from(crossing_length(&corners, &values));
            }
        }
    }
}
