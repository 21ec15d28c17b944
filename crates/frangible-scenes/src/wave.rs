//! The microseconds of a break: the tension that runs over the surface of the body, and the cracks with it.

use frangible::glam::Vec3;
use frangible::internals::stress::largest_eigenvalue;
use frangible::internals::{ElementTrace, ShownStress, impact_traced};
use frangible::{Asset, InputError};

use crate::first_break::FirstBreak;

/// Time for which a break is looked at, over the time at which its last crack grew.
const AFTERWARDS: f64 = 1.15;

/// Rounds in which places without a number of their own take the mean of their neighbours.
const ROUNDS: usize = 8;

/// A break, microsecond by microsecond: the surface of the body as it lay when it was hit, which does not move in so short a time.
#[derive(Clone, Debug, Default)]
pub struct Wave {
    /// Places of the surface, m.
    pub positions: Vec<Vec3>,
    /// Places of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The tension at evenly spaced times.
    pub moments: Vec<WaveMoment>,
    /// Cuts of cracks through the surface, in the order of time.
    pub cuts: Vec<SurfaceCut>,
    /// Strength of the weakest place of the body, Pa.
    pub strength: f64,
}

/// The surface at one time.
#[derive(Clone, Debug, Default)]
pub struct WaveMoment {
    /// Time since the blow began, s.
    pub time: f64,
    /// Largest principal stress at each place of the surface, Pa; below zero if all are pressures.
    pub tension: Vec<f32>,
    /// Force of all contacts, N.
    pub force: f64,
}

/// A line along which a crack cuts a triangle of the surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceCut {
    /// Time, s since the blow began.
    pub time: f64,
    /// Its ends, m.
    pub ends: [Vec3; 2],
    /// Unit normal of the surface there, outwards.
    pub normal: Vec3,
}

impl FirstBreak {
    /// Computes the tension at `moments` evenly spaced times, from the beginning of the blow until shortly after the last crack grew.
    /// `progress` gets the share that is done.
    ///
    /// The tension is that of the unbroken body in the motion that cracks run under: cracks release it about them, which is not shown.
    ///
    /// # Errors
    /// As [`frangible::impact()`].
    pub fn wave(&self, moments: usize, progress: &mut dyn FnMut(f64)) -> Result<Wave, InputError> {
        let asset = &**self.body.asset();
        let (outcome, trace) = impact_traced(&self.body, &self.contacts, &self.config)?;
        let report = outcome.report();
        let elements = || trace.cracks.iter().flatten().filter(|e| e.time.is_finite());
        let last = elements().map(|e| e.time).fold(0.0, f64::max);
        let length = (AFTERWARDS * last).max(report.contact_duration);
        let place = |v: u32| self.rotation * asset.fracture().positions[v as usize];
        let surface = Surface::of(asset);
        let mut stress = ShownStress::new(&self.body, &self.config, &trace.pressed, &trace.motion);
        let mut wave = Wave {
            positions: surface.nodes.iter().map(|&v| place(v)).collect(),
            triangles: surface.triangles.clone(),
            moments: Vec::with_capacity(moments),
            cuts: surface_cuts(asset, elements(), place),
            strength: self.body.weakest(),
        };
        for moment in 0..moments {
            progress(moment as f64 / moments as f64);
            let time = length * moment as f64 / (moments.max(2) - 1) as f64;
            let mut of_triangle = vec![f32::NAN; surface.triangles.len()];
            if let Some(step) = trace.motion.step_at(time, report.time_step) {
                for (triangle, stress) in stress.on_surface(step) {
                    of_triangle[triangle as usize] = largest_eigenvalue(&stress);
                }
            }
            let at = (time / report.time_step) as usize;
            let force = report.contacts.iter().filter_map(|c| c.force.get(at));
            wave.moments.push(WaveMoment {
                time,
                tension: surface.spread(&of_triangle),
                force: force.fold(0.0, |sum, &f| sum + f64::from(f)),
            });
        }
        Ok(wave)
    }
}

/// Cuts of these tetrahedra of cracks through the surface of a body, in the order of time. `place`: position of a node of the fracture mesh, m.
#[must_use]
pub fn surface_cuts<'a>(
    asset: &Asset,
    elements: impl IntoIterator<Item = &'a ElementTrace>,
    place: impl Fn(u32) -> Vec3,
) -> Vec<SurfaceCut> {
    let behind = triangles_behind(asset);
    let mut cuts = Vec::new();
    for element in elements {
        let nodes = asset.fracture().tets[element.tet as usize];
        let value = |v: u32| {
            let at = nodes.iter().position(|&n| n == v)?;
            Some(element.values[at])
        };
        for &triangle in &behind[element.tet as usize] {
            let corners = asset.surface().triangles[triangle as usize];
            let [Some(a), Some(b), Some(c)] = corners.map(value) else {
                continue;
            };
            let corners = corners.map(&place);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            cuts.extend(line(corners, [a, b, c]).map(|ends| SurfaceCut {
                time: element.time,
                ends,
                normal: normal.normalize_or(Vec3::Y),
            }));
        }
    }
    cuts.sort_by(|a, b| a.time.total_cmp(&b.time));
    cuts
}

impl Wave {
    /// The tension that a share of all places and moments stays below, Pa.
    #[must_use]
    pub fn quantile(&self, share: f64) -> f32 {
        let mut all: Vec<f32> = self
            .moments
            .iter()
            .flat_map(|m| &m.tension)
            .copied()
            .collect();
        if all.is_empty() {
            return 0.0;
        }
        let place = ((all.len() - 1) as f64 * share.clamp(0.0, 1.0)) as usize;
        *all.select_nth_unstable_by(place, f32::total_cmp).1
    }
}

/// The triangles of the surface in front of each tetrahedron.
fn triangles_behind(asset: &Asset) -> Vec<Vec<u32>> {
    let mut behind = vec![Vec::new(); asset.fracture().tets.len()];
    for (triangle, &tet) in (0..).zip(&asset.surface().tets) {
        behind[tet as usize].push(triangle);
    }
    behind
}

/// Ends of the line on which a number given at the corners of a triangle is zero; zero counts as positive.
fn line(corners: [Vec3; 3], values: [f32; 3]) -> Option<[Vec3; 2]> {
    let mut ends = [Vec3::ZERO; 2];
    let mut count = 0;
    for i in 0..3 {
        let j = (i + 1) % 3;
        if (values[i] >= 0.0) != (values[j] >= 0.0) {
            ends[count] = corners[i].lerp(corners[j], values[i] / (values[i] - values[j]));
            count += 1;
        }
    }
    (count == 2).then_some(ends)
}

/// The outer surface with its own places, and the triangles around each.
struct Surface {
    nodes: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    around: Vec<Vec<u32>>,
}

impl Surface {
    fn of(asset: &Asset) -> Self {
        let mut number = vec![u32::MAX; asset.fracture().positions.len()];
        let mut nodes = Vec::new();
        let triangles = (asset.surface().triangles.iter())
            .map(|triangle| {
                triangle.map(|v| {
                    if number[v as usize] == u32::MAX {
                        number[v as usize] = nodes.len() as u32;
                        nodes.push(v);
                    }
                    number[v as usize]
                })
            })
            .collect::<Vec<[u32; 3]>>();
        let mut around = vec![Vec::new(); nodes.len()];
        for (triangle, corners) in (0..).zip(&triangles) {
            corners
                .iter()
                .for_each(|&v| around[v as usize].push(triangle));
        }
        Self {
            nodes,
            triangles,
            around,
        }
    }

    /// A number at each place, of those at triangles, some of which have none (NaN).
    fn spread(&self, of_triangle: &[f32]) -> Vec<f32> {
        let mean = |numbers: &mut dyn Iterator<Item = f32>| {
            let (mut sum, mut count) = (0.0, 0);
            for number in numbers.filter(|n| !n.is_nan()) {
                sum += number;
                count += 1;
            }
            if count > 0 {
                sum / count as f32
            } else {
                f32::NAN
            }
        };
        let mut at: Vec<f32> = (self.around.iter())
            .map(|around| mean(&mut around.iter().map(|&t| of_triangle[t as usize])))
            .collect();
        for _ in 0..ROUNDS {
            if !at.iter().any(|n| n.is_nan()) {
                break;
            }
            let before = at.clone();
            for (v, number) in at.iter_mut().enumerate().filter(|(_, n)| n.is_nan()) {
                let corners = self.around[v]
                    .iter()
                    .flat_map(|&t| self.triangles[t as usize]);
                *number = mean(&mut corners.map(|w| before[w as usize]));
            }
        }
        at.into_iter()
            .map(|n| if n.is_nan() { 0.0 } else { n })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crack_cuts_a_triangle_where_its_number_is_zero() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let cut = line(corners, [-1.0, 3.0, 1.0]).unwrap();
        assert_eq!(cut, [Vec3::X * 0.25, Vec3::Y * 0.5]);
        assert!(line(corners, [1.0, 3.0, 0.0]).is_none());
    }

    #[test]
    fn places_without_a_number_take_that_of_their_neighbours() {
        let surface = Surface {
            nodes: vec![0, 1, 2, 3],
            triangles: vec![[0, 1, 2], [1, 3, 2]],
            around: vec![vec![0], vec![0, 1], vec![0, 1], vec![1]],
        };
        assert_eq!(surface.spread(&[f32::NAN, 3.0]), [3.0; 4]);
        assert_eq!(surface.spread(&[f32::NAN; 2]), [0.0; 4]);
        assert_eq!(surface.spread(&[1.0, 3.0]), [1.0, 2.0, 2.0, 3.0]);
    }
}
