//! Picture to draw, as plain data.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible_recording::{Floor, SurfaceMaterial};

/// Triangles of one look, in the world.
#[derive(Clone, Debug)]
pub struct Batch {
    /// Looks of the triangles.
    pub looks: BatchLooks,
    /// Vertices, m.
    pub positions: Vec<Vec3>,
    /// Unit normals, one per vertex.
    pub normals: Vec<Vec3>,
    /// A number of 0..=1 per vertex with [`BatchLooks::Values`], else empty.
    pub values: Vec<f32>,
    /// Vertices of each triangle; the same allocation as long as they are the same.
    pub faces: Arc<Vec<[u32; 3]>>,
    /// Changes when the vertices of the same triangles change; 0 if nobody keeps count.
    pub stamp: u64,
}

/// Looks of a batch.
#[derive(Clone, Debug, PartialEq)]
pub enum BatchLooks {
    /// A surface.
    Surface(SurfaceMaterial),
    /// Coloured by its values.
    Values,
    /// Edges only, of this linear red, green, blue.
    Edges([f32; 3]),
}

/// A stroke over the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Line {
    /// Its ends, m.
    pub ends: [Vec3; 2],
    /// Linear red, green, blue.
    pub color: [f32; 3],
    /// Pixels.
    pub width: f32,
}

/// A dot over the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dot {
    /// Position, m.
    pub at: Vec3,
    /// Linear red, green, blue.
    pub color: [f32; 3],
    /// Pixels.
    pub size: f32,
}

/// Words over the picture, in the middle above a place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Label {
    /// Position, m.
    pub at: Vec3,
    /// The words.
    pub text: String,
}

/// A moment, ready to be drawn.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// Changes with each new picture.
    pub version: u64,
    /// Triangles.
    pub batches: Vec<Arc<Batch>>,
    /// Strokes.
    pub lines: Vec<Line>,
    /// Dots.
    pub dots: Vec<Dot>,
    /// Words.
    pub labels: Vec<Label>,
    /// The floor, if there is one.
    pub floor: Option<Floor>,
    /// If true, edges are drawn instead of faces.
    pub wireframe: bool,
}

impl Picture {
    /// Number of triangles.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.batches.iter().map(|batch| batch.faces.len()).sum()
    }
}
