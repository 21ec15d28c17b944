//! Results of a method for an impact.

use frangible::{Fragment, TriMesh};

use super::method::Method;

/// The pieces of a method, and their cost.
#[derive(Clone, Debug)]
pub struct Broken {
    /// The method.
    pub method: Method,
    /// The pieces, largest first; together they tile the body. Empty where it held.
    pub fragments: Vec<Fragment>,
    /// Area of all cracks, one side, m², those that part nothing included.
    pub crack_area: f64,
    /// Area between pieces, one side, m².
    pub border_area: f64,
    /// Σ A G_c of all cracks, J.
    pub energy: f64,
    /// Largest strain energy that the method knew of, J; 0 of a method that asks for none.
    pub available: f64,
    /// Wall-clock time from the contacts to the pieces, s. Not deterministic; all else is.
    pub seconds: f64,
}

impl Broken {
    /// Number of pieces, 1 where it held.
    #[must_use]
    pub fn pieces(&self) -> usize {
        self.fragments.len().max(1)
    }

    /// The largest piece's share of the volume, 1 where it held.
    #[must_use]
    pub fn largest_share(&self) -> f64 {
        let volumes = || self.fragments.iter().map(|f| f.mass.volume);
        match volumes().reduce(f64::max) {
            Some(largest) => largest / volumes().sum::<f64>(),
            None => 1.0,
        }
    }
}

/// Area of the crack faces of all pieces, one side, m².
pub(crate) fn border_area(fragments: &[Fragment]) -> f64 {
    let areas = fragments.iter().map(|f| inner_area(&f.mesh));
    // An empty sum would be −0.
    0.5 * areas.fold(0.0, |sum, area| sum + area)
}

fn inner_area(mesh: &TriMesh) -> f64 {
    let inner = mesh.triangles[mesh.outer_triangles..].iter();
    let area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize].as_dvec3());
        0.5 * (b - a).cross(c - a).length()
    };
    inner.map(area).sum()
}
