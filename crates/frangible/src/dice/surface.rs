//! Triangles of dice.

use super::network::{NONE, Network};

/// A corner of a triangle: a point of the network, on its upper (0) or its lower (1) face.
pub(super) type Corner = (u32, usize);

impl Network {
    /// Triangles of a die on the two faces of the wall.
    pub(super) fn faces_of(&self, die: u32) -> impl Iterator<Item = [Corner; 3]> + '_ {
        let apex = die;
        let corners = self.corners_of(die);
        let sides = (0..corners.len()).map(move |k| {
            let [a, b] = [k, (k + 1) % corners.len()].map(|k| corners[k][0]);
            [a, b]
        });
        let fan = sides.filter(move |side| !side.contains(&apex));
        fan.flat_map(move |[a, b]| [[(apex, 0), (a, 0), (b, 0)], [(apex, 1), (b, 1), (a, 1)]])
    }

    /// The sides of a die that one of these dice lies behind, [`NONE`] being the edge of the wall: two triangles each, and that die.
    pub(super) fn sides_of(&self, die: u32) -> impl Iterator<Item = ([[Corner; 3]; 2], u32)> + '_ {
        let corners = self.corners_of(die);
        (0..corners.len()).map(move |k| {
            let [a, neighbour] = corners[k];
            let b = corners[(k + 1) % corners.len()][0];
            // The diagonal goes down to the smaller point, from whichever side it is seen.
            let triangles = match a < b {
                true => [[(a, 1), (b, 1), (b, 0)], [(a, 1), (b, 0), (a, 0)]],
                false => [[(a, 1), (b, 1), (a, 0)], [(b, 1), (b, 0), (a, 0)]],
            };
            (triangles, neighbour)
        })
    }

    /// All triangles of a die.
    pub(super) fn triangles_of(&self, die: u32) -> impl Iterator<Item = [Corner; 3]> + '_ {
        self.faces_of(die)
            .chain(self.sides_of(die).flat_map(|(triangles, _)| triangles))
    }

    /// Dice beside a die.
    pub(super) fn neighbours(&self, die: u32) -> impl Iterator<Item = u32> + '_ {
        let all = self.corners_of(die).iter().map(|&[_, neighbour]| neighbour);
        all.filter(|&neighbour| neighbour != NONE)
    }
}
