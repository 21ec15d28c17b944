//! Drawn meshes of the pieces: the author's surface outside, crack faces inside.

use glam::Vec3;

/// Mesh to draw of a piece of a body that has a surface drawn by its author: its part of that
/// surface and its crack faces, m, fragment frame.
///
/// A mesh for the eye, and no input to physics. If the author's surface is closed and faces outwards, so is each piece, once vertices at
/// one place are one: each side has one that runs the other way. Thin triangles close the gap between the author's surface and the crack
/// faces; they come last. If one lies on a drawn triangle, the two face each other, and an edge may have four triangles.
///
/// A hole that the author left stays one, unless a crack runs through it: then the piece's crack faces are sewn to the border of the hole.
/// Pieces of a surface that faces inwards stay open along their cracks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderMesh {
    /// Vertex positions, m, fragment frame.
    pub positions: Vec<Vec3>,
    /// Unit normals, one per vertex.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one pair per vertex: the author's outside, where there are any; else, and on crack faces,
    /// [`box_projection`] of the place in the parent's body frame, m.
    pub uvs: Vec<[f32; 2]>,
    /// Vertices of each triangle, counter-clockwise seen from outside. The first [`RenderMesh::outer_triangles`]
    /// are the author's surface, the rest crack faces and the triangles that sew the two together.
    pub triangles: Vec<[u32; 3]>,
    /// Number of triangles, from the first, on the author's surface.
    pub outer_triangles: usize,
    /// Index into the surface's materials of each outer triangle; empty
    /// where the author gave none. Crack faces take a material of the user's own.
    pub material_of_triangle: Vec<u32>,
}

/// Texture coordinates of a point by box projection, m: its two coordinates across the axis that the face's normal is
/// closest to. Give all corners of a triangle the same normal.
///
/// u runs right and v down as seen from outside, as in glTF, so that no face is mirrored.
#[must_use]
pub fn box_projection(point: Vec3, normal: Vec3) -> [f32; 2] {
    let axis = normal.abs().max_position();
    let (u, v) = match axis {
        0 => (-point.z, -point.y),
        1 => (point.x, point.z),
        _ => (point.x, -point.y),
    };
    [if normal[axis] < 0.0 { -u } else { u }, v]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn box_projection_keeps_lengths_and_never_mirrors() {
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let mut normal = Vec3::splat(0.3);
                normal[axis] = sign;
                let outward = Vec3::AXES[axis] * sign;
                let [along, across] = [Vec3::AXES[(axis + 1) % 3], Vec3::AXES[(axis + 2) % 3]];
                let uv = |p: Vec3| box_projection(p, normal);
                let (a, b) = (uv(along), uv(across));
                let length = |x: [f32; 2]| x[0].hypot(x[1]);
                assert_eq!((length(a), length(b)), (1.0, 1.0));
                assert_eq!(length(uv(outward)), 0.0);
                // v runs down: what turns left on the face turns right in (u, v).
                let turn = along.cross(across).dot(outward);
                assert_eq!(a[0] * b[1] - a[1] * b[0], -turn);
            }
        }
    }
}
