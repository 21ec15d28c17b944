//! The hammer.

use frangible::Material;
use frangible::glam::Vec3;
use frangible_scenes::Swing;

use super::Session;
use crate::camera::Ray;
use crate::command::{HammerSpec, Tool};
use crate::error::{ViewError, within};
use crate::picking::pick;

impl Session {
    pub(super) fn choose_hammer(&mut self, hammer: HammerSpec) -> Result<(), ViewError> {
        Material::preset(&hammer.material)?;
        within("the hammer's mass", hammer.mass, [1e-3, 100.0], "kg")?;
        within("the hammer's speed", hammer.speed, [0.1, 50.0], "m/s")?;
        self.hammer = hammer;
        self.tool = Tool::Hammer;
        Ok(())
    }

    pub(super) fn swing(&mut self, from: Vec3, through: Vec3) -> Result<(), ViewError> {
        let explode = self.explode as f32;
        let hammer = self.hammer.clone();
        let direction = (through - from).normalize_or_zero();
        let live = self.running()?;
        let ray = Ray {
            origin: from,
            direction,
        };
        let met = pick(live, explode, ray).ok_or_else(|| {
            ViewError::NotNow("the hammer has no target; aim at an object".into())
        })?;
        live.swing(&Swing {
            mass: hammer.mass,
            speed: hammer.speed,
            material: hammer.material,
            from,
            at: from + met.distance * direction,
        })?;
        Ok(())
    }
}
