//! Pieces of a broken body, pulled apart, and bodies that held.

use frangible::glam::{Quat, Vec3};
use frangible::internals::BodyState;
use frangible::{Asset, Fragment};

use super::model::{Colour, Model};

/// Colours of the outside and of crack faces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PieceColours {
    pub(crate) outside: Colour,
    pub(crate) inside: Colour,
}

/// Adds the pieces, each moved away from the body's centre by this share of its distance, all turned by `rotation`.
pub(crate) fn add_pieces(
    model: &mut Model,
    pieces: &[Fragment],
    apart: f32,
    rotation: Quat,
    colours: PieceColours,
) {
    for piece in pieces {
        let centre = piece.mass.centre.as_vec3() * (1.0 + apart);
        let mesh = &piece.mesh;
        let place = |p: Vec3| rotation * (centre + p);
        for (i, (triangle, normals)) in mesh.triangles.iter().zip(&mesh.normals).enumerate() {
            let colour = if i < mesh.outer_triangles {
                colours.outside
            } else {
                colours.inside
            };
            let corners = triangle.map(|v| place(mesh.positions[v as usize]));
            model.smooth(colour, corners, normals.map(|n| rotation * n));
        }
        for crack in &mesh.cracks {
            model.sheet(colours.inside, crack.map(place));
        }
    }
}

/// Adds a body that held, with the cracks that it got.
pub(crate) fn add_held(
    model: &mut Model,
    asset: &Asset,
    state: Option<&BodyState>,
    rotation: Quat,
    colours: PieceColours,
) {
    let place = |p: Vec3| rotation * p;
    for (triangle, normals) in asset
        .surface()
        .triangles
        .iter()
        .zip(&asset.surface().normals)
    {
        let corners = triangle.map(|v| place(asset.fracture().positions[v as usize]));
        model.smooth(colours.outside, corners, normals.map(place));
    }
    for (corners, count) in state
        .iter()
        .flat_map(|state| state.new_faces(asset.fracture()))
    {
        for k in 2..count {
            let sheet = [corners[0], corners[k - 1], corners[k]];
            model.sheet(colours.inside, sheet.map(place));
        }
    }
}
