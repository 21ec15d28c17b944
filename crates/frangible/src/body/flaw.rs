//! The flaw size of weak points (an extension of the paper).
//!
//! By Griffith's criterion, a strength R and a toughness K_Ic correspond to a flaw of depth `a = (K_Ic / Y R)² / π`, with Y = 1.12 for a long,
//! shallow flaw. If the stress varies over the flaw, its mean over the flaw size and not its peak decides: a narrow peak must exceed the
//! strength considerably, a uniform tension only just. The mean is taken over the part of a ball about the weak point that lies in the body.
//!
//! The flaw is no larger than that of the specimen strength R_s, and no deeper than half of the body's thickness H:
//! `a = min(a(R), a(R_s), H/2)`. A beam in bending then withstands 1.2 to 1.8 times R_s, as with cohesive cracks.
//!
//! If the ball is smaller than the weak point's tetrahedron, the stress at the weak point is used.

use glam::{Mat3, Vec3};

use super::Body;
use crate::asset::Asset;

/// Directions to the corners of an icosahedron over the golden ratio, and of a cube.
const OUTER: [[f32; 3]; 12] = {
    const S: f32 = 0.525_731_1;
    const L: f32 = 0.850_650_8;
    [
        [0.0, S, L],
        [0.0, S, -L],
        [0.0, -S, L],
        [0.0, -S, -L],
        [S, L, 0.0],
        [S, -L, 0.0],
        [-S, L, 0.0],
        [-S, -L, 0.0],
        [L, 0.0, S],
        [-L, 0.0, S],
        [L, 0.0, -S],
        [-L, 0.0, -S],
    ]
};
const INNER: [[f32; 3]; 8] = {
    const S: f32 = 0.577_350_3;
    [
        [S, S, S],
        [S, S, -S],
        [S, -S, S],
        [S, -S, -S],
        [-S, S, S],
        [-S, S, -S],
        [-S, -S, S],
        [-S, -S, -S],
    ]
};

/// Radii at which the samples lie, relative to the ball's: each sample stands for the same volume, 1/21 of it.
const OUTER_RADIUS: f32 = 0.894;
const INNER_RADIUS: f32 = 0.620;

impl Body {
    /// Depth of the flaw that a weak tetrahedron stands for, m; 0 where it is smaller than the tetrahedron.
    pub(crate) fn flaw_depth(&self, tet: u32) -> f32 {
        let mesh = &self.asset.fracture;
        let depth = self.resistance.flaw_depth(&self.asset.material, tet);
        let depth = depth.min(0.5 * self.prepared.thickness[tet as usize]);
        let ball = 4.0 / 3.0 * std::f64::consts::PI * f64::from(depth).powi(3);
        if ball > mesh.volume(tet as usize) {
            depth
        } else {
            0.0
        }
    }

    /// Tetrahedra at whose centres the stress is sampled over the flaw of a weak one, `place` that of the weak point, m: those of the
    /// ball's samples that lie in the body, as often as they hold one. None where the flaw is smaller than the tetrahedron.
    pub(crate) fn flaw_samples(&self, tet: u32, place: Vec3) -> Vec<u32> {
        let depth = self.flaw_depth(tet);
        if depth <= 0.0 {
            return Vec::new();
        }
        let mesh = &self.asset.fracture;
        // Along the tetrahedron's own axes, so that a body that is turned has the same samples.
        let [a, b, c, _] = mesh.corners(tet as usize);
        let along = (b - a).normalize_or(Vec3::X);
        let across = along.cross(c - a).normalize_or(Vec3::Y);
        let axes = Mat3::from_cols(along, across.cross(along), across) * depth;
        let at = |radius: f32| move |d: &[f32; 3]| place + axes * (Vec3::from_array(*d) * radius);
        let inner = INNER.iter().map(at(INNER_RADIUS));
        let outer = OUTER.iter().map(at(OUTER_RADIUS));
        let samples = inner.chain(outer).filter_map(|p| mesh.locate(tet, p));
        samples.filter(|&t| has(&self.asset, t)).collect()
    }
}

/// Returns true if a fracture tetrahedron is the body's own.
fn has(asset: &Asset, tet: u32) -> bool {
    let portion = asset.portion.as_ref();
    portion.is_none_or(|portion| portion.tets().binary_search(&tet).is_ok())
}
