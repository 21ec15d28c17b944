//! Bodies to break, and the features of each.

use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

use crate::Result;
use frangible::glam::{DVec3, Quat, Vec3};
use frangible::{Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeSpec, Shape, SolidShape};
use frangible_mesh::DistanceSolid;
use frangible_scenes::{
    Place, Projectile, Region, Scene, Support, bake, breakable, first_break, scene,
};

use super::features::{
    Feature, bottle, bowl, bulb, chocolate, flat, plate, solid, statue, tumbler, wine_glass,
};

/// A body, a blow, and the features to measure.
pub(crate) struct Subject {
    pub(crate) title: String,
    pub(crate) kind: Breakable,
    pub(crate) contacts: Vec<Contact>,
    pub(crate) config: FractureConfig,
    pub(crate) features: Vec<Feature>,
}

/// All subjects, in the order of the page.
pub(crate) fn all() -> Result<Vec<Subject>> {
    let as_it_is = |_: &mut Scene| {};
    let thrown = |ball: Projectile| move |scene: &mut Scene| scene.throw(ball);
    let dropped = |height: f64| move |scene: &mut Scene| scene.drop_all(height);
    let new_glass = Material::preset("glass-new")?;
    let sideways = |mass, radius, speed| Projectile {
        toward: Vec3::X,
        ..Projectile::ball(mass, radius, speed)
    };
    Ok(vec![
        subject(
            "pane",
            "ball of 250 g at 5 m/s",
            thrown(Projectile::ball(0.25, 0.02, 5.0)),
            flat(),
        )?,
        subject(
            "pane",
            "ball of 250 g at 10 m/s",
            thrown(Projectile::ball(0.25, 0.02, 10.0)),
            flat(),
        )?,
        subject("pane", "ball of 250 g at 20 m/s", as_it_is, flat())?,
        subject(
            "pane",
            "of new glass, ball of 250 g at 20 m/s",
            |scene| scene.bodies[0].material = new_glass.clone(),
            flat(),
        )?,
        subject(
            "pane",
            "ball of 0.26 g, 4 mm wide, at 60 m/s",
            thrown(Projectile::ball(0.00026, 0.002, 60.0)),
            flat(),
        )?,
        subject(
            "window",
            "ball of 130 g at 6 m/s",
            thrown(Projectile::ball(0.13, 0.0158, 6.0)),
            flat(),
        )?,
        subject("window", "ball of 130 g at 20 m/s", as_it_is, flat())?,
        subject("shelf", "ball of 600 g at 4 m/s", as_it_is, flat())?,
        subject("plate", "dropped 1.5 m", as_it_is, plate())?,
        subject("plate", "dropped 0.5 m", dropped(0.5), plate())?,
        subject("bowl", "dropped 1 m", as_it_is, bowl())?,
        subject("bottle", "ball of 4 g at 45 m/s", as_it_is, bottle())?,
        subject(
            "bottle",
            "ball of 100 g at 6 m/s",
            thrown(sideways(0.1, 0.0145, 6.0)),
            bottle(),
        )?,
        subject("glass", "dropped 1.2 m", as_it_is, tumbler())?,
        subject("glass", "dropped 0.5 m", dropped(0.5), tumbler())?,
        subject("wine-glass", "dropped 1 m", as_it_is, wine_glass())?,
        subject("bulb", "dropped 1 m", as_it_is, bulb())?,
        subject("brick", "dropped 3 m on its end", as_it_is, solid())?,
        subject("hammer", "hammer of 500 g at 12 m/s", as_it_is, solid())?,
        subject("chocolate", "dropped 1 m", as_it_is, chocolate())?,
        subject("chocolate", "dropped 3 m", dropped(3.0), chocolate())?,
        subject(
            "chocolate",
            "clamped at one end, tapped at the other by 100 g of wood at 1 m/s",
            snap,
            chocolate(),
        )?,
        subject("statue", "dropped 0.45 m", as_it_is, statue())?,
        ice_ball(3.0)?,
        ice_ball(10.0)?,
    ])
}

/// The first break of a scene that is changed a little.
fn subject(
    name: &str,
    blow: &str,
    change: impl FnOnce(&mut Scene),
    features: Vec<Feature>,
) -> Result<Subject> {
    let mut scene = scene(name)?;
    change(&mut scene);
    let bodies = bake(&scene)?;
    let first = first_break(&scene, &bodies, &mut |_| {})?
        .ok_or_else(|| format!("{name}, {blow}: nothing breaks"))?;
    let spec = &scene.bodies[0];
    let speed = first
        .contacts
        .iter()
        .map(|c| c.approach_speed)
        .fold(0.0, f32::max);
    Ok(Subject {
        title: format!("{name}: {blow} (contact at {speed:.1} m/s)"),
        kind: breakable(spec, &Arc::clone(first.body.asset()))?,
        contacts: first.contacts,
        config: first.config,
        features,
    })
}

/// A ball of ice, 60 mm wide, thrown on stone.
fn ice_ball(speed: f32) -> Result<Subject> {
    let (ice, stone) = (Material::preset("ice")?, Material::preset("stone")?);
    let shape = SolidShape {
        tets: 40_000,
        ..SolidShape::new(Arc::new(DistanceSolid::sphere(DVec3::ZERO, 0.03)))
    };
    let spec = BakeSpec {
        modes: 200,
        ..BakeSpec::new("ball of ice", Shape::Solid(shape), ice)
    };
    let asset = frangible_bake::bake(&spec)?;
    let impulse = asset.mass().mass as f32 * speed;
    let lowest = Vec3::new(0.0, 0.0, -0.03);
    let contact = Contact {
        impulse,
        ..Contact::strike(lowest, Vec3::Z, speed, Striker::fixed(&stone))
    };
    let mut features = solid();
    features.push(Feature::new(
        "cracks that hold the line of the blow",
        "%",
        |b| b.share(|_| true, |cut| b.runs_away(cut)),
    ));
    Ok(Subject {
        title: format!("ball of ice, 60 mm wide: thrown on stone at {speed} m/s"),
        kind: Breakable::uniform(Arc::new(asset))?,
        contacts: vec![contact],
        config: FractureConfig::default(),
        features,
    })
}

/// The bar of chocolate as one snaps it: level, 50 mm of it held, a wooden ball on the far end.
fn snap(scene: &mut Scene) {
    let body = &mut scene.bodies[0];
    body.rotation = Quat::from_rotation_x(-FRAC_PI_2);
    body.place = Place::Centre(Vec3::new(0.0, 0.3, 0.0));
    body.supports = vec![Support::clamped(Region::below(0, 0.05))];
    scene.throw(Projectile {
        at: Vec3::new(0.07, 0.0, 0.0),
        toward: Vec3::NEG_Y,
        material: "wood".into(),
        ..Projectile::ball(0.1, 0.03, 1.0)
    });
}

/// The slowest ball that is tried, m/s.
pub(crate) const SLOWEST: f64 = 0.1;

/// A body, and where something hits it.
pub(crate) struct Struck {
    pub(crate) kind: Breakable,
    pub(crate) config: FractureConfig,
    point: Vec3,
    toward: Vec3,
    striker: Striker,
}

impl Struck {
    /// The blow at a speed, m/s.
    pub(crate) fn at(&self, speed: f64) -> Contact {
        let asset = self.kind.asset();
        Contact::collision(asset, self.point, self.toward, speed, self.striker.clone())
    }
}

/// The bottle of the scene, hit at the same place by a steel ball of 1 kg.
pub(crate) fn bottle_and_heavy_ball() -> Result<Struck> {
    let scene = subject("bottle", "", |_| {}, Vec::new())?;
    let steel = Material::preset("steel")?;
    let hit = &scene.contacts[0];
    Ok(Struck {
        point: hit.point,
        toward: hit.normal,
        striker: Striker::ball(&steel, 1.0, 0.0313),
        kind: scene.kind,
        config: scene.config,
    })
}

/// The drinking glass of the scene, which falls on its rim on stone.
pub(crate) fn falling_glass() -> Result<Struck> {
    let scene = subject("glass", "", |_| {}, Vec::new())?;
    let hit = &scene.contacts[0];
    Ok(Struck {
        point: hit.point,
        toward: hit.normal,
        striker: hit.striker.clone(),
        kind: scene.kind,
        config: scene.config,
    })
}
