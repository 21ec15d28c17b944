//! Render meshes of the fragments, made from what building them left.

use super::Fragment;
use crate::body::Prepared;
use crate::mesh::{Division, DrawnPiece, RenderSurface, Threads};

/// Data for drawing fragments, left from building them.
pub(crate) struct Undrawn {
    /// Label of each fragment.
    pub(crate) labels: Vec<u32>,
    /// Division of the surface among the labels.
    pub(crate) division: Division,
}

/// Gives each fragment its render mesh.
pub(crate) fn draw(
    surface: &RenderSurface,
    prepared: &Prepared,
    fragments: &mut [Fragment],
    undrawn: Undrawn,
    threads: &Threads,
) {
    let Some(index) = &prepared.render else {
        return;
    };
    let Undrawn { labels, division } = undrawn;
    let drawn = {
        let pieces = fragments.iter().zip(&labels);
        let pieces = pieces.map(|(fragment, &label)| DrawnPiece {
            label,
            normals: &fragment.mesh.normals[fragment.mesh.outer_triangles..],
            centre: fragment.mass.centre,
        });
        let pieces: Vec<_> = pieces.collect();
        index.divide(surface, &prepared.surface, division, &pieces, threads)
    };
    for (fragment, drawn) in fragments.iter_mut().zip(drawn) {
        fragment.render = Some(drawn);
    }
}
