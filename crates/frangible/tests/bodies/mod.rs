//! Small baked bodies, and blows on them. The test `core_bodies` of `frangible-bake` says how they were baked; `cargo xtask rebake` bakes them anew.

use std::path::Path;
use std::sync::OnceLock;

use crate::common::Numbers;
use frangible::glam::Vec3;
use frangible::{
    Asset, Body, Breakable, Contact, Fracture, FractureConfig, Material, Outcome, Striker, impact,
};

fn load(name: &str) -> Breakable {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/bodies");
    let asset = Asset::load(path.join(name)).expect("a body that this build can read");
    Breakable::uniform(asset).expect("a sound body")
}

/// Pane of glass 0.2 × 0.2 m, 4 mm thick, its normal z: a wall everywhere.
pub(crate) fn pane() -> &'static Breakable {
    static KIND: OnceLock<Breakable> = OnceLock::new();
    KIND.get_or_init(|| load("pane.frangible"))
}

/// Brick 0.21 × 0.1 × 0.05 m: no wall anywhere.
pub(crate) fn block() -> &'static Breakable {
    static KIND: OnceLock<Breakable> = OnceLock::new();
    KIND.get_or_init(|| load("block.frangible"))
}

/// Bar of glass 0.3 × 0.04 × 0.01 m along x, clamped at its end of lower x.
pub(crate) fn shelf() -> &'static Breakable {
    static KIND: OnceLock<Breakable> = OnceLock::new();
    KIND.get_or_init(|| load("shelf.frangible"))
}

/// Our model, ours under given impulses, and the paper's.
pub(crate) fn models() -> [(&'static str, FractureConfig); 3] {
    [
        ("ours", FractureConfig::default()),
        ("given impulses", FractureConfig::with_given_impulses()),
        ("paper", FractureConfig::as_in_the_paper()),
    ]
}

/// Steel ball of this mass, kg.
pub(crate) fn steel_ball(mass: f64) -> Striker {
    let steel = Material::preset("steel").unwrap();
    let radius = (mass / steel.density * 0.75 / std::f64::consts::PI).cbrt();
    Striker::ball(&steel, mass, radius).with_restitution(0.5)
}

/// A steel ball of 130 g hits the pane at (x, y) from above.
pub(crate) fn pane_hit(x: f32, y: f32, speed: f64) -> Contact {
    let point = Vec3::new(x, y, 0.002);
    Contact::collision(pane().asset(), point, Vec3::NEG_Z, speed, steel_ball(0.13))
}

/// The block lands on its corner on stone, its centre above it.
pub(crate) fn block_hit(speed: f64) -> Contact {
    let corner = Vec3::new(0.105, 0.05, -0.025);
    let stone = Striker::fixed(&Material::preset("stone").unwrap()).with_restitution(0.5);
    Contact::collision(block().asset(), corner, -corner, speed, stone)
}

/// A steel ball of 130 g falls on the shelf, not far from its free end.
pub(crate) fn shelf_hit(speed: f64) -> Contact {
    let high = |axis: usize| {
        let positions = shelf().asset().fracture().positions.iter();
        positions.map(|p| p[axis]).fold(f32::MIN, f32::max)
    };
    let point = Vec3::new(high(0) - 0.03, 0.0, high(2));
    Contact::collision(shelf().asset(), point, Vec3::NEG_Z, speed, steel_ball(0.13))
}

/// Blows that break their body for nearly every seed.
pub(crate) fn breaking() -> [(&'static str, &'static Breakable, Contact); 4] {
    [
        ("pane, middle", pane(), pane_hit(0.0, 0.0, 12.0)),
        ("pane, off the middle", pane(), pane_hit(0.06, -0.03, 20.0)),
        ("block, corner", block(), block_hit(10.0)),
        ("shelf, free end", shelf(), shelf_hit(10.0)),
    ]
}

/// What a blow does to a body of this kind.
pub(crate) fn strike(
    kind: &Breakable,
    seed: u64,
    contact: Contact,
    config: &FractureConfig,
) -> Outcome {
    impact(&kind.body(seed), &[contact], config).unwrap()
}

/// One of the breaks that every invariant is asked of.
pub(crate) struct Break {
    pub(crate) name: String,
    pub(crate) body: Body,
    pub(crate) fracture: Box<Fracture>,
}

/// All blows of [`breaking`] that break their body, for three seeds and every model.
pub(crate) fn breaks() -> &'static [Break] {
    static BREAKS: OnceLock<Vec<Break>> = OnceLock::new();
    BREAKS.get_or_init(|| {
        let mut broke = Vec::new();
        for (name, kind, contact) in breaking() {
            for (model, config) in models() {
                for seed in 1..=3 {
                    let body = kind.body(seed);
                    let outcome = impact(&body, std::slice::from_ref(&contact), &config).unwrap();
                    if let Outcome::Broke(fracture) = outcome {
                        let name = format!("{name}, {model}, seed {seed}");
                        broke.push(Break {
                            name,
                            body,
                            fracture,
                        });
                    }
                }
            }
        }
        assert!(broke.len() > 27, "only {} of 36 blows break", broke.len());
        broke
    })
}

/// Number of pieces that an outcome leaves.
pub(crate) fn pieces(outcome: &Outcome) -> usize {
    match outcome {
        Outcome::Broke(fracture) => fracture.fragments.len(),
        _ => 1,
    }
}

/// Every bit of an outcome that may hang on the input only.
pub(crate) fn bits(outcome: &Outcome) -> Vec<u64> {
    let report = outcome.report();
    let numbers = [
        report.contact_duration,
        report.crack_area,
        report.fracture_energy,
        report.first_crack_time.unwrap_or(-1.0),
    ];
    let mut bits = numbers.map(f64::to_bits).to_vec();
    bits.push(report.cracks as u64);
    let mut vector = |v: &Vec3| bits.extend(v.to_array().map(|x| u64::from(x.to_bits())));
    if let Outcome::Broke(fracture) = outcome {
        for fragment in &fracture.fragments {
            let mesh = &fragment.mesh;
            mesh.positions.iter().for_each(&mut vector);
            mesh.normals.iter().flatten().for_each(&mut vector);
            mesh.cracks.iter().flatten().for_each(&mut vector);
            let shares = fragment.cell_shares.iter();
            shares.flat_map(|(_, points)| points).for_each(&mut vector);
        }
        for fragment in &fracture.fragments {
            let triangles = fragment.mesh.triangles.iter().flatten();
            bits.extend(triangles.map(|&v| u64::from(v)));
            bits.extend(fragment.mass.inertia.to_cols_array().map(f64::to_bits));
            bits.extend(fragment.mass.centre.to_array().map(f64::to_bits));
            bits.push(fragment.mass.mass.to_bits());
        }
    }
    if let Outcome::Held {
        state: Some(state), ..
    } = outcome
    {
        bits.extend(state.to_bytes().into_iter().map(u64::from));
    }
    bits
}

impl Numbers {
    /// A blow on a random place of the surface, from outside, up to 20 m/s, most of them soft.
    pub(crate) fn blow(&mut self, asset: &Asset) -> Contact {
        let triangle = (self.next() * asset.surface().triangles.len() as f64) as usize;
        let corner = asset.surface().triangles[triangle][0] as usize;
        let inward = -asset.surface().normals[triangle][0];
        let tilt = Vec3::from_array(std::array::from_fn(|_| self.next() as f32 - 0.5));
        let speed = 20.0 * self.next().powi(6);
        let striker = steel_ball(0.02 + 0.2 * self.next());
        let point = asset.fracture().positions[corner];
        Contact::collision(asset, point, inward + tilt, speed, striker)
    }
}
