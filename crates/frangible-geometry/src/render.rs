//! Render meshes of the pieces: the authored surface outside, crack faces inside.

use glam::Vec3;

/// Render mesh of a piece of a body with an authored surface: its part of that surface and its crack faces, m, in the fragment
/// frame. It is not used for physics.
///
/// If the authored surface is closed and faces outwards, so does the mesh of each piece after vertices at the same position are merged:
/// each directed edge has an opposite one. Thin triangles, which come last, close the gap between the authored surface and the crack
/// faces. If such a triangle coincides with another triangle, the two face each other, and an edge may have four triangles.
///
/// Holes of the authored surface remain, unless a crack runs through one; then the piece's crack faces are sewn to its border.
/// Pieces of a surface that faces inwards remain open along their cracks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RenderMesh {
    /// Vertex positions, m, fragment frame.
    pub positions: Vec<Vec3>,
    /// Unit normals, one per vertex.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one pair per vertex: the authored ones on outer faces, if there are any; otherwise, and on crack faces, the
    /// [`box_projection`] of the position in the parent's body frame, m.
    pub uvs: Vec<[f32; 2]>,
    /// Further sets of texture coordinates, as many as the surface has, interpolated like the first; zero on crack faces.
    pub more_uvs: Vec<Vec<[f32; 2]>>,
    /// Colours of the vertices (red, green, blue and opacity), if the surface has any, interpolated; white on crack faces.
    pub colors: Vec<[f32; 4]>,
    /// Vertices of each triangle, counter-clockwise seen from outside. The first [`RenderMesh::outer_triangles`]
    /// are the authored surface, the rest crack faces and the triangles that join the two.
    pub triangles: Vec<[u32; 3]>,
    /// Number of triangles on the authored surface, which come first.
    pub outer_triangles: usize,
    /// Index of each outer triangle into the surface's materials; empty if the surface has none. The material of crack faces is up to
    /// the application.
    pub material_of_triangle: Vec<u32>,
}

impl RenderMesh {
    /// Adds a vertex of another mesh with all its attributes. Returns its number.
    #[doc(hidden)]
    pub fn push_vertex_of(&mut self, mesh: &Self, vertex: usize) -> u32 {
        self.positions.push(mesh.positions[vertex]);
        self.normals.push(mesh.normals[vertex]);
        self.uvs.push(mesh.uvs[vertex]);
        for (uvs, all) in self.more_uvs.iter_mut().zip(&mesh.more_uvs) {
            uvs.push(all[vertex]);
        }
        self.colors.extend(mesh.colors.get(vertex));
        self.positions.len() as u32 - 1
    }

    /// Adds a vertex of a crack face: further texture coordinates are zero, and the colour, if vertices have one, is white. Returns its number.
    #[doc(hidden)]
    pub fn push_inner_vertex(
        &mut self,
        position: Vec3,
        normal: Vec3,
        uv: [f32; 2],
        has_colors: bool,
    ) -> u32 {
        self.positions.push(position);
        self.normals.push(normal);
        self.uvs.push(uv);
        self.more_uvs.iter_mut().for_each(|uvs| uvs.push([0.0; 2]));
        self.colors.extend(has_colors.then_some([1.0; 4]));
        self.positions.len() as u32 - 1
    }
}

/// Returns texture coordinates of a point by box projection, m: its two coordinates perpendicular to the axis closest to the face
/// normal. Use the same normal for all corners of a triangle.
///
/// u points right and v down as seen from outside, as in glTF, so that no face is mirrored.
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
