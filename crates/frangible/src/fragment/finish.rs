//! From a draft to a fragment: mass, vertices, normals, shares of the convex cells.

use glam::{DVec3, Vec3};

use super::draft::Draft;
use super::label::Labels;
use super::points::PointTable;
use crate::asset::Trace;
use crate::fragment::Fragment;
use crate::mesh::{MassProperties, TriMesh, smooth_normals};

/// Makes fragments of drafts one after another.
pub(super) struct Finisher<'a> {
    table: &'a PointTable<'a>,
    density: f64,
    /// Vertex plus one of each point in the fragment at work, 0 for none.
    vertex_of_point: Vec<u32>,
    /// Cell plus one in which each point of the fragment at work was met last, 0 for none.
    cell_of_point: Vec<u32>,
}

impl<'a> Finisher<'a> {
    pub(super) fn new(table: &'a PointTable<'a>, density: f64) -> Self {
        Self {
            table,
            density,
            vertex_of_point: vec![0; table.len()],
            cell_of_point: vec![0; table.len()],
        }
    }

    /// The fragment of a draft whose nodes have this label. Its neighbours are still labels.
    pub(super) fn finish(
        &mut self,
        draft: Draft,
        labels: &Labels,
        label: u32,
    ) -> (Fragment, Trace) {
        let outer_triangles = draft.outer.len();
        let mut triangles = draft.outer;
        triangles.extend_from_slice(&draft.inner);
        let corners = |t: &[u32; 3]| t.map(|v| self.table.place(v));
        let mass = MassProperties::of_surface(self.density, triangles.iter().map(corners));
        let used = self.vertices(&mut triangles);
        let positions: Vec<Vec3> = (used.iter())
            .map(|&v| self.in_fragment(v, mass.centre))
            .collect();
        let label_of = |v: u32| labels.of_node[v as usize];
        let anchors = used.iter();
        let trace = Trace {
            label,
            anchors: anchors
                .map(|&v| self.table.anchor(v, label_of, label))
                .collect(),
            outer_of: draft.outer_of,
            inner_of: draft.inner_of,
        };
        let mut normals = draft.outer_normals;
        normals.extend(smooth_normals(&positions, &triangles[outer_triangles..]));
        let centre = mass.centre.as_vec3();
        let cracks = draft.cracks.into_iter();
        let fragment = Fragment {
            cell_shares: self.shares(&draft.cell_nodes, draft.cell_points, mass.centre),
            mesh: TriMesh {
                positions,
                triangles,
                normals,
                outer_triangles,
                cracks: cracks.map(|t| t.map(|p| p - centre)).collect(),
            },
            neighbours: draft.inner_to,
            render: None,
            mass,
            supported: draft.supported,
            velocity: DVec3::ZERO,
            angular_velocity: DVec3::ZERO,
        };
        (fragment, trace)
    }

    /// Numbers the vertices in order of first use; returns the point of each.
    fn vertices(&mut self, triangles: &mut [[u32; 3]]) -> Vec<u32> {
        let mut used = Vec::new();
        for v in triangles.iter_mut().flatten() {
            let vertex = &mut self.vertex_of_point[*v as usize];
            if *vertex == 0 {
                used.push(*v);
                *vertex = used.len() as u32;
            }
            *v = *vertex - 1;
        }
        for &v in &used {
            self.vertex_of_point[v as usize] = 0;
        }
        used
    }

    fn in_fragment(&self, point: u32, centre: DVec3) -> Vec3 {
        (self.table.place(point) - centre).as_vec3()
    }

    /// Points of each convex cell: its mesh nodes, then those of the partition. Wherever there are such, there are nodes.
    fn shares(
        &mut self,
        nodes: &[(u32, u32)],
        mut points: Vec<u64>,
        centre: DVec3,
    ) -> Vec<(u32, Vec<Vec3>)> {
        // The triangles about a point repeat it; nearly all of that goes without sorting.
        let parts = |p: u64| ((p >> 32) as u32 + 1, p as u32 as usize);
        points.retain(|&p| {
            let (cell, point) = parts(p);
            std::mem::replace(&mut self.cell_of_point[point], cell) != cell
        });
        for &p in &points {
            self.cell_of_point[parts(p).1] = 0;
        }
        points.sort_unstable();
        points.dedup();
        let mut points = points.as_slice();
        let cells = nodes.chunk_by(|x, y| x.0 == y.0);
        let share = |nodes: &[(u32, u32)]| {
            let cell = nodes[0].0;
            let own = points.partition_point(|p| (p >> 32) as u32 <= cell);
            let (here, later) = points.split_at(own);
            points = later;
            let here = here.iter().map(|&p| p as u32);
            let all = nodes.iter().map(|&(_, v)| v).chain(here);
            (cell, all.map(|v| self.in_fragment(v, centre)).collect())
        };
        cells.map(share).collect()
    }
}
