//! Speed that a ball loses to a free pane: by the blow and its way through the pieces alone, without an engine, and in Rapier with steps of
//! several lengths. A measuring tool: `cargo run --release -p frangible-rapier --example passage -- 20 40 0.25` throws at 20 m/s with forty
//! seeds, and looks at the ball 0.25 s after it could have touched the pane.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::error::Error;
use std::f64::consts::PI;
use std::sync::Arc;

use frangible::MassProperties;
use frangible::glam::{DMat3, DVec3, Vec3};
use frangible::internals::rigid::{
    Kick, Rigid, fly_through, nearest_first, take_blow, take_energy, take_held,
};
use frangible::{
    Asset, Breakable, Contact, FractureConfig, InputError, Material, Outcome, Striker, impact,
};
use frangible_rapier::rapier3d::geometry::SharedShape;
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties, WorldConfig, WorldError};

/// Steps per second.
const RATES: [f32; 4] = [60.0, 120.0, 240.0, 480.0];

/// Radius of the ball, m.
const RADIUS: f32 = 0.0158;

/// Centre of the ball before its flight, m.
const START: Vec3 = Vec3::new(0.01, 0.005, 0.1);

/// A throw: the pane, the material of the ball, its mass, kg, and its speed, m/s.
struct Throw {
    pane: Breakable,
    steel: Material,
    mass: f64,
    speed: f32,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let speed: f32 = words.next().map_or(Ok(20.0), |word| word.parse())?;
    let seeds: u64 = words.next().map_or(Ok(40), |word| word.parse())?;
    let seconds: f32 = words.next().map_or(Ok(0.25), |word| word.parse())?;
    let bodies = concat!(env!("CARGO_MANIFEST_DIR"), "/../frangible/tests/bodies");
    let pane = Asset::load(format!("{bodies}/pane.frangible"))?;
    let steel = Material::preset("steel")?;
    let throw = Throw {
        pane: Breakable::new(Arc::new(pane))?,
        mass: steel.density * 4.0 / 3.0 * PI * f64::from(RADIUS).powi(3),
        steel,
        speed,
    };
    let alone: Result<Vec<f64>, _> = (0..seeds).map(|seed| throw.alone(seed)).collect();
    let alone = alone?;
    println!(
        "| steps per second | broke, of {seeds} | lost, m/s | more than alone, m/s |\n|---|---|---|---|"
    );
    println!("| alone | | {} | |", shown(&alone));
    for rate in RATES {
        let ends = (0..seeds).map(|seed| throw.in_rapier(seed, rate, seconds));
        let ends: Vec<(f64, bool)> = ends.collect::<Result<_, _>>()?;
        let broke = ends.iter().filter(|(_, broke)| *broke).count();
        let lost: Vec<f64> = ends.iter().map(|(lost, _)| *lost).collect();
        let more: Vec<f64> = lost.iter().zip(&alone).map(|(a, b)| a - b).collect();
        println!("| {rate} | {broke} | {} | {} |", shown(&lost), shown(&more));
    }
    Ok(())
}

/// A mean, and its standard error.
fn shown(values: &[f64]) -> String {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
    let error = (squares / (n * (n - 1.0))).sqrt();
    format!("{mean:.3} ± {error:.3}")
}

impl Throw {
    /// Speed that the ball loses by the blow and on its way through the pieces, m/s.
    fn alone(&self, seed: u64) -> Result<f64, InputError> {
        let body = self.pane.body(seed);
        let place = body.nearest_on_surface(START * Vec3::new(1.0, 1.0, 0.1));
        let striker = Striker::ball(&self.steel, self.mass, f64::from(RADIUS));
        let contact = Contact::strike(place.position, Vec3::NEG_Z, self.speed, striker);
        let outcome = impact(&body, &[contact], &FractureConfig::default())?;
        let pushes: Vec<(DVec3, DVec3)> = (outcome.report().contacts.iter())
            .map(|c| (c.point.as_dvec3(), c.normal.as_dvec3() * c.impulse))
            .collect();
        let radius = f64::from(RADIUS);
        let inertia = DMat3::from_diagonal(DVec3::splat(0.4 * self.mass * radius.powi(2)));
        let centre = place.position.as_dvec3() + DVec3::Z * radius;
        let velocity = DVec3::NEG_Z * f64::from(self.speed);
        let mut ball = [Rigid::free(
            self.mass,
            inertia,
            [centre, velocity, DVec3::ZERO],
        )];
        let still = |m: &MassProperties| {
            Rigid::free(m.mass, m.inertia, [m.centre, DVec3::ZERO, DVec3::ZERO])
        };
        let Outcome::Broke(fracture) = &outcome else {
            take_held(&mut still(&body.asset().mass()), &mut ball, &pushes);
            return Ok((ball[0].linear - velocity).z);
        };
        let order = nearest_first(fracture, &[place.position]);
        let mut all: Vec<Rigid> = (order.iter())
            .map(|&i| still(&fracture.fragments[i].mass))
            .collect();
        let taken = Kick::about(centre, &pushes).scaled(-1.0);
        let axes = (&order[..], DMat3::IDENTITY);
        let lost = take_blow(fracture, axes, &mut all, &mut ball, &pushes, taken);
        all.extend(ball);
        take_energy(&mut all, fracture.report.fracture_energy - lost);
        let (pieces, ball) = all.split_at_mut(order.len());
        let there = (&order[..], DMat3::IDENTITY, DVec3::ZERO);
        fly_through(fracture, there, pieces, ball);
        Ok((ball[0].linear - velocity).z)
    }

    /// Speed that the ball has lost in Rapier, m/s, this long after it could have touched the pane, and whether the pane broke.
    fn in_rapier(&self, seed: u64, rate: f32, seconds: f32) -> Result<(f64, bool), WorldError> {
        let mut config = WorldConfig::plain();
        (config.gravity, config.dt) = (Vector::ZERO, 1.0 / rate);
        let mut world = BreakableWorld::new(config)?;
        let pane = self.pane.body(seed);
        world.insert(pane, RigidBodyBuilder::dynamic())?;
        let surface = SurfaceProperties::of(&self.steel, RADIUS);
        let [x, y, z] = START.to_array();
        let ball = world.insert_rigid(
            SharedShape::ball(RADIUS),
            self.mass as f32,
            surface,
            Pose::translation(x, y, z),
            Vector::NEG_Z * self.speed,
        )?;
        let mut broke = false;
        for _ in 0..((seconds + z / self.speed) * rate) as usize {
            broke |= !world.step()?.is_empty();
        }
        let end = world.physics.bodies.get(ball);
        let end = end.map_or(Vector::ZERO, |b| b.linvel());
        Ok((f64::from(end.z + self.speed), broke))
    }
}
