//! Every number of a scene, checked before anything long begins.

use frangible::Material;
use frangible::glam::Vec3;
use frangible::{CrackPath, CrackTiming, DurationModel, FractureConfig};

use crate::body::{BodySpec, Place};
use crate::error::SceneError;
use crate::output::Output;
use crate::projectile::{Projectile, ProjectileKind};
use crate::scene::Scene;
use crate::source::BodySource;

/// Largest speed of a ball or a body, m/s: beyond, stress waves steepen into shocks that modes cannot carry.
const MAX_SPEED: f64 = 300.0;

/// Highest drop, m.
const MAX_HEIGHT: f64 = 100.0;

/// Most bodies, and most projectiles, of a scene.
const MOST_ITEMS: usize = 100;

/// Most seeds on a sheet.
const MOST_SEEDS: usize = 36;

/// Longest name of a scene or a file, bytes.
const LONGEST_NAME: usize = 120;

/// What is wrong, and under which key of a scene file it stands.
#[derive(Debug)]
pub(crate) struct Fault {
    /// List and number in it: `body` 0 is the first `[[body]]`.
    pub(crate) item: Option<(&'static str, usize)>,
    /// The key, below the item if there is one; dots part tables.
    pub(crate) key: &'static str,
    pub(crate) error: SceneError,
}

impl Fault {
    pub(crate) fn new(key: &'static str, error: impl Into<SceneError>) -> Self {
        Self {
            item: None,
            key,
            error: error.into(),
        }
    }

    pub(crate) fn of(self, list: &'static str, index: usize) -> Self {
        Self {
            item: Some((list, index)),
            ..self
        }
    }
}

impl Scene {
    /// Checks every number before anything long begins. Files are not looked at.
    ///
    /// # Errors
    /// The first quantity at fault, and what it must be.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.check().map_err(|fault| match fault.item {
            Some((list, index)) if self.bodies.len() + self.projectiles.len() > 2 => {
                SceneError::Item {
                    item: format!("{list} {}", index + 1),
                    source: Box::new(fault.error),
                }
            }
            _ => fault.error,
        })
    }

    /// As [`Scene::validate`], with the place of the fault.
    pub(crate) fn check(&self) -> Result<(), Fault> {
        file_name("name", "the scene's name", &self.name)?;
        for (key, what, count, least) in [
            ("body", "the number of bodies", self.bodies.len(), 1),
            (
                "projectile",
                "the number of projectiles",
                self.projectiles.len(),
                0,
            ),
        ] {
            if !(least..=MOST_ITEMS).contains(&count) {
                let must = if least == 0 {
                    "at most 100"
                } else {
                    "1 to 100; add a [[body]]"
                };
                return Err(quantity(key, what, count, must));
            }
        }
        range(
            "duration",
            "the duration",
            self.duration,
            0.0,
            60.0,
            "above 0 and at most 60 s",
        )?;
        direction("look_from", "the direction of the camera", self.look_from)?;
        if let Some(floor) = &self.floor {
            Material::preset(floor).map_err(|e| Fault::new("floor", e))?;
        }
        for (i, body) in self.bodies.iter().enumerate() {
            check_body(body).map_err(|fault| fault.of("body", i))?;
        }
        for (i, projectile) in self.projectiles.iter().enumerate() {
            check_projectile(projectile, self.bodies.len())
                .map_err(|fault| fault.of("projectile", i))?;
        }
        check_fracture(&self.fracture)?;
        check_output(&self.output, &self.name)
    }
}

fn check_body(body: &BodySpec) -> Result<(), Fault> {
    if body.name.is_empty() || body.name.len() > LONGEST_NAME {
        let must = "1 to 120 bytes long";
        return Err(quantity(
            "name",
            "the body's name",
            format!("`{}`", body.name),
            must,
        ));
    }
    body.material
        .validate()
        .map_err(|e| Fault::new("material", e))?;
    range(
        "modes",
        "the number of modes",
        body.modes as f64,
        0.0,
        1000.0,
        "1 to 1000",
    )?;
    if let BodySource::Mesh {
        size, resolution, ..
    } = &body.source
    {
        if let Some(size) = *size {
            let must = "above 0 and at most 3 m";
            range("size", "the body's size", size, 0.0, 3.0, must)?;
        }
        if let Some(tets) = *resolution
            && !(500..=2_000_000).contains(&tets)
        {
            let must = "500 to 2000000 tetrahedra";
            return Err(quantity("resolution", "the resolution", tets, must));
        }
    }
    if let BodySource::Shape(shape) = &body.source {
        shape.volume().map_err(|e| Fault::new("shape", e))?;
    }
    match body.place {
        Place::Standing { over } => finite("position", "the body's position", flat(over))?,
        Place::Above { height, over } => {
            let must = "above 0 and at most 100 m";
            range("drop", "the drop height", height, 0.0, MAX_HEIGHT, must)?;
            finite("position", "the body's position", flat(over))?;
        }
        Place::Centre(centre) => finite("position", "the body's position", centre)?,
    }
    if !(body.rotation.is_finite() && (body.rotation.length() - 1.0).abs() < 1e-3) {
        return Err(quantity(
            "rotation",
            "the body's rotation",
            body.rotation,
            "a unit quaternion",
        ));
    }
    let limited = |key, what, v: Vec3, limit: f64, must| {
        finite(key, what, v)?;
        if f64::from(v.length()) > limit {
            return Err(quantity(key, what, v, must));
        }
        Ok(())
    };
    limited(
        "velocity",
        "the body's velocity",
        body.velocity,
        MAX_SPEED,
        "at most 300 m/s",
    )?;
    limited(
        "spin",
        "the body's spin",
        body.spin,
        1e3,
        "at most 1000 rad/s",
    )?;
    if !body.supports.is_empty() {
        return Err(Fault::new("supports", SceneError::NotBuilt("supports")));
    }
    Ok(())
}

fn check_projectile(projectile: &Projectile, bodies: usize) -> Result<(), Fault> {
    let ball = projectile.kind == ProjectileKind::Ball;
    let what = |of_ball, of_hammer| if ball { of_ball } else { of_hammer };
    range(
        "mass",
        what("the ball's mass", "the hammer's mass"),
        projectile.mass,
        0.0,
        1e4,
        "above 0 and at most 10000 kg",
    )?;
    range(
        "radius",
        what("the ball's radius", "the hammer's radius"),
        projectile.radius,
        0.0,
        10.0,
        "above 0 and at most 10 m",
    )?;
    range(
        "speed",
        what("the ball's speed", "the hammer's speed"),
        projectile.speed,
        0.0,
        MAX_SPEED,
        "above 0 and at most 300 m/s",
    )?;
    if let ProjectileKind::Hammer { crown } = projectile.kind
        && !(crown.is_finite() && crown >= projectile.radius)
    {
        let must = "a finite length, no less than the face's radius, in m";
        return Err(quantity("crown", "the hammer's crown", crown, must));
    }
    Material::preset(&projectile.material).map_err(|e| Fault::new("material", e))?;
    if projectile.target >= bodies {
        let must = "the number of a body of the scene";
        let target = projectile.target + 1;
        return Err(quantity("target", "the target", target, must));
    }
    if !projectile.at.is_finite() {
        return Err(quantity(
            "at",
            "--at",
            projectile.at,
            "three finite numbers, m",
        ));
    }
    direction("toward", "--toward", projectile.toward)
}

fn check_fracture(config: &FractureConfig) -> Result<(), Fault> {
    range(
        "fracture.samples_per_period",
        "the number of samples per period",
        config.samples_per_period,
        0.0,
        1000.0,
        "above 0 and at most 1000",
    )?;
    if !(0.0..1.0).contains(&config.crumb_share) {
        return Err(quantity(
            "fracture.crumb_share",
            "the crumbs' share",
            config.crumb_share,
            "0 or more and below 1",
        ));
    }
    if let DurationModel::AsPrinted { c } = config.duration {
        let must = "above 0 and at most 1000";
        range("fracture.duration", "the constant c", c, 0.0, 1000.0, must)?;
    }
    if let CrackTiming::TimeResolved {
        speed,
        release_reach,
    } = config.timing
    {
        let must = "above 0 and at most 1";
        range("fracture.timing", "the crack speed", speed, 0.0, 1.0, must)?;
        if !(0.0..=100.0).contains(&release_reach) {
            let must = "0 to 100";
            return Err(quantity(
                "fracture.timing",
                "the release reach",
                release_reach,
                must,
            ));
        }
    }
    if let CrackPath::Steered { turning_length } = config.path {
        let must = "above 0 and at most 10 m";
        range(
            "fracture.path",
            "the turning length",
            turning_length,
            0.0,
            10.0,
            must,
        )?;
    }
    Ok(())
}

fn check_output(output: &Output, scene: &str) -> Result<(), Fault> {
    if !(1..=MOST_SEEDS).contains(&output.seeds) {
        return Err(quantity(
            "output.seeds",
            "the number of seeds",
            output.seeds,
            "1 to 36",
        ));
    }
    let keys = [
        "output.glb",
        "output.picture",
        "output.contact_sheet",
        "output.json",
    ];
    let names = output.file_names(scene);
    for (i, (key, name)) in keys.into_iter().zip(&names).enumerate() {
        let Some(name) = name else { continue };
        file_name(key, "the name of a file", name)?;
        if names[..i].contains(&Some(name.clone())) {
            let must = "different from the other files'";
            return Err(quantity(
                key,
                "the name of a file",
                format!("`{name}`"),
                must,
            ));
        }
    }
    Ok(())
}

/// A name that cannot leave the output folder, on any system.
fn file_name(key: &'static str, what: &'static str, name: &str) -> Result<(), Fault> {
    let blank = name.trim() != name || name.is_empty();
    if blank || name.starts_with('.') || name.len() > LONGEST_NAME || name.contains(is_odd) {
        let shown: String = name.chars().take(LONGEST_NAME).collect();
        let must = "a plain file name without folders, dots in front or special characters";
        return Err(quantity(
            key,
            what,
            format!("`{}`", shown.escape_debug()),
            must,
        ));
    }
    Ok(())
}

/// Characters that no file name may hold on some system.
fn is_odd(c: char) -> bool {
    c.is_control() || r#"/\:*?"<>|"#.contains(c)
}

/// The nearest name that a scene and its files may have.
pub(crate) fn tame(name: &str) -> String {
    let mut tame = String::new();
    for c in name.chars() {
        let in_front = tame.is_empty() && (c == '.' || c.is_whitespace());
        if tame.len() + c.len_utf8() <= LONGEST_NAME && !in_front {
            tame.push(if is_odd(c) { '_' } else { c });
        }
    }
    let tame = tame.trim_end();
    if tame.is_empty() {
        "body".into()
    } else {
        tame.into()
    }
}

fn quantity(
    key: &'static str,
    what: &'static str,
    value: impl ToString,
    must: &'static str,
) -> Fault {
    let value = value.to_string();
    Fault::new(key, SceneError::Quantity { what, value, must })
}

fn range(
    key: &'static str,
    what: &'static str,
    value: f64,
    above: f64,
    most: f64,
    must: &'static str,
) -> Result<(), Fault> {
    if value.is_finite() && value > above && value <= most {
        Ok(())
    } else {
        Err(quantity(key, what, value, must))
    }
}

fn direction(key: &'static str, what: &'static str, v: Vec3) -> Result<(), Fault> {
    if v.is_finite() && v.length() > 0.0 && v.length().is_finite() {
        Ok(())
    } else {
        Err(quantity(key, what, v, "three finite numbers, not all zero"))
    }
}

/// A place within a kilometre: farther away f32 loses the millimetre.
fn finite(key: &'static str, what: &'static str, v: Vec3) -> Result<(), Fault> {
    if v.is_finite() && v.abs().max_element() <= 1e3 {
        Ok(())
    } else {
        Err(quantity(
            key,
            what,
            v,
            "finite numbers, at most 1000 from the origin",
        ))
    }
}

fn flat([x, z]: [f32; 2]) -> Vec3 {
    Vec3::new(x, 0.0, z)
}
