//! A hammer's head: a cylinder with a crowned striking face.

use frangible::glam::Vec3;
use frangible_recording::{MeshPart, RecordedMesh};

/// Corners around the head. The collider is the hull of these points and the face's, few enough for a fast contact.
const SECTORS: u16 = 24;

/// Rings of the crown between its apex and the edge of the face.
const CROWN_RINGS: u16 = 3;

/// Longest and shortest head, in radii of its face: the mass is as given, whatever the length.
const LENGTHS: [f64; 2] = [1.0, 12.0];

/// A head along +z, the apex of its striking face foremost.
#[derive(Clone, Debug)]
pub(crate) struct Head {
    /// Profile from the apex to the middle of the back: distance from the axis and z, m.
    profile: Vec<[f32; 2]>,
}

impl Head {
    /// Radius of the face and radius of curvature of its crown, m; as long as the mass (kg) at this density (kg/m³) asks for.
    pub(crate) fn new(radius: f64, crown: f64, mass: f64, density: f64) -> Self {
        let [shortest, longest] = LENGTHS.map(|radii| radii * radius);
        let length =
            (mass / density / (std::f64::consts::PI * radius * radius)).clamp(shortest, longest);
        let mut profile: Vec<[f32; 2]> = (0..=CROWN_RINGS)
            .map(|ring| {
                let r = radius * f64::from(ring) / f64::from(CROWN_RINGS);
                // Depth below the apex of a sphere of the crown's radius.
                let sag = r * r / (crown + (crown * crown - r * r).max(0.0).sqrt());
                [r as f32, -sag as f32]
            })
            .collect();
        profile.push([radius as f32, -length as f32]);
        profile.push([0.0, -length as f32]);
        Self { profile }
    }

    /// Moves the head along its axis, m.
    pub(crate) fn shift(&mut self, z: f32) {
        for point in &mut self.profile {
            point[1] += z;
        }
    }

    /// Distance by which the apex of the striking face lies before the origin, m.
    pub(crate) fn front(&self) -> f32 {
        self.profile[0][1]
    }

    /// Radius of the sphere about the origin that holds it, m.
    pub(crate) fn reach(&self) -> f32 {
        let lengths = self.profile.iter().map(|[r, z]| libm::hypotf(*r, *z));
        lengths.fold(0.0, f32::max)
    }

    /// Points whose hull is the head.
    pub(crate) fn points(&self) -> Vec<Vec3> {
        let mut points = Vec::new();
        for &[r, z] in &self.profile {
            let count = if r > 0.0 { SECTORS } else { 1 };
            points.extend((0..count).map(|i| around(r, z, i)));
        }
        points
    }

    /// The hammer as a recorded mesh: every band its own vertices, so that edges are sharp, but for the smooth crown.
    pub(crate) fn mesh(&self, surface: usize) -> RecordedMesh {
        let mut mesh = RecordedMesh {
            name: "hammer".into(),
            ..RecordedMesh::default()
        };
        let mut indices = Vec::new();
        for (band, pair) in self.profile.windows(2).enumerate() {
            let [[r0, z0], [r1, z1]] = [pair[0], pair[1]];
            let flat = Vec3::new(z0 - z1, 0.0, r1 - r0).normalize_or(Vec3::Z);
            let crowned = band < usize::from(CROWN_RINGS);
            // On the crown the normal leans outwards in proportion to the distance from the axis.
            let edge = self
                .profile
                .get(usize::from(CROWN_RINGS))
                .map_or(1.0, |p| p[0]);
            let lean = |r: f32| Vec3::new(flat.x * r / edge, 0.0, 1.0).normalize();
            let first = mesh.positions.len() as u32;
            for i in 0..=SECTORS {
                for [r, z] in [[r0, z0], [r1, z1]] {
                    let n = if crowned { lean(r) } else { flat };
                    let turned = around(n.x, n.z, i);
                    mesh.positions.push(around(r, z, i));
                    mesh.normals.push(turned);
                }
            }
            for i in 0..u32::from(SECTORS) {
                let a = first + 2 * i;
                if r0 > 0.0 {
                    indices.extend([a, a + 1, a + 2]);
                }
                if r1 > 0.0 {
                    indices.extend([a + 1, a + 3, a + 2]);
                }
            }
        }
        mesh.parts.push(MeshPart { surface, indices });
        mesh
    }
}

/// Adds a handle to the mesh of a head: a rod of this radius from the origin along +y, m. It is only to be looked at.
pub(crate) fn add_handle(mesh: &mut RecordedMesh, radius: f32, length: f32, surface: usize) {
    let first = mesh.positions.len() as u32;
    for sector in 0..=SECTORS {
        let side = around(1.0, 0.0, sector);
        let out = Vec3::new(side.x, 0.0, side.y);
        for y in [0.0, length] {
            mesh.positions.push(radius * out + y * Vec3::Y);
            mesh.normals.push(out);
        }
    }
    let cap = mesh.positions.len() as u32;
    for sector in 0..SECTORS {
        let side = around(radius, 0.0, sector);
        mesh.positions.push(Vec3::new(side.x, length, side.y));
        mesh.normals.push(Vec3::Y);
    }
    let mut indices = Vec::new();
    for sector in 0..u32::from(SECTORS) {
        let a = first + 2 * sector;
        indices.extend([a, a + 1, a + 2, a + 1, a + 3, a + 2]);
    }
    for sector in 1..u32::from(SECTORS) - 1 {
        indices.extend([cap, cap + sector + 1, cap + sector]);
    }
    mesh.parts.push(MeshPart { surface, indices });
}

fn around(r: f32, z: f32, sector: u16) -> Vec3 {
    let turn = std::f32::consts::TAU * f32::from(sector % SECTORS) / f32::from(SECTORS);
    let (sin, cos) = libm::sincosf(turn);
    Vec3::new(r * cos, r * sin, z)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_mesh_is_closed_looks_outwards_and_has_the_volume_of_the_mass() {
        let head = Head::new(0.013, 0.06, 0.5, 7850.0);
        let mesh = head.mesh(0);
        let mut volume = 0.0;
        for t in mesh.parts[0].indices.chunks(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|v| mesh.positions[v as usize]);
            volume += f64::from(a.dot(b.cross(c))) / 6.0;
            let normal = (b - a).cross(c - a).normalize();
            for &v in t {
                let along = normal.dot(mesh.normals[v as usize]);
                assert!(along > 0.9, "a normal leans away from its face: {along}");
            }
        }
        // A 24-gon covers 98.9 % of its circle; the crown takes 0.7 mm of 120 mm.
        let expected = 0.5 / 7850.0;
        assert!(
            (0.975..0.995).contains(&(volume / expected)),
            "{}",
            volume / expected
        );
    }

    #[test]
    fn the_crown_lies_on_its_sphere() {
        let head = Head::new(0.013, 0.06, 0.5, 7850.0);
        let centre = Vec3::new(0.0, 0.0, -0.06);
        let crown = head.points().into_iter().filter(|p| p.z > -0.01);
        let mut count = 0;
        for p in crown {
            assert!((p.distance(centre) - 0.06).abs() < 1e-6, "{p}");
            count += 1;
        }
        assert_eq!(count, 1 + 3 * usize::from(SECTORS));
    }
}
