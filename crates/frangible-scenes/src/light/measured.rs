//! Light drawings of solids and shells that broke.

use std::collections::BTreeMap;

use frangible::glam::Vec3;
use frangible::internals::RenderMesh;
use frangible::internals::mesh::bounds;
use frangible::{Breakable, Contact, Fracture, FractureConfig, Material, Outcome, Striker};
use frangible_bake::{BakeSpec, ImportOptions, import_mesh};
use frangible_mesh::InputMesh;
use frangible_mesh::glam::DVec3;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

use super::lightened;
use crate::meshes::undrawn_piece;
use crate::output::{TOLERANCE, WANTED_OF_DRAWN, WANTED_OF_PIECE};

/// A surface of revolution about y, of a profile of (radius, height) from the axis to the axis.
fn turned(profile: &[[f64; 2]], sectors: u32) -> InputMesh {
    let mut mesh = InputMesh::default();
    let rows = profile.len() as u32;
    for &[radius, height] in profile {
        for k in 0..sectors {
            let turn = std::f64::consts::TAU * f64::from(k) / f64::from(sectors);
            let (sin, cos) = turn.sin_cos();
            mesh.positions
                .push(DVec3::new(radius * cos, height, -radius * sin));
        }
    }
    for row in 0..rows - 1 {
        for k in 0..sectors {
            let at = |row: u32, k: u32| row * sectors + k % sectors;
            let (a, b, c, d) = (
                at(row, k),
                at(row, k + 1),
                at(row + 1, k + 1),
                at(row + 1, k),
            );
            let mut add = |t: [u32; 3]| {
                let [p, q, r] = t.map(|v| mesh.positions[v as usize]);
                if p != q && q != r && r != p {
                    mesh.triangles.push(t);
                }
            };
            add([a, b, c]);
            add([a, c, d]);
        }
    }
    mesh
}

fn cuboid(half: [f64; 3]) -> InputMesh {
    let mut mesh = InputMesh::default();
    for corner in 0..8 {
        let sign = |k: usize| if corner >> k & 1 == 0 { -1.0 } else { 1.0 };
        let at = DVec3::new(sign(0), sign(1), sign(2)) * DVec3::from_array(half);
        mesh.positions.push(at);
    }
    for [a, b, c, d] in [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ] {
        mesh.triangles.extend([[a, b, c], [a, c, d]]);
    }
    mesh
}

fn ball(radius: f64, rings: u32, sectors: u32) -> InputMesh {
    let profile: Vec<[f64; 2]> = (0..=rings)
        .map(|k| {
            let turn = std::f64::consts::PI * f64::from(k) / f64::from(rings);
            let sin = if k == 0 || k == rings {
                0.0
            } else {
                turn.sin()
            };
            [radius * sin, -radius * turn.cos()]
        })
        .collect();
    turned(&profile, sectors)
}

/// A ball with bumps, each at a place by lot: a mesh that no one would draw, but that encloses a volume.
fn bumpy(seed: u64) -> InputMesh {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut lot = || f64::from(rng.next_u32()) / f64::from(u32::MAX) * 2.0 - 1.0;
    let bumps: Vec<(DVec3, f64)> = (0..6)
        .map(|_| {
            (
                DVec3::new(lot(), lot(), lot()).normalize_or(DVec3::X),
                0.3 * lot(),
            )
        })
        .collect();
    let mut mesh = ball(0.08, 20, 40);
    for place in &mut mesh.positions {
        let toward = place.normalize();
        let grown = bumps
            .iter()
            .map(|&(at, height)| height * (4.0 * (toward.dot(at) - 1.0)).exp());
        *place *= 1.0 + grown.sum::<f64>();
    }
    mesh
}

struct Case {
    name: &'static str,
    mesh: InputMesh,
    material: &'static str,
    wall: Option<f64>,
    tets: usize,
    /// Speed of a steel surface that does not give way, m/s; a tenth more each time that the body holds.
    speed: f64,
}

impl Case {
    const fn solid(name: &'static str, mesh: InputMesh, material: &'static str) -> Self {
        Self {
            name,
            mesh,
            material,
            wall: None,
            tets: 8000,
            speed: 18.0,
        }
    }

    /// Longest side of the body, m, and its pieces.
    fn broken(&self) -> (f32, Fracture) {
        let mut options = ImportOptions::default();
        (options.wall, options.tets) = (self.wall, self.tets);
        let imported = import_mesh(&self.mesh, &options).unwrap();
        let spec = BakeSpec {
            modes: 20,
            groups: imported.groups,
            render: imported.render,
            ..BakeSpec::new(
                self.name,
                imported.shape,
                Material::preset(self.material).unwrap(),
            )
        };
        let asset = frangible_bake::bake(&spec).unwrap();
        let (low, high) = bounds(&asset.fracture().positions);
        let body = Breakable::new(asset).unwrap().body(3);
        let above = Vec3::new(0.2 * high.x, 2.0 * high.y, 0.1 * high.z);
        let at = body.nearest_on_surface(above).position;
        let steel = Material::preset("steel").unwrap();
        let speeds = std::iter::successors(Some(self.speed), |speed| Some(1.1 * speed));
        for speed in speeds.take(20) {
            let striker = Striker::fixed(&steel);
            let blow = Contact::collision(body.asset(), at, Vec3::NEG_Y, speed, striker);
            let outcome = frangible::impact(&body, &[blow], &FractureConfig::default());
            if let Outcome::Broke(fracture) = outcome.unwrap() {
                return ((high - low).max_element(), *fracture);
            }
        }
        panic!("{} holds", self.name);
    }

    /// Triangles of all pieces before and after, those wanted, and the largest error, of the longest side.
    fn lightened(&self) -> ([usize; 3], f32) {
        let (size, fracture) = self.broken();
        let (mut counts, mut worst) =
            ([0, 0, WANTED_OF_DRAWN * self.mesh.triangles.len()], 0.0_f32);
        for fragment in &fracture.fragments {
            let origin = fragment.mass.centre.as_vec3();
            let (full, is_drawn) = match &fragment.render {
                Some(render) => (render.clone(), true),
                None => (undrawn_piece(&fragment.mesh, origin), false),
            };
            let (light, error) = lightened(&full, origin, is_drawn, TOLERANCE * size);
            assert_closed(self.name, &full, &light);
            counts[0] += full.triangles.len();
            counts[1] += light.triangles.len();
            counts[2] += WANTED_OF_PIECE;
            worst = worst.max(error / size);
        }
        println!(
            "{}: {} pieces, {counts:?} triangles, {:.3} %",
            self.name,
            fracture.fragments.len(),
            100.0 * worst
        );
        (counts, worst)
    }
}

/// Sides of triangles that do not run as often the other way.
fn borders(mesh: &RenderMesh) -> usize {
    let mut sides: BTreeMap<[[u32; 3]; 2], i32> = BTreeMap::new();
    let bits = |v: u32| {
        mesh.positions[v as usize]
            .to_array()
            .map(|x| (x + 0.0).to_bits())
    };
    for [a, b, c] in mesh.triangles.iter().map(|t| t.map(bits)) {
        for [from, to] in [[a, b], [b, c], [c, a]] {
            let by = if from < to { 1 } else { -1 };
            *sides.entry([from.min(to), from.max(to)]).or_default() += by;
        }
    }
    sides.values().filter(|&&count| count != 0).count()
}

fn assert_closed(name: &str, full: &RenderMesh, light: &RenderMesh) {
    if borders(full) == 0 {
        assert_eq!(borders(light), 0, "{name}");
    }
}

#[test]
fn pieces_of_solids_and_shells_have_few_triangles_that_are_near() {
    let cup = [
        [0.0, 0.0],
        [0.05, 0.0],
        [0.05, 0.1],
        [0.045, 0.1],
        [0.045, 0.005],
        [0.0, 0.005],
    ];
    let shell = |name, mesh, material, wall| Case {
        wall,
        speed: 6.0,
        ..Case::solid(name, mesh, material)
    };
    let cases = [
        Case::solid("box", cuboid([0.1, 0.05, 0.05]), "concrete"),
        Case::solid("cube", cuboid([0.1, 0.1, 0.1]), "glass"),
        Case::solid("ball", ball(0.1, 16, 32), "porcelain"),
        Case::solid("bumpy ball", bumpy(7), "porcelain"),
        shell("pane", cuboid([0.1, 0.003, 0.1]), "glass", None),
        shell("cup", turned(&cup, 32), "porcelain", None),
        shell("skin", ball(0.1, 16, 32), "glass", Some(0.003)),
        shell("bumpy skin", bumpy(8), "glass", Some(0.003)),
    ];
    for case in &cases {
        let ([full, light, wanted], error) = case.lightened();
        assert!(error > 0.0 && error <= TOLERANCE, "{}: {error}", case.name);
        assert!(light <= wanted, "{}: {light} of {wanted}", case.name);
        assert!(2 * light < full, "{}: {light} of {full}", case.name);
    }
}
