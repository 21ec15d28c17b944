//! Four triangles side by side, the unit that queries work on.

use glam::DVec3;

/// Triangles per packet and children per node. Loops of this length become vector instructions.
pub(super) const WIDTH: usize = 4;

/// One number per triangle or child.
pub(super) type Lanes = [f64; WIDTH];

/// Up to four triangles. A spare lane holds the first corner of the first triangle three times: no area, and never
/// closer than that triangle.
#[derive(Clone, Debug)]
pub(super) struct Packet {
    /// Coordinates by corner, axis and lane, m.
    pub(super) corners: [[Lanes; 3]; 3],
    /// Index of each triangle in the surface.
    pub(super) faces: [u32; WIDTH],
}

impl Packet {
    /// Packs one to four triangles with their indices.
    pub(super) fn new(triangles: impl Iterator<Item = (u32, [DVec3; 3])>) -> Self {
        let mut packet = Self {
            corners: [[[0.0; WIDTH]; 3]; 3],
            faces: [0; WIDTH],
        };
        for (lane, (face, corners)) in triangles.take(WIDTH).enumerate() {
            if lane == 0 {
                for spare in 0..WIDTH {
                    packet.set(spare, face, [corners[0]; 3]);
                }
            }
            packet.set(lane, face, corners);
        }
        packet
    }

    fn set(&mut self, lane: usize, face: u32, corners: [DVec3; 3]) {
        self.faces[lane] = face;
        for (slot, corner) in self.corners.iter_mut().zip(corners) {
            for axis in 0..3 {
                slot[axis][lane] = corner[axis];
            }
        }
    }

    /// Corner positions of the triangle in `lane`, m.
    pub(super) fn triangle(&self, lane: usize) -> [DVec3; 3] {
        self.corners
            .map(|[x, y, z]| DVec3::new(x[lane], y[lane], z[lane]))
    }
}

/// Half the cross product of two sides: the normal, as long as the area, m².
pub(super) fn area_vector([a, b, c]: [DVec3; 3]) -> DVec3 {
    0.5 * (b - a).cross(c - a)
}
