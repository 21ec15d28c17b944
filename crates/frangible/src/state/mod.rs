//! Memory of a body: the cracks that have not parted it yet.
//!
//! Small, and all there is besides the asset and the seed: saved, sent over a network, or rebuilt bit for bit by replaying
//! the impacts.

mod crossing;
mod cuts;

use glam::Vec3;

use crate::error::InputError;
use crate::mesh::TetMesh;

pub(crate) use crossing::{
    crossing, crossing_area, crossing_middle, crossing_polygon, nominal_area, nominal_crossing,
};
pub(crate) use cuts::{Cuts, EdgeCut};

/// Cracks of a body that is still one piece.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BodyState {
    pub(crate) cracks: Vec<OldCrack>,
}

/// A crack as it was left.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OldCrack {
    /// Tetrahedron where it started.
    pub(crate) start: u32,
    /// Place in that tetrahedron through which it went first, m.
    pub(crate) origin: Vec3,
    /// Its normal there.
    pub(crate) normal: Vec3,
    /// Tetrahedra it has cut, in their order.
    pub(crate) cuts: Vec<OldCut>,
    /// Number of them, from the first, that were cut before the piece came about.
    pub(crate) settled: u32,
    /// Junctions: place in `cuts` of the front that met a crack, and true if the crack met itself.
    pub(crate) junctions: Vec<(u32, bool)>,
}

/// A tetrahedron that a crack has cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OldCut {
    /// Its number.
    pub tet: u32,
    /// Signed distances of its nodes from the crack, m.
    pub values: [f32; 4],
    /// Unit normal of the crack, towards the nodes of positive distance.
    pub direction: Vec3,
}

/// Starts a state in bytes; the digit is its version.
const MAGIC: &[u8; 8] = b"FRCRACK3";

impl BodyState {
    /// Returns true if the body is as it was made.
    #[must_use]
    pub fn is_intact(&self) -> bool {
        self.cracks.is_empty()
    }

    /// Number of cracks.
    #[must_use]
    pub fn cracks(&self) -> usize {
        self.cracks.len()
    }

    /// The tetrahedra that the cracks have cut, crack by crack.
    pub fn cuts(&self) -> impl Iterator<Item = &OldCut> {
        self.cracks.iter().flat_map(|crack| &crack.cuts)
    }

    /// The faces of the cracks in the fracture mesh of their body, for drawing: a polygon of three or four corners per tetrahedron cut, m.
    pub fn faces<'a>(&'a self, mesh: &'a TetMesh) -> impl Iterator<Item = ([Vec3; 4], usize)> + 'a {
        let cuts = self.cuts();
        cuts.map(|cut| crossing_polygon(&mesh.corners(cut.tet as usize), &cut.values))
    }

    /// The faces that the cracks have cut since the body was made: of a piece none that it was parted by, or had within it when it came
    /// about. Polygons as those of [`faces`](Self::faces).
    pub fn new_faces<'a>(
        &'a self,
        mesh: &'a TetMesh,
    ) -> impl Iterator<Item = ([Vec3; 4], usize)> + 'a {
        let cuts = |crack: &'a OldCrack| crack.cuts.iter().skip(crack.settled as usize);
        let cuts = self.cracks.iter().flat_map(cuts);
        cuts.map(|cut| crossing_polygon(&mesh.corners(cut.tet as usize), &cut.values))
    }

    /// The state as bytes: little-endian, 12 bytes, 40 more per crack, 32 per tetrahedron cut and 4 per junction.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = MAGIC.to_vec();
        let mut number = |x: u32| bytes.extend(x.to_le_bytes());
        number(self.cracks.len() as u32);
        for crack in &self.cracks {
            number(crack.start);
            for vector in [crack.origin, crack.normal] {
                let of = vector.to_array();
                of.iter().for_each(|x| number(x.to_bits()));
            }
            number(crack.cuts.len() as u32);
            number(crack.settled);
            number(crack.junctions.len() as u32);
            for cut in &crack.cuts {
                number(cut.tet);
                let direction = cut.direction.to_array();
                cut.values
                    .iter()
                    .chain(&direction)
                    .for_each(|x| number(x.to_bits()));
            }
            for &(from, own) in &crack.junctions {
                number(from << 1 | u32::from(own));
            }
        }
        bytes
    }

    /// Reads what [`BodyState::to_bytes`] wrote. [`Body::set_state`](crate::Body::set_state) checks that it fits a body.
    ///
    /// # Errors
    /// Bytes of another kind, too few of them, or too many.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, InputError> {
        let rest = bytes.strip_prefix(MAGIC).ok_or(InputError::State(
            "it was not written by this version of Frangible",
        ))?;
        let mut numbers = Numbers(rest);
        let count = numbers.next()?;
        let mut cracks = Vec::new();
        for _ in 0..count {
            let start = numbers.next()?;
            let (origin, normal) = (numbers.vector()?, numbers.vector()?);
            let (cuts, settled, junctions) = (numbers.next()?, numbers.next()?, numbers.next()?);
            // Grown as they are read: no number in the file makes memory that the file does not fill.
            let mut crack = OldCrack {
                start,
                origin,
                normal,
                cuts: Vec::new(),
                settled,
                junctions: Vec::new(),
            };
            for _ in 0..cuts {
                crack.cuts.push(OldCut {
                    tet: numbers.next()?,
                    values: [
                        numbers.float()?,
                        numbers.float()?,
                        numbers.float()?,
                        numbers.float()?,
                    ],
                    direction: numbers.vector()?,
                });
            }
            for _ in 0..junctions {
                let junction = numbers.next()?;
                crack.junctions.push((junction >> 1, junction & 1 == 1));
            }
            cracks.push(crack);
        }
        if numbers.0.is_empty() {
            Ok(Self { cracks })
        } else {
            Err(InputError::State("there are bytes after its end"))
        }
    }
}

/// Little-endian numbers one after another.
struct Numbers<'a>(&'a [u8]);

impl Numbers<'_> {
    fn next(&mut self) -> Result<u32, InputError> {
        let (number, rest) = self
            .0
            .split_first_chunk::<4>()
            .ok_or(InputError::State("its end is missing"))?;
        self.0 = rest;
        Ok(u32::from_le_bytes(*number))
    }

    fn float(&mut self) -> Result<f32, InputError> {
        Ok(f32::from_bits(self.next()?))
    }

    fn vector(&mut self) -> Result<Vec3, InputError> {
        Ok(Vec3::new(self.float()?, self.float()?, self.float()?))
    }
}
