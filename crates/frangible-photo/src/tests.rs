//! Tests of traced pictures against known properties of light.

use frangible_recording::glam::{Vec3, Vec3A};
use frangible_recording::{
    Floor, MeshPart, Pose, RecordedMesh, RecordedNode, Recording, SurfaceMaterial, View,
};

use crate::optics::{at_crack, at_glass};
use crate::photograph::Photograph;
use crate::set::Set;
use crate::stage::StageUnits;

/// A box of this surface, its sides along the axes, with a floor under it unless it is to float in nothing.
fn boxed(surface: SurfaceMaterial, low: Vec3, high: Vec3, floor: bool) -> Recording {
    let mut mesh = RecordedMesh::default();
    let mut indices = Vec::new();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let mut normal = Vec3::ZERO;
            normal[axis] = side;
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let first = mesh.positions.len() as u32;
            for [du, dv] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                let mut share = Vec3::ZERO;
                (share[u], share[v]) = (du, dv);
                share[axis] = 0.5 + 0.5 * side;
                mesh.positions.push(low + share * (high - low));
                mesh.normals.push(normal);
            }
            let turn = if side > 0.0 {
                [0, 1, 2, 0, 2, 3]
            } else {
                [0, 2, 1, 0, 3, 2]
            };
            indices.extend(turn.map(|k| first + k));
        }
    }
    mesh.parts.push(MeshPart {
        surface: 0,
        indices,
    });
    Recording {
        frame_rate: 60.0,
        frame_count: 1,
        surfaces: vec![surface],
        meshes: vec![mesh],
        nodes: vec![RecordedNode {
            poses: vec![Pose::default()],
            visible: 0..1,
            ..RecordedNode::default()
        }],
        floor: floor.then(Floor::default),
        camera: View {
            eye: Vec3::new(0.4, 0.9, 2.2),
            target: Vec3::new(0.0, 0.3, 0.0),
            ..View::default()
        },
        ..Recording::default()
    }
}

fn glass() -> SurfaceMaterial {
    SurfaceMaterial {
        transmission: 1.0,
        ior: 1.5,
        ..SurfaceMaterial::default()
    }
}

#[test]
fn glass_bends_light_by_snells_law_and_mirrors_by_fresnels() {
    let (reflected, bent) = at_glass(Vec3A::NEG_Y, Vec3A::Y, 1.5);
    // ((n − 1) / (n + 1))²
    assert!((reflected - 0.04).abs() < 1e-6);
    assert!(bent.unwrap().abs_diff_eq(Vec3A::NEG_Y, 1e-6));
    for degrees in [10.0_f32, 35.0, 60.0, 85.0] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        let along = Vec3A::new(sine, -cosine, 0.0);
        let (reflected, bent) = at_glass(along, Vec3A::Y, 1.5);
        let bent = bent.unwrap();
        assert!(
            (bent.x * 1.5 - sine).abs() < 1e-5 && bent.y < 0.0,
            "{degrees}°"
        );
        // The way back has the same share and ends where the light came from.
        let (back, out) = at_glass(-bent, Vec3A::Y, 1.5);
        assert!((back - reflected).abs() < 1e-5, "{degrees}°");
        assert!(out.unwrap().abs_diff_eq(-along, 1e-5), "{degrees}°");
    }
    // Brewster's angle: of the two polarisations one is mirrored.
    let brewster = 1.5_f32.atan();
    let along = Vec3A::new(brewster.sin(), -brewster.cos(), 0.0);
    let (reflected, _) = at_glass(along, Vec3A::Y, 1.5);
    let across = (2.0 * brewster).cos();
    assert!((reflected - 0.5 * across * across).abs() < 1e-5);
}

#[test]
fn a_crack_in_glass_lets_light_straight_through_up_to_the_critical_angle() {
    let critical = (1.0_f32 / 1.5).asin();
    let toward = |angle: f32| Vec3A::new(angle.sin(), -angle.cos(), 0.0);
    for normal in [Vec3A::Y, Vec3A::NEG_Y] {
        let (reflected, passed) = at_crack(toward(0.0), normal, 1.5);
        assert!((reflected - 0.08 / 1.04).abs() < 1e-5);
        assert_eq!(passed, Some(toward(0.0)));
        assert!(at_crack(toward(critical - 0.01), normal, 1.5).1.is_some());
        assert!(at_crack(toward(critical + 0.01), normal, 1.5).1.is_none());
    }
}

#[test]
fn a_pane_on_the_floor_shades_it_by_what_it_mirrors() {
    // Light falls on a level pane of clear glass; the light that is not mirrored lands below it.
    let (low, high) = (Vec3::new(-0.6, 0.05, -0.6), Vec3::new(0.6, 0.06, 0.6));
    let recording = boxed(glass(), low, high, true);
    let units = StageUnits::of(&recording.camera);
    let set = Set::new(&recording, &recording.camera, units);
    let ground = set.ground.as_ref().unwrap();
    let (mut shaded, mut gathered) = (0.0_f32, 0.0);
    for step in 0..100 {
        let [x, z] = [step % 10, step / 10].map(|k| 0.06 * k as f32 - 0.27);
        let under = units.point(Vec3::new(x, 0.0, z));
        let [straight, bent] = ground.lamp_at(under.into());
        shaded = shaded.max(straight);
        gathered += bent / 100.0;
    }
    assert!(
        shaded < 0.05,
        "the lamp's own light is followed through the glass"
    );
    // At 42° from the normal two faces let 0.91 of the light pass, and 0.92 with what goes to and fro between them.
    assert!((gathered - 0.915).abs() < 0.03, "{gathered}");
    let beside = units.point(Vec3::new(-0.9, 0.0, 0.9));
    let [open, none] = ground.lamp_at(beside.into());
    assert!(open > 0.9 && none < 0.05, "{open} {none}");
}

#[test]
fn what_stands_behind_glass_is_seen_through_it_and_behind_clay_it_is_not() {
    let (low, high) = (Vec3::new(-0.4, 0.0, 0.3), Vec3::new(0.4, 0.7, 0.32));
    let red = |front: SurfaceMaterial| {
        let mut recording = boxed(front, low, high, true);
        let behind = boxed(
            SurfaceMaterial::default(),
            Vec3::new(-0.15, 0.0, -0.4),
            Vec3::new(0.15, 0.3, -0.2),
            false,
        );
        recording.surfaces.push(SurfaceMaterial {
            base_color: [0.8, 0.02, 0.02, 1.0],
            ..SurfaceMaterial::default()
        });
        let mut mesh = behind.meshes[0].clone();
        mesh.parts[0].surface = 1;
        recording.meshes.push(mesh);
        recording.nodes.push(RecordedNode {
            mesh: 1,
            ..recording.nodes[0].clone()
        });
        let mut photograph = Photograph::new(&recording, &recording.camera, 96, 72);
        photograph.expose();
        let picture = photograph.picture();
        let is_red = |pixel: &&[u8]| pixel[0] > 60 && pixel[0] / 2 > pixel[1];
        picture.bytes().chunks_exact(3).filter(is_red).count()
    };
    let (glass, clay) = (red(glass()), red(SurfaceMaterial::default()));
    assert!(glass > 100, "{glass}");
    assert_eq!(clay, 0);
}

#[test]
fn pictures_are_the_same_bits_on_any_number_of_threads() {
    let (low, high) = (Vec3::new(-0.3, 0.0, -0.3), Vec3::new(0.3, 0.6, 0.3));
    let recording = boxed(glass(), low, high, true);
    let draw = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let mut photograph = Photograph::new(&recording, &recording.camera, 64, 48);
            photograph.expose();
            photograph.picture()
        })
    };
    assert_eq!(draw(1), draw(3));
}
