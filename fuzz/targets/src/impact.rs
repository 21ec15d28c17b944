//! No contact, load, configuration or weakness makes a break panic; an accepted one has a sound outcome.

use frangible::internals::asset::{scaled, with_material};
use frangible::internals::contact::SharedMass;
use frangible::internals::{Blast, Factors, Fatigue, Fields, Force, blast, fracture_at, rest};
use frangible::{
    Asset, Body, Breakable, Contact, FractureConfig, InputError, Material, Outcome, Striker,
    would_break,
};

use crate::bodies::{Kinds, kinds, small_kinds};
use crate::draw::Draw;

/// A break into more pieces is not computed again to compare.
const MANY: usize = 60;

/// A body of one of the kinds: of another size, of another material, with weakness, or as it is.
fn body(draw: &mut Draw<'_>, kinds: &Kinds) -> Option<Body> {
    let mut kind = kinds[draw.below(3)].clone();
    if draw.below(8) == 7 {
        let asset = scaled(kind.asset(), draw.size(0.2, 5.0)).ok()?;
        kind = Breakable::new(asset).ok()?;
    }
    if draw.below(8) == 7 {
        let mut material = kind.asset().material().clone();
        for (number, least, most) in [
            (&mut material.youngs_modulus, 1e8, 5e11),
            (&mut material.density, 300.0, 2e4),
            (&mut material.stiffness_damping, 1e-9, 1e-5),
            (&mut material.mass_damping, 0.1, 1e3),
            (&mut material.strength, 1e4, 1e9),
            (&mut material.fracture_energy, 0.1, 1e4),
            (&mut material.energy_depth, 1e-5, 0.25),
            (&mut material.weak_point_density, 1e2, 1e9),
            (&mut material.roughness_amplitude, 1e-5, 1e-2),
            (&mut material.roughness_wavelength, 1e-4, 0.1),
        ] {
            if draw.flag() {
                *number = draw.size(least, most);
            }
        }
        let asset = with_material(kind.asset(), &material).ok()?;
        kind = Breakable::new(asset).ok()?;
    }
    if draw.flag() {
        let mut factors = || Factors {
            strength: draw.size(0.05, 20.0) as f32,
            toughness: draw.size(0.05, 20.0) as f32,
            weak_points: draw.size(0.05, 20.0) as f32,
            groove: draw.size(1e-5, 0.1) as f32 * f32::from(u8::from(draw.between(0.0, 1.0) > 0.7)),
        };
        let (here, there) = (factors(), factors());
        let (normal, distance) = (draw.direction(), draw.between(-0.1, 0.1) as f32);
        let asset = kind.asset();
        let mut fields = Fields::from_function(asset, |p| match p.dot(normal) < distance {
            true => here,
            false => there,
        });
        if draw.flag() {
            fields.weibull_modulus = draw.size(1.0, 50.0);
            fields.specimen = draw.size(1e-7, 1e-2);
            if draw.flag() {
                fields.fatigue = Some(Fatigue {
                    exponent: draw.size(3.0, 100.0),
                    rate: draw.size(1e3, 1e12),
                    increase: draw.size(1.01, 10.0),
                });
            }
        }
        if draw.below(16) == 15 {
            fields.of_tet.truncate(draw.below(200));
        }
        kind = kind.with_fields(fields).ok()?;
    }
    Some(kind.body(draw.bits()))
}

fn striker(
    draw: &mut Draw<'_>,
    kinds: &Kinds,
    config: &FractureConfig,
    contact: &Contact,
) -> Striker {
    let material = Material::presets();
    let steel = &material[draw.below(material.len())].material();
    let mut striker = match draw.below(5) {
        0 => Striker::ball(steel, draw.size(0.01, 2.0), draw.size(1e-3, 0.1)),
        1 => Striker::fixed(steel),
        2 => Striker::rigid(),
        3 => {
            let mut striker = Striker::rigid();
            striker.contact_modulus = draw.size(1e6, 1e12) as f32;
            striker.inverse_effective_mass = draw.size(1e-3, 1e4) as f32;
            striker.curvature_radius = draw.size(1e-4, 10.0) as f32;
            striker.restitution = draw.between(0.0, 1.0) as f32;
            striker.modal_duration = draw.size(1e-6, 1e-2) as f32;
            striker
        }
        _ => {
            let other = kinds[draw.below(3)].body(u64::from(draw.byte()));
            let mut felt = contact.clone();
            felt.point = draw.vector(0.15);
            let usual = Striker::fixed(steel);
            Striker::flexible(&other, &felt, config).unwrap_or(usual)
        }
    };
    if draw.below(4) == 3 {
        let [velocity, spin] = [draw.vector(3.0), draw.vector(3.0)];
        let squares = velocity.length_squared() + spin.length_squared();
        if draw.below(8) != 7 {
            striker.inverse_effective_mass = striker.inverse_effective_mass.max(squares);
        }
        striker.shared = Some(SharedMass {
            body: draw.below(3) as u32,
            velocity,
            spin,
        });
    }
    striker
}

fn contact(draw: &mut Draw<'_>, kinds: &Kinds, asset: &Asset, config: &FractureConfig) -> Contact {
    let (point, normal) = (draw.vector(0.15), draw.direction());
    if draw.below(4) == 3 {
        let push = normal * draw.size(1e-4, 100.0) as f32;
        return Contact::push(point, push, draw.size(1e-6, 0.1) as f32);
    }
    let speed = draw.size(0.1, 30.0);
    let plain = Contact::strike(point, normal, speed as f32, Striker::rigid());
    let striker = striker(draw, kinds, config, &plain);
    let mut contact = Contact::collision(asset, point, normal, speed, striker);
    if draw.below(4) == 3 {
        contact.impulse = draw.size(1e-4, 100.0) as f32;
        contact.friction = draw.vector(1.0);
        contact.approach_speed = draw.size(0.01, 300.0) as f32;
        contact.duration = draw.between(0.0, 0.01) as f32;
    }
    contact
}

/// Pieces that tile the body, and no number that is none.
fn check(body: &Body, outcome: &Outcome) {
    let report = outcome.report();
    let said = format!("{report:?}");
    // Only the text before it: a report may hold thousands of numbers.
    if let Some((before, _)) = said.split_once("NaN") {
        panic!("NaN after {}", &before[before.len().saturating_sub(300)..]);
    }
    let fracture = match outcome {
        Outcome::Held { margin, .. } => {
            assert!(*margin >= 0.0, "a margin of {margin}");
            return;
        }
        Outcome::Broke(fracture) => fracture,
        other => panic!("an outcome that nobody knows: {other:?}"),
    };
    let whole = &body.asset().mass();
    let (mut mass, mut volume) = (0.0, 0.0);
    assert!(!fracture.fragments.is_empty());
    for fragment in &fracture.fragments {
        let own = &fragment.mass;
        assert!(own.mass > 0.0 && own.volume > 0.0, "{own:?}");
        assert!(own.centre.is_finite() && own.inertia.is_finite(), "{own:?}");
        assert!(fragment.mesh.positions.iter().all(|p| p.is_finite()));
        mass += own.mass;
        volume += own.volume;
    }
    let close = |sum: f64, whole: f64| (sum / whole - 1.0).abs() < 1e-6;
    assert!(close(volume, whole.volume), "{volume} m³ of {whole:?}");
    assert!(close(mass, whole.mass), "{mass} kg of {whole:?}");
    assert!(report.volume_error.abs() < 1e-6, "{}", report.volume_error);
}

/// Bits of the fragments' masses, by which two outcomes are compared.
fn masses(outcome: &Outcome) -> Vec<u64> {
    match outcome {
        Outcome::Broke(fracture) => {
            let fragments = fracture.fragments.iter();
            fragments.map(|f| f.mass.mass.to_bits()).collect()
        }
        _ => Vec::new(),
    }
}

fn load(
    draw: &mut Draw<'_>,
    kinds: &Kinds,
    body: &Body,
    config: &FractureConfig,
) -> Result<Outcome, InputError> {
    match draw.below(8) {
        5 => {
            let count = 1 + draw.below(4);
            let forces: Vec<Force> = (0..count)
                .map(|_| Force {
                    point: draw.vector(0.15),
                    force: draw.direction() * draw.size(0.1, 1e5) as f32,
                })
                .collect();
            let gravity = draw.vector(10.0);
            let mut config = config.clone();
            if draw.flag() {
                config.load_duration = draw.size(1e-6, 1e10);
            }
            rest(body, &forces, gravity, &config)
        }
        6 => {
            let push = draw.direction() * draw.size(1e-3, 100.0) as f32;
            fracture_at(body, draw.vector(0.15), push, config)
        }
        7 => {
            let wave = Blast {
                origin: draw.vector(1.0),
                impulse: draw.size(0.1, 1e4) as f32,
                duration: draw.size(1e-6, 0.01) as f32,
            };
            blast(body, &wave, config)
        }
        _ => {
            let (asks, count) = (draw.byte(), 1 + draw.below(4));
            let contacts: Vec<Contact> = (0..count)
                .map(|_| contact(draw, kinds, body.asset(), config))
                .collect();
            let outcome = frangible::impact(body, &contacts, config);
            // A body that shatters takes long enough once.
            let quick = outcome.as_ref().map_or(0, |o| masses(o).len()) <= MANY;
            if quick && asks & 1 == 1 {
                let asked = would_break(body, &contacts, config);
                let broke = outcome.as_ref().map(|o| matches!(o, Outcome::Broke(_)));
                assert_eq!(asked.as_ref().ok(), broke.ok().as_ref(), "asked before");
            }
            if quick && asks & 6 == 6 {
                let mut other = config.clone();
                other.culling = !config.culling;
                let again = frangible::impact(body, &contacts, &other);
                // Errors hold NaN, which is not equal to itself.
                let pieces = outcome.as_ref().ok().map(masses);
                assert_eq!(again.as_ref().ok().map(masses), pieces, "culling");
            }
            outcome
        }
    }
}

/// Breaks the body that the bytes describe, by the blows that they describe.
pub fn impact(data: &[u8]) {
    run(data, kinds());
}

/// Runs [`impact`] with bodies of some 200 tetrahedra, for many inputs.
pub fn impact_small(data: &[u8]) {
    run(data, small_kinds());
}

fn run(data: &[u8], kinds: &Kinds) {
    let mut draw = Draw::new(data);
    let config = draw.fracture();
    let Some(mut body) = body(&mut draw, kinds) else {
        return;
    };
    // The second one finds the cracks of the first.
    for _ in 0..2 {
        let Ok(outcome) = load(&mut draw, kinds, &body, &config) else {
            return;
        };
        check(&body, &outcome);
        let Outcome::Held {
            state: Some(state), ..
        } = outcome
        else {
            return;
        };
        body.set_state(*state).expect("cracks of its own");
    }
}
