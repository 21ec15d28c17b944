//! Bodies baked once per test program, blows on them, and a GPU to compute them.

use std::sync::{Arc, OnceLock};

use frangible::glam::Vec3;
use frangible::{Asset, Breakable, Contact, Material, Outcome, Striker};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_lab::gpu::{Gpu, GpuError};

/// The GPU, or a message that the test is skipped. Where `CI` is set there must be one, if only in software.
pub(crate) fn gpu() -> Option<&'static Gpu> {
    static GPU: OnceLock<Result<Gpu, GpuError>> = OnceLock::new();
    match GPU.get_or_init(Gpu::new) {
        Ok(gpu) => Some(gpu),
        Err(error) => {
            let expected = std::env::var_os("CI").is_some();
            assert!(!expected, "CI is set, and {error}");
            println!("SKIPPED: {error}");
            None
        }
    }
}

/// Coarse, since an adapter in software is a hundred times slower than one in hardware.
fn kind(name: &str, shape: Shape, material: &str, analysis: f64) -> Breakable {
    let mut material = Material::preset(material).unwrap();
    material.weak_point_density *= 0.2;
    let spec = BakeSpec {
        modes: 20,
        analysis: Some(shape.size_for(analysis).unwrap()),
        fracture: Some(shape.size_for(6000.0).unwrap()),
        ..BakeSpec::new(name, shape, material)
    };
    Breakable::uniform(bake(&spec).unwrap()).unwrap()
}

/// Drinking glass, pane of 0.3 m, brick.
pub(crate) fn kinds() -> &'static [(&'static str, Breakable); 3] {
    static KINDS: OnceLock<[(&str, Breakable); 3]> = OnceLock::new();
    KINDS.get_or_init(|| {
        let pane = Shape::plate(0.3, 0.3, 0.004);
        let block = Shape::block([0.21, 0.1, 0.05]);
        [
            (
                "glass",
                kind("glass", Shape::drinking_glass(), "glass", 2500.0),
            ),
            ("pane", kind("pane", pane, "glass", 500.0)),
            ("block", kind("block", block, "brick", 500.0)),
        ]
    })
}

/// Numbers in 0..1 (a linear congruential generator).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A blow on a random place of the surface, from outside, at a speed, m/s.
    pub(crate) fn blow(&mut self, asset: &Asset, speed: f64) -> Contact {
        let triangle = (self.next() * asset.surface().triangles.len() as f64) as usize;
        let corner = asset.surface().triangles[triangle][0];
        let point = asset.fracture().positions[corner as usize];
        let tilt = Vec3::from_array(std::array::from_fn(|_| self.next() as f32 - 0.5));
        let normal = (tilt - asset.surface().normals[triangle][0]).normalize();
        let striker = self.striker();
        Contact::collision(asset, point, normal, speed, striker)
    }

    fn striker(&mut self) -> Striker {
        let restitution = 0.5;
        if self.next() < 0.5 {
            let steel = Material::preset("steel").unwrap();
            let mass = 0.02 + 0.2 * self.next();
            let radius = (mass / steel.density * 0.75 / std::f64::consts::PI).cbrt();
            Striker::ball(&steel, mass, radius).with_restitution(restitution)
        } else {
            Striker::fixed(&Material::preset("stone").unwrap()).with_restitution(restitution)
        }
    }
}

/// Parts of an outcome that the GPU must not change: cracks, energies and pieces, to the bit.
pub(crate) fn cracks_and_pieces(outcome: &Outcome) -> Vec<u64> {
    let report = outcome.report();
    let mut bits = vec![
        report.cracks as u64,
        report.crack_area.to_bits(),
        report.fracture_energy.to_bits(),
        report.contact_duration.to_bits(),
        report.time_steps as u64,
        report.first_crack_time.unwrap_or(-1.0).to_bits(),
    ];
    let point = report.first_crack_point.unwrap_or(Vec3::NAN);
    bits.extend(point.to_array().map(|x| u64::from(x.to_bits())));
    match outcome {
        Outcome::Broke(fracture) => {
            for fragment in &fracture.fragments {
                bits.push(fragment.mass.mass.to_bits());
                let positions = fragment.mesh.positions.iter();
                bits.extend(positions.flat_map(|p| p.to_array().map(|x| u64::from(x.to_bits()))));
            }
        }
        Outcome::Held {
            state: Some(state), ..
        } => bits.extend(state.to_bytes().iter().map(|&b| u64::from(b))),
        _ => (),
    }
    bits
}

/// A copy of a kind whose strength varies: weaker at one end, and scattered.
pub(crate) fn uneven(kind: &Breakable) -> Breakable {
    let asset: &Arc<Asset> = kind.asset();
    let fields = frangible::internals::Fields::from_function(asset, |p| {
        frangible::internals::Factors::of_strength(if p.x > 0.0 { 0.6 } else { 1.0 })
    })
    .with_weibull_modulus(8.0);
    kind.clone().with_fields(fields).unwrap()
}

/// A copy of a kind that is weak only at its outermost 3 mm along x and y: at the narrow edges of a pane.
pub(crate) fn weak_rim(kind: &Breakable) -> Breakable {
    let asset: &Arc<Asset> = kind.asset();
    let positions = asset.fracture().positions.iter();
    let half = positions.fold(Vec3::ZERO, |most, p| most.max(p.abs()));
    let fields = frangible::internals::Fields::from_function(asset, |p| {
        let rim = p.abs().truncate().cmpgt(half.truncate() - 0.003).any();
        frangible::internals::Factors::of_strength(if rim { 1.0 } else { 30.0 })
    })
    .with_weibull_modulus(0.0);
    kind.clone().with_fields(fields).unwrap()
}
