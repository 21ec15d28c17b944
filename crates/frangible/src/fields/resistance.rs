//! Local fracture resistance of a body: its fields, its scatter, and their minimum for the bounds.

use std::sync::Arc;

use super::{Fields, groove::OPEN, scatter::scatter};
use crate::material::Material;
use crate::mesh::TetMesh;

/// Rings of tetrahedra about a place that hold all that lies a mean edge away from it.
const RINGS: usize = 2;

/// Fracture energies of a kind of body.
#[derive(Clone, Debug)]
pub(crate) struct Toughness {
    material: f64,
    fields: Arc<Fields>,
    /// The smallest, J/m².
    pub(crate) least: f64,
    /// The smallest factor of each tetrahedron and of the rings about it; empty where all are the same.
    about: Arc<[f32]>,
}

impl Toughness {
    pub(crate) fn new(material: &Material, fields: &Arc<Fields>, mesh: &TetMesh) -> Self {
        let least = fields.of_tet.iter().map(|f| f64::from(f.toughness));
        let least = least.min_by(f64::total_cmp).unwrap_or(1.0);
        Self {
            material: material.fracture_energy,
            fields: Arc::clone(fields),
            least: material.fracture_energy * least,
            about: least_about(fields, mesh).into(),
        }
    }

    /// The smallest G_c of a tetrahedron and of the two rings about it, J/m²; none where it is the same everywhere.
    pub(super) fn least_about(&self, tet: u32) -> Option<f64> {
        let factor = self.about.get(tet as usize)?;
        Some(self.material * f64::from(*factor))
    }

    /// G_c of a tetrahedron, J/m².
    pub(crate) fn of(&self, tet: u32) -> f64 {
        match self.fields.of_tet.get(tet as usize) {
            Some(f) => self.material * f64::from(f.toughness),
            None => self.material,
        }
    }
}

fn least_about(fields: &Fields, mesh: &TetMesh) -> Vec<f32> {
    let mut least: Vec<f32> = fields.of_tet.iter().map(|f| f.toughness).collect();
    if least.iter().all(|factor| *factor == least[0]) {
        return Vec::new();
    }
    for _ in 0..RINGS {
        let mut of_node = vec![f32::INFINITY; mesh.positions.len()];
        for (nodes, &factor) in mesh.tets.iter().zip(&least) {
            for &node in nodes {
                let here = &mut of_node[node as usize];
                *here = here.min(factor);
            }
        }
        for (nodes, factor) in mesh.tets.iter().zip(&mut least) {
            *factor = nodes
                .iter()
                .fold(*factor, |least, &node| least.min(of_node[node as usize]));
        }
    }
    least
}

/// A strength, Pa, that stays above zero and finite however absurd it is: margins are quotients of it.
fn rounded(strength: f64) -> f32 {
    (strength as f32).clamp(f32::MIN_POSITIVE, f32::MAX)
}

/// A strength, Pa, that stays above zero when it is rounded to four bytes.
fn above_zero(strength: f64) -> f64 {
    strength.max(f64::from(f32::MIN_POSITIVE))
}

/// Strengths and fracture energies of one body.
#[derive(Clone, Debug)]
pub(crate) struct Resistance {
    material: f64,
    fields: Arc<Fields>,
    pub(crate) toughness: Toughness,
    /// R_c of each tetrahedron, Pa, with the scatter of the weak ones; empty where all have the material's.
    of_tet: Arc<[f32]>,
    /// The smallest at a weak tetrahedron, Pa; the material's where there is none.
    pub(crate) weakest: f64,
    /// Factor by which it is stronger than its flaws say ([`Self::strengthened`]).
    strengthened: f64,
    /// Strength that the residual stress adds at its flaws, all of which lie on faces, Pa.
    pressed: f64,
}

impl Resistance {
    pub(crate) fn new(
        material: &Material,
        fields: &Arc<Fields>,
        toughness: Toughness,
        tets: usize,
        weak_tets: &[u32],
        seed: u64,
    ) -> Self {
        let mut body = Self {
            material: material.strength,
            fields: Arc::clone(fields),
            toughness,
            of_tet: Arc::from([]),
            weakest: above_zero(material.strength),
            strengthened: 1.0,
            pressed: material.residual_stress,
        };
        if **fields == Fields::default() && body.pressed <= 0.0 {
            return body;
        }
        let mut of_tet: Vec<f32> = (0..tets).map(|e| rounded(body.painted(e as u32))).collect();
        if fields.weibull_modulus > 0.0 || body.pressed > 0.0 {
            let flaws = (material.weak_point_density * fields.specimen).max(1.0);
            let factor = |e: u32| match fields.weibull_modulus {
                modulus if modulus > 0.0 => {
                    libm::pow(flaws, 1.0 / modulus) * scatter(seed, e, modulus)
                }
                _ => 1.0,
            };
            for &e in weak_tets {
                of_tet[e as usize] = match body.groove(e) {
                    Some(groove) => rounded(groove.min(body.material * factor(e) + body.pressed)),
                    None => rounded(body.painted(e) * factor(e) + body.pressed),
                };
            }
        }
        let weakest = weak_tets.iter().map(|&e| of_tet[e as usize]);
        body.weakest = weakest
            .min_by(f32::total_cmp)
            .map_or(above_zero(material.strength), f64::from);
        body.of_tet = of_tet.into();
        body
    }

    /// With its strength times `factor`, and the toughness as before.
    pub(crate) fn strengthened(&self, factor: f32) -> Self {
        let factor = factor.max(f32::MIN_POSITIVE);
        Self {
            material: self.material * f64::from(factor),
            of_tet: (self.of_tet.iter())
                .map(|&r| rounded(f64::from(r) * f64::from(factor)))
                .collect(),
            weakest: above_zero(self.weakest * f64::from(factor)),
            strengthened: self.strengthened * f64::from(factor),
            ..self.clone()
        }
    }

    /// Returns true if its strength falls with the time that a load lasts.
    pub(crate) fn tires(&self) -> bool {
        self.fields.fatigue.is_some()
    }

    /// Share of the strength of a weak point of strength R, Pa, that is left after a load has lasted so long, s.
    pub(crate) fn left_after(&self, duration: f64, strength: f64) -> f64 {
        match &self.fields.fatigue {
            Some(fatigue) if duration > 0.0 => {
                fatigue.left_after(duration, strength, self.material)
            }
            _ => 1.0,
        }
    }

    /// With the strength that is left after a load of this duration, s; `tets`: number of tetrahedra of the body's mesh.
    pub(crate) fn tired(&self, duration: f64, tets: usize, weak_tets: &[u32]) -> Self {
        let mut of_tet: Vec<f32> = (0..tets as u32).map(|e| self.strength(e)).collect();
        for &e in weak_tets {
            let strength = &mut of_tet[e as usize];
            // Flaws grow only by the tension that the residual stress leaves.
            let pressed = self.pressed_at(e).min(f64::from(*strength));
            let own = f64::from(*strength) - pressed;
            *strength = rounded(own * self.left_after(duration, own) + pressed);
        }
        let mut tired = Self {
            of_tet: of_tet.into(),
            ..self.clone()
        };
        tired.weakest = tired.of_part(weak_tets).weakest;
        tired
    }

    /// The resistance of a part of the body, with these weak tetrahedra.
    pub(crate) fn of_part(&self, weak_tets: &[u32]) -> Self {
        let weakest = weak_tets.iter().map(|&e| self.strength(e));
        let weakest = weakest.min_by(f32::total_cmp);
        Self {
            weakest: match weakest {
                Some(weakest) if !self.of_tet.is_empty() => f64::from(weakest),
                _ => above_zero(self.material),
            },
            ..self.clone()
        }
    }

    /// R_c that a crack must pass to start in a tetrahedron, Pa.
    pub(crate) fn strength(&self, tet: u32) -> f32 {
        let own = self.of_tet.get(tet as usize);
        own.copied().unwrap_or_else(|| rounded(self.material))
    }

    /// Depth of the flaw that a weak tetrahedron stands for, m: that of its own strength, and no deeper than that of the material's. A body
    /// that was strengthened keeps its flaws.
    pub(crate) fn flaw_depth(&self, material: &Material, tet: u32) -> f32 {
        // The shape factor of a groove takes the decrease of the stress over its depth into account.
        if self.groove(tet).is_some() {
            return 0.0;
        }
        let own = f64::from(self.strength(tet)) / self.strengthened - self.pressed;
        let largest = own.max(self.painted(tet) / self.strengthened);
        material.flaw_depth(self.toughness.of(tet), largest) as f32
    }

    /// R_c of a place without the scatter of its weak points, Pa: for cracks that run there.
    pub(crate) fn painted(&self, tet: u32) -> f64 {
        match self.fields.of_tet.get(tet as usize) {
            Some(f) if f.groove > 0.0 => self.material * f64::from(f.strength.min(1.0)),
            Some(f) => self.material * f64::from(f.strength),
            None => self.material,
        }
    }

    /// Part of the strength of a weak tetrahedron that is residual stress, Pa. That of a groove follows from its depth ([`Fields`]), and is no part.
    pub(crate) fn pressed_at(&self, tet: u32) -> f64 {
        match self.is_grooved(tet) {
            true => 0.0,
            false => self.pressed,
        }
    }

    /// Returns true if a tetrahedron lies in a groove through the compressed layer of a tempered wall.
    pub(crate) fn is_open(&self, tet: u32) -> bool {
        self.pressed > 0.0 && self.groove(tet).is_some_and(|groove| groove <= 2.0 * OPEN)
    }

    /// Returns true if a tetrahedron lies in a groove.
    pub(crate) fn is_grooved(&self, tet: u32) -> bool {
        self.groove(tet).is_some()
    }

    /// Strength of the groove at a tetrahedron, Pa.
    fn groove(&self, tet: u32) -> Option<f64> {
        let factors = self.fields.of_tet.get(tet as usize)?;
        (factors.groove > 0.0).then(|| self.material * f64::from(factors.strength))
    }

    /// The smallest strength of some tetrahedra, Pa.
    pub(crate) fn weakest_of(&self, tets: &[u32]) -> f32 {
        if self.of_tet.is_empty() {
            return rounded(self.material);
        }
        let strengths = tets.iter().map(|&e| self.strength(e));
        strengths.min_by(f32::total_cmp).unwrap_or(f32::INFINITY)
    }

    /// Converts a stress scaled to the weakest point's strength to the equivalent stress at a point of this strength, rounded down, Pa.
    pub(crate) fn at_strength(&self, felt: f32, strength: f32) -> f32 {
        if self.of_tet.is_empty() {
            felt
        } else {
            felt * (strength / self.weakest as f32) * (1.0 - 1e-6)
        }
    }

    /// Scales a stress at a point of this strength to the strength of the weakest point, Pa, keeping the ratio of stress to strength.
    pub(crate) fn as_weakest(&self, stress: f32, strength: f32) -> f32 {
        if self.of_tet.is_empty() {
            stress
        } else {
            (f64::from(stress) * (self.weakest / f64::from(strength))) as f32
        }
    }
}
