//! Contents of the picture, ready to be met by rays.

use frangible_recording::glam::{Quat, Vec3, Vec3A, Vec4};
use frangible_recording::{Recording, View};

use crate::ground::Ground;
use crate::light::Lights;
use crate::look::{Look, Skin};
use crate::stage::StageUnits;
use crate::tree::{Box3, Tree};

/// Pieces are drawn smaller by this share: along a crack light leaves one and enters the other, and one sees where it is.
const SHRINK: f32 = 0.0025;

/// A corner of a triangle.
#[derive(Clone, Copy)]
struct Corner {
    at: Vec3A,
    normal: Vec3A,
    /// In the frame of its mesh, m.
    own: Vec3A,
    /// Row of [`RecordedMesh::marks`](frangible_recording::RecordedMesh::marks).
    mark: Vec4,
}

struct Triangle {
    corners: [Corner; 3],
    /// The first corner, and the sides from there.
    sides: [Vec3A; 2],
    look: usize,
}

/// Intersection of a ray with a face.
pub(crate) struct Met<'a> {
    pub(crate) distance: f32,
    pub(crate) at: Vec3A,
    /// Across the face itself, out of the body.
    pub(crate) flat: Vec3A,
    /// The normal that the face is shaded by, out of the body.
    pub(crate) smooth: Vec3A,
    /// Place in the frame of the mesh, m.
    pub(crate) own: Vec3A,
    /// Way of the crack in that frame, m, and one over the radius of its mirror, 1/m.
    mark: Vec4,
    pub(crate) turn: Quat,
    pub(crate) look: &'a Look,
    pub(crate) face: u32,
}

impl Met<'_> {
    /// The surface there from close by.
    pub(crate) fn skin(&self) -> Skin {
        self.look.skin(self.own, self.mark)
    }
}

/// Everything that rays may meet.
pub(crate) struct Set {
    tree: Tree,
    triangles: Vec<Triangle>,
    /// Turn of the thing that each triangle belongs to.
    turns: Vec<Quat>,
    thing: Vec<u32>,
    looks: Vec<Look>,
    pub(crate) ground: Option<Ground>,
    pub(crate) lights: Lights,
}

impl Set {
    /// The first frame of a recording.
    pub(crate) fn new(recording: &Recording, view: &View, units: StageUnits) -> Self {
        let staged = units.view(view);
        let mut set = Self {
            tree: Tree::default(),
            triangles: Vec::new(),
            turns: Vec::new(),
            thing: Vec::new(),
            looks: recording
                .surfaces
                .iter()
                .map(|surface| Look::of(surface, units.scale))
                .collect(),
            ground: None,
            lights: Lights::new(&staged),
        };
        for (index, node) in recording.nodes.iter().enumerate() {
            let pose = recording.pose(index, 0);
            let turn = pose.rotation.normalize();
            let mesh = &recording.meshes[node.mesh];
            set.turns.push(turn);
            let place = |own: Vec3| {
                let own = own * (1.0 - SHRINK);
                Vec3A::from(units.point(turn * own + pose.translation))
            };
            for part in &mesh.parts {
                for face in part.indices.chunks_exact(3) {
                    let corners = [face[0], face[1], face[2]].map(|corner| {
                        let (own, normal) = (
                            mesh.positions[corner as usize],
                            mesh.normals[corner as usize],
                        );
                        Corner {
                            at: place(own),
                            normal: (turn * normal.normalize_or(Vec3::Y)).into(),
                            own: own.into(),
                            mark: mesh
                                .marks
                                .get(corner as usize)
                                .copied()
                                .map_or(Vec4::ZERO, Vec4::from),
                        }
                    });
                    let [a, b, c] = corners.map(|corner| corner.at);
                    let sides = [b - a, c - a];
                    if sides[0].cross(sides[1]).length_squared() <= 0.0 {
                        continue;
                    }
                    set.triangles.push(Triangle {
                        corners,
                        sides,
                        look: part.surface,
                    });
                    set.thing.push(index as u32);
                }
            }
        }
        let around = |triangle: &Triangle| Box3::around(triangle.corners.map(|corner| corner.at));
        let boxes: Vec<Box3> = set.triangles.iter().map(around).collect();
        set.tree = Tree::new(&boxes);
        set.ground = recording
            .floor
            .map(|floor| Ground::new(recording, &floor, view, units, &set));
        set
    }

    /// First intersection of a ray with a face other than the one that it leaves.
    pub(crate) fn meet(&self, from: Vec3A, along: Vec3A, leaves: u32) -> Option<Met<'_>> {
        let mut found = None;
        self.tree.along(from, along, f32::MAX, |face, best| {
            if face == leaves {
                return best;
            }
            match self.triangles[face as usize].distance(from, along) {
                Some(distance) if distance < best => {
                    found = Some((face, distance));
                    distance
                }
                _ => best,
            }
        });
        let (face, distance) = found?;
        Some(self.met(face, distance, from + along * distance))
    }

    fn met(&self, face: u32, distance: f32, at: Vec3A) -> Met<'_> {
        let triangle = &self.triangles[face as usize];
        let [wa, wb, wc] = triangle.weights(at);
        let [a, b, c] = &triangle.corners;
        let flat = triangle.flat();
        let smooth = (wa * a.normal + wb * b.normal + wc * c.normal).normalize_or(flat);
        // Normals of a mesh say which side is outside.
        let flat = if flat.dot(smooth) < 0.0 { -flat } else { flat };
        Met {
            distance,
            at,
            flat,
            smooth,
            own: wa * a.own + wb * b.own + wc * c.own,
            mark: wa * a.mark + wb * b.mark + wc * c.mark,
            turn: self.turns[self.thing[face as usize] as usize],
            look: &self.looks[triangle.look],
            face,
        }
    }

    /// Share of light that comes through along a ray: none past anything opaque, most past clear faces.
    pub(crate) fn clear_way(&self, from: Vec3A, along: Vec3A, leaves: u32) -> f32 {
        let mut through = 1.0;
        self.tree.along(from, along, f32::MAX, |face, best| {
            if face == leaves {
                return best;
            }
            let triangle = &self.triangles[face as usize];
            let Some(distance) = triangle.distance(from, along) else {
                return best;
            };
            if distance < 1e-4 {
                return best;
            }
            let look = &self.looks[triangle.look];
            if look.is_clear() {
                through *= look.passes(triangle.flat().dot(along).abs());
                return best;
            }
            through = 0.0;
            // Nearer than anything, so that nobody looks farther.
            f32::MIN
        });
        through
    }

    /// Returns true if anything lets light through.
    pub(crate) fn has_glass(&self) -> bool {
        let mut triangles = self.triangles.iter();
        triangles.any(|triangle| self.looks[triangle.look].is_clear())
    }

    /// Clear faces that are turned towards a direction, each with the sum of the areas up to its own as seen from there.
    pub(crate) fn clear_faces_toward(&self, toward: Vec3A) -> Vec<(u32, f32)> {
        let mut sum = 0.0;
        let mut faces = Vec::new();
        for (face, triangle) in (0..).zip(&self.triangles) {
            let look = &self.looks[triangle.look];
            let [right, up] = triangle.sides;
            let area = 0.5 * right.cross(up).dot(toward);
            if look.is_clear() && !look.thin && area > 0.0 {
                sum += area;
                faces.push((face, sum));
            }
        }
        faces
    }

    /// A point of a face by two numbers of 0..1.
    pub(crate) fn point_of(&self, face: u32, [u, v]: [f32; 2]) -> Met<'_> {
        let triangle = &self.triangles[face as usize];
        let root = u.sqrt();
        let [right, up] = triangle.sides;
        let at = triangle.corners[0].at + right * (root * (1.0 - v)) + up * (root * v);
        self.met(face, 0.0, at)
    }
}

impl Triangle {
    /// Distance along a ray to the triangle (Möller and Trumbore 1997).
    fn distance(&self, from: Vec3A, along: Vec3A) -> Option<f32> {
        let [right, up] = self.sides;
        let across = along.cross(up);
        let volume = right.dot(across);
        if volume == 0.0 {
            return None;
        }
        let inverse = volume.recip();
        let offset = from - self.corners[0].at;
        let u = offset.dot(across) * inverse;
        if !(0.0..=1.0).contains(&u) {
            return None;
        }
        let other = offset.cross(right);
        let v = along.dot(other) * inverse;
        if v < 0.0 || u + v > 1.0 {
            return None;
        }
        let distance = up.dot(other) * inverse;
        (distance > 1e-6).then_some(distance)
    }

    fn flat(&self) -> Vec3A {
        self.sides[0].cross(self.sides[1]).normalize_or(Vec3A::Y)
    }

    /// Shares of the corners in a point of the triangle.
    fn weights(&self, at: Vec3A) -> [f32; 3] {
        let [right, up] = self.sides;
        let offset = at - self.corners[0].at;
        let (rr, ru, uu) = (right.dot(right), right.dot(up), up.dot(up));
        let (or, ou) = (offset.dot(right), offset.dot(up));
        let inverse = (rr * uu - ru * ru).recip();
        let (b, c) = ((uu * or - ru * ou) * inverse, (rr * ou - ru * or) * inverse);
        [1.0 - b - c, b, c]
    }
}
