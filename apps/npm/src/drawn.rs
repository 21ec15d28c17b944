//! Render meshes of bodies and fragments as flat lists of numbers, with the looks of the file that they come from.

use frangible::glam::Vec3;
use frangible::internals::asset::{RenderSurface, linear_color};
use frangible::internals::{RenderMesh, box_projection};
use frangible::{Asset, Fragment, TriMesh};

/// A render mesh. Vertices with equal position, normal and texture coordinates are shared.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drawn {
    /// Positions, three numbers per vertex, m.
    pub positions: Vec<f32>,
    /// Unit normals.
    pub normals: Vec<f32>,
    /// Texture coordinates, two per vertex.
    pub uvs: Vec<f32>,
    /// Further sets of texture coordinates, as many as the body's file has; zero on crack faces.
    pub more_uvs: Vec<Vec<f32>>,
    /// Linear red, green, blue and opacity of each vertex, white on crack faces; empty if the body's file has none.
    pub colors: Vec<f32>,
    /// Three indices per triangle, counter-clockwise seen from outside; those of the body's original surface first, sorted by material.
    pub indices: Vec<u32>,
    /// Number of indices that belong to the body's original surface; the rest are crack faces.
    pub outer_indices: usize,
    /// Materials of the original surface; empty if the body's file has none.
    pub groups: Vec<Group>,
}

/// Triangles of one material of the body's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Group {
    /// First index.
    pub first: usize,
    /// Number of indices.
    pub count: usize,
    /// Number of the material in the file.
    pub material: u32,
}

/// The surface that the author of a body drew, if there is one: its name, materials and images are also those of its pieces.
#[must_use]
pub fn authored(asset: &Asset) -> Option<&RenderSurface> {
    asset.root().render()
}

impl Drawn {
    /// The surface of a whole body, in its body frame.
    #[must_use]
    pub fn whole(asset: &Asset) -> Self {
        let Some(surface) = &asset.render() else {
            let positions = asset.surface_positions();
            let mut sheet = Sheet::new(positions.len(), Vec3::ZERO);
            let corners = asset
                .surface()
                .triangles
                .iter()
                .zip(&asset.surface().normals);
            for (triangle, normals) in corners {
                sheet.add(positions, *triangle, *normals, None);
            }
            sheet.drawn.outer_indices = sheet.drawn.indices.len();
            return sheet.drawn;
        };
        let mut sheet = Sheet::new(surface.positions.len(), Vec3::ZERO);
        sheet.drawn.more_uvs = vec![Vec::new(); surface.more_uvs.len()];
        for (triangle, normals) in surface.triangles.iter().zip(surface.corner_normals()) {
            let uvs = (!surface.uvs.is_empty()).then(|| triangle.map(|v| surface.uvs[v as usize]));
            let known = sheet.drawn.indices.len();
            sheet.add(&surface.positions, *triangle, normals, uvs);
            for (k, &v) in triangle.iter().enumerate() {
                let vertex = sheet.drawn.indices[known + k] as usize;
                sheet
                    .drawn
                    .paint(vertex, v as usize, &surface.more_uvs, &surface.colors);
            }
        }
        let mut drawn = sheet.drawn;
        drawn.outer_indices = drawn.indices.len();
        drawn.finish(&surface.material_of_triangle, surface.srgb_colors);
        drawn
    }

    /// The surface of a fragment of a body, in its own frame. Cracks inside it are drawn from both sides.
    #[must_use]
    pub fn fragment(asset: &Asset, fragment: &Fragment) -> Self {
        match &fragment.render {
            Some(render) => Self::rendered(render, authored(asset).is_some_and(|s| s.srgb_colors)),
            None => Self::closed(&fragment.mesh, fragment.mass.centre.as_vec3()),
        }
    }

    fn rendered(mesh: &RenderMesh, srgb: bool) -> Self {
        let mut drawn = Self {
            more_uvs: vec![Vec::new(); mesh.more_uvs.len()],
            ..Self::default()
        };
        let vertices = mesh.positions.iter().zip(&mesh.normals).zip(&mesh.uvs);
        for (number, ((place, normal), uv)) in vertices.enumerate() {
            drawn.vertex(*place, *normal, *uv);
            drawn.paint(number, number, &mesh.more_uvs, &mesh.colors);
        }
        drawn.indices = mesh.triangles.as_flattened().to_vec();
        drawn.outer_indices = 3 * mesh.outer_triangles;
        drawn.finish(&mesh.material_of_triangle, srgb);
        drawn
    }

    fn closed(mesh: &TriMesh, centre: Vec3) -> Self {
        let mut sheet = Sheet::new(mesh.positions.len(), centre);
        for (number, (triangle, normals)) in mesh.triangles.iter().zip(&mesh.normals).enumerate() {
            if number == mesh.outer_triangles {
                sheet.drawn.outer_indices = sheet.drawn.indices.len();
            }
            sheet.add(&mesh.positions, *triangle, *normals, None);
        }
        if mesh.outer_triangles == mesh.triangles.len() {
            sheet.drawn.outer_indices = sheet.drawn.indices.len();
        }
        let mut drawn = sheet.drawn;
        for &[a, b, c] in &mesh.cracks {
            let normal = (b - a).cross(c - a).normalize_or_zero();
            for (corners, normal) in [([a, b, c], normal), ([a, c, b], -normal)] {
                for place in corners {
                    let next = drawn.vertex(place, normal, box_projection(place + centre, normal));
                    drawn.indices.push(next);
                }
            }
        }
        drawn
    }

    fn vertex(&mut self, place: Vec3, normal: Vec3, uv: [f32; 2]) -> u32 {
        let number = self.positions.len() / 3;
        self.positions.extend(place.to_array());
        self.normals.extend(normal.to_array());
        self.uvs.extend(uv);
        number as u32
    }

    /// Gives a vertex the further attributes of a vertex of the surface, if it has none yet.
    fn paint(&mut self, vertex: usize, source: usize, uvs: &[Vec<[f32; 2]>], colors: &[[f32; 4]]) {
        for (own, all) in self.more_uvs.iter_mut().zip(uvs) {
            if own.len() == 2 * vertex {
                own.extend(all[source]);
            }
        }
        if !colors.is_empty() && self.colors.len() == 4 * vertex {
            self.colors.extend(colors[source]);
        }
    }

    /// Sorts the triangles of the original surface by material, and makes the colours linear.
    fn finish(&mut self, material_of_triangle: &[u32], srgb: bool) {
        if srgb {
            for color in self.colors.as_chunks_mut().0 {
                *color = linear_color(*color);
            }
        }
        let outside = self.indices[..self.outer_indices].as_chunks().0;
        let mut sorted: Vec<(u32, [u32; 3])> = (material_of_triangle.iter().copied())
            .zip(outside.iter().copied())
            .collect();
        sorted.sort_by_key(|&(material, _)| material);
        for (place, (_, triangle)) in self.indices.as_chunks_mut().0.iter_mut().zip(&sorted) {
            *place = *triangle;
        }
        let mut first = 0;
        for same in sorted.chunk_by(|a, b| a.0 == b.0) {
            let (count, material) = (3 * same.len(), same[0].0);
            self.groups.push(Group {
                first,
                count,
                material,
            });
            first += count;
        }
    }
}

/// A surface whose corners are put together where they are alike.
struct Sheet {
    drawn: Drawn,
    /// The surface's centre in the frame of the projection, m.
    centre: Vec3,
    /// Drawn vertices of each vertex of the surface.
    of_vertex: Vec<Vec<u32>>,
}

impl Sheet {
    fn new(vertices: usize, centre: Vec3) -> Self {
        Self {
            drawn: Drawn::default(),
            centre,
            of_vertex: vec![Vec::new(); vertices],
        }
    }

    /// Adds a triangle with its corners' normals and texture coordinates; none: by box projection.
    fn add(
        &mut self,
        positions: &[Vec3],
        triangle: [u32; 3],
        normals: [Vec3; 3],
        uvs: Option<[[f32; 2]; 3]>,
    ) {
        let places = triangle.map(|v| positions[v as usize]);
        let across = (places[1] - places[0]).cross(places[2] - places[0]);
        let uvs = uvs.unwrap_or_else(|| places.map(|p| box_projection(p + self.centre, across)));
        for (k, v) in triangle.into_iter().enumerate() {
            let known = &mut self.of_vertex[v as usize];
            let drawn = &mut self.drawn;
            let same = |&&i: &&u32| {
                let i = i as usize;
                drawn.normals[3 * i..][..3] == normals[k].to_array()
                    && drawn.uvs[2 * i..][..2] == uvs[k]
            };
            let index = known.iter().find(same).copied().unwrap_or_else(|| {
                let next = drawn.vertex(places[k], normals[k], uvs[k]);
                known.push(next);
                next
            });
            drawn.indices.push(index);
        }
    }
}
