//! Moves vertices along the sheet: evenly, or by lot.

use frangible_geometry::Rows;
use glam::DVec3;

use super::lines::Lines;
use super::sheet::{Kind, Sheet, smallest_angle};
use super::surface::Reference;
use crate::random;

/// Share of the way to the middle of its neighbours that a vertex moves.
const STEP: f64 = 0.7;
/// A move leaves no angle below this, degrees, unless it was smaller before.
const ANGLE: f64 = 20.0;
/// Cosine of the largest turn of a triangle by a move.
const TURN: f64 = 0.5;

/// What a move of vertices needs to know.
pub(crate) struct Ground<'a> {
    pub(crate) lines: &'a Lines,
    pub(crate) reference: &'a Reference,
    /// Wanted length of edges, m.
    pub(crate) edge: f64,
}

impl Ground<'_> {
    /// Moves every vertex most of the way to the middle of its neighbours, `rounds` times.
    pub(crate) fn relax(&self, sheet: &mut Sheet, rounds: usize) {
        let around = sheet.around();
        for _ in 0..rounds {
            for v in 0..sheet.positions.len() as u32 {
                let here = sheet.at(v);
                let (mut sum, mut count) = (DVec3::ZERO, 0.0);
                for &t in around.of(v) {
                    for w in sheet.triangles[t as usize] {
                        let is_line = sheet.kind(v) != Kind::Free;
                        if w != v && (!is_line || sheet.sharp_at(v, w).is_some()) {
                            // Along the edge of a sheet, one neighbour is met once and the other once; within, both twice.
                            sum += sheet.at(w) - here;
                            count += 1.0;
                        }
                    }
                }
                if count > 0.0 {
                    self.shift(sheet, &around, v, STEP / count * sum);
                }
            }
        }
    }

    /// Moves every vertex by up to `amount` metres, by lot.
    pub(crate) fn jitter(&self, sheet: &mut Sheet, amount: f64, seed: u64) {
        let around = sheet.around();
        for v in 0..sheet.positions.len() as u32 {
            let lot = |axis: u64| random::symmetric(seed, 3 * u64::from(v) + axis);
            let by = amount * DVec3::new(lot(0), lot(1), lot(2));
            if !self.shift(sheet, &around, v, by) {
                self.shift(sheet, &around, v, 0.5 * by);
            }
        }
    }

    /// Moves a vertex along the sheet, unless that spoils a triangle.
    fn shift(&self, sheet: &mut Sheet, around: &Rows, v: u32, by: DVec3) -> bool {
        let (here, kind) = (sheet.at(v), sheet.kind(v));
        let near = around.of(v);
        let facing: Vec<DVec3> = near
            .iter()
            .map(|&t| sheet.normal(sheet.triangles[t as usize]))
            .collect();
        let worst = |sheet: &Sheet| {
            near.iter()
                .map(|&t| smallest_angle(sheet.triangles[t as usize].map(|v| sheet.at(v))))
                .fold(180.0, f64::min)
        };
        let limit = ANGLE.min(worst(sheet));
        match kind {
            Kind::Corner => return false,
            Kind::Line(_) => {
                sheet.positions[v as usize] = here + by;
                sheet.onto_line(v, self.lines);
            }
            Kind::Free => {
                let normal = facing.iter().sum::<DVec3>().normalize_or_zero();
                let along = by - by.dot(normal) * normal;
                let place = self.reference.closest(here + along, self.edge);
                sheet.positions[v as usize] = place;
            }
        }
        let upright = near.iter().zip(&facing).all(|(&t, before)| {
            let after = sheet.normal(sheet.triangles[t as usize]);
            after.dot(*before) > TURN * after.length() * before.length()
        });
        let good = upright && worst(sheet) >= limit;
        if !good {
            sheet.positions[v as usize] = here;
            sheet.kinds[v as usize] = kind;
        }
        good
    }
}
