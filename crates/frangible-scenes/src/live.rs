//! Interactive simulation of a scene, step by step, with the current objects and their shapes.

mod looks;
mod reel;
mod schedule;
mod state;
mod swing;
mod throw;

use std::collections::BTreeMap;
use std::sync::Arc;

use frangible::glam::{DVec3, Quat, Vec3};
use frangible::{Body, Breakable, Fracture, Fragment};
use frangible_rapier::rapier3d::dynamics::RigidBodyHandle;
use frangible_rapier::{BreakEvent, BreakableWorld};
use frangible_recording::{Floor, Image, Pose, RecordedMesh, SurfaceMaterial};
use frangible_sound::Sounding;

use crate::bake::BakedBody;
use crate::cracks::with_cracks;
use crate::error::SceneError;
use crate::marks::Marks;
use crate::meshes::{BodySurfaces, origin, piece};
use crate::recorder::{Role, piece_sounding};
use crate::run::resist_rolling;
use crate::scene::Scene;
use crate::stage::{Stage, set_up, set_up_kinds};

use schedule::Schedule;
use swing::Swung;

pub use reel::Reel;
pub use state::SavedScene;
pub use swing::Swing;
pub use throw::Throw;

/// Number of the shortest steps per second, 1/s: those taken while something may break, as in [`play`](crate::play()).
const TICKS_PER_SECOND: u64 = 3840;

/// Ticks of a step when nothing is about to break.
const COARSE: u64 = 16;

/// Ticks of a picture.
const FRAME: u64 = 64;

/// Ticks after a break that are still taken one by one.
const FINE_AFTER_BREAK: u64 = 2 * FRAME;

/// Kind of an object in a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ThingKind {
    /// A breakable body of the scene: its number, from 0.
    Body(usize),
    /// A piece of another object.
    Piece {
        /// Index of the object that broke.
        of: usize,
        /// Position of its centre of mass in the frame of that object, m.
        birth: Vec3,
    },
    /// A projectile.
    Projectile,
}

/// A rigid object with its shape.
#[derive(Clone, Debug)]
pub struct Thing {
    /// Its name.
    pub name: String,
    /// Its kind.
    pub kind: ThingKind,
    /// Its shape in its own frame, m; surfaces are those of [`LiveScene::surfaces`].
    pub mesh: RecordedMesh,
    /// Mass, kg.
    pub mass: f64,
    /// Volume, m³.
    pub volume: f64,
    /// Its rigid body in [`LiveScene::world`].
    pub handle: RigidBodyHandle,
    /// The thing as a sound source.
    pub sounding: Sounding,
    surfaces: Option<BodySurfaces>,
    /// Its shape without the cracks that part nothing and came later, where it has such cracks.
    plain: Option<RecordedMesh>,
}

/// A running simulation of a scene. The same scene, throws and number of steps give bit-identical results.
pub struct LiveScene {
    name: String,
    world: BreakableWorld,
    surfaces: Vec<SurfaceMaterial>,
    images: Vec<Image>,
    things: Vec<Arc<Thing>>,
    /// Whole bodies as they are before the next step, with the cracks they have.
    whole: BTreeMap<(u32, u32), Body>,
    floor: Option<Floor>,
    ticks: u64,
    fine_until: u64,
    throws: usize,
    schedule: Schedule,
    swings: Vec<Swung>,
}

impl LiveScene {
    /// Sets up the scene before its first step.
    ///
    /// # Errors
    /// An invalid quantity of the scene, or a wrong number of baked bodies.
    pub fn new(scene: &Scene, baked: &[BakedBody]) -> Result<Self, SceneError> {
        scene.validate()?;
        Ok(Self::of_stage(scene, set_up(scene, baked)?))
    }

    /// Sets up the scene before its first step with bodies of these kinds. The weakness in the description of the scene is ignored.
    ///
    /// # Errors
    /// An invalid quantity of the scene, or a wrong number of kinds.
    pub fn of_kinds(scene: &Scene, kinds: &[Breakable]) -> Result<Self, SceneError> {
        scene.validate()?;
        Ok(Self::of_stage(scene, set_up_kinds(scene, kinds, |_| {})?))
    }

    fn of_stage(scene: &Scene, stage: Stage<'_>) -> Self {
        let Stage {
            world,
            recorder,
            bodies,
            projectiles,
        } = stage;
        let targets = bodies.iter().map(|placed| placed.target).collect();
        let (recording, handles, roles, soundings) = recorder.into_parts();
        let nodes = recording.nodes.into_iter().zip(recording.meshes);
        let mut things = Vec::new();
        let known = nodes.zip(handles).zip(roles).zip(soundings);
        for ((((node, mesh), handle), role), sounding) in known {
            let extra = |key: &str| {
                let found = node.keep_extras.iter().find(|(name, _)| name == key);
                found.map_or(0.0, |(_, value)| *value)
            };
            let placed = bodies.iter().position(|placed| placed.handle == handle);
            let (kind, surfaces) = match (role, placed) {
                (Role::Body, Some(i)) => (ThingKind::Body(i), Some(bodies[i].surfaces.clone())),
                _ => (ThingKind::Projectile, None),
            };
            things.push(Arc::new(Thing {
                mass: extra("mass_kg"),
                volume: extra("volume_m3"),
                name: node.name,
                kind,
                mesh,
                handle,
                sounding,
                surfaces,
                plain: None,
            }));
        }
        let mut live = Self {
            name: scene.name.clone(),
            world,
            surfaces: recording.surfaces,
            images: recording.images,
            things,
            whole: BTreeMap::new(),
            floor: scene.floor.as_ref().map(|_| Floor::default()),
            ticks: 0,
            fine_until: 0,
            throws: 0,
            schedule: Schedule::new(scene, targets, projectiles),
            swings: Vec::new(),
        };
        live.note_whole(live.things.clone().iter().map(|thing| thing.handle));
        live
    }

    /// Advances by one step: 1/3840 s while something may break and just after, otherwise 1/240 s. Breaks of the step are in the world's
    /// [`breaks`](BreakableWorld::breaks), impacts that broke nothing in [`held`](BreakableWorld::held). The projectiles of the scene are
    /// inserted and removed at frames of 1/60 s, as in [`play`](crate::play()).
    ///
    /// # Errors
    /// A break that the fracture model rejected; the body stays whole, and the simulation can continue. A projectile that cannot be thrown.
    pub fn step(&mut self) -> Result<(), SceneError> {
        if self.ticks.is_multiple_of(FRAME) {
            self.throw_due()?;
        }
        let ticks = self.ticks_of_step();
        let dt = ticks as f32 / TICKS_PER_SECOND as f32;
        self.world.physics.integration_parameters.dt = dt;
        self.drive_swings(dt);
        let stepped = self.world.step().map(|_| ());
        let before = self.ticks;
        self.ticks += ticks;
        self.follow_swings();
        let events: Vec<BreakEvent> = self.world.breaks().to_vec();
        for event in &events {
            self.fine_until = self.ticks + FINE_AFTER_BREAK;
            self.broke(event);
        }
        let cracked = self.world.held().iter().filter(|held| held.state.is_some());
        let cracked: Vec<RigidBodyHandle> = cracked.map(|held| held.body).collect();
        for &handle in &cracked {
            self.cracked(handle);
        }
        self.note_whole(cracked.into_iter());
        if before / FRAME != self.ticks / FRAME {
            resist_rolling(&mut self.world);
        }
        Ok(stepped?)
    }

    fn ticks_of_step(&mut self) -> u64 {
        let coarse = COARSE as f32 / TICKS_PER_SECOND as f32;
        let whole = |body: Option<&Body>| body.is_some_and(|body| body.generation() == 0);
        let world = &mut self.world;
        let fine = self.ticks < self.fine_until
            || world
                .breakables()
                .any(|handle| whole(world.breakable(handle)))
            || !world.near_within(coarse).is_empty();
        match fine {
            true => 1,
            // Up to where coarse steps begin again, so that frames are whole.
            false => COARSE - self.ticks % COARSE,
        }
    }

    /// Puts pieces in the place of what broke.
    fn broke(&mut self, event: &BreakEvent) {
        let parent = self.things.iter().rposition(|t| t.handle == event.parent);
        let Some(parent) = parent else { return };
        let of = Arc::clone(&self.things[parent]);
        let Some(surfaces) = &of.surfaces else { return };
        let marks = Marks::of(&event.fracture.report, &event.asset, None);
        for (i, (fragment, &handle)) in event
            .fracture
            .fragments
            .iter()
            .zip(&event.fragments)
            .enumerate()
        {
            let name = format!("{} piece {}", of.name, i + 1);
            let mut mesh = piece(&name, fragment, origin(&event.asset), surfaces).mesh;
            marks.lay_on(&mut mesh, fragment.mass.centre.as_vec3(), surfaces);
            self.things.push(Arc::new(Thing {
                name,
                kind: ThingKind::Piece {
                    of: parent,
                    birth: fragment.mass.centre.as_vec3(),
                },
                mesh,
                mass: fragment.mass.mass,
                volume: fragment.mass.volume,
                sounding: piece_sounding(&self.world, event, i),
                handle,
                surfaces: Some(surfaces.clone()),
                plain: None,
            }));
        }
        self.note_whole(event.fragments.iter().copied());
    }

    /// Shows the cracks that a body got without coming apart.
    fn cracked(&mut self, handle: RigidBodyHandle) {
        let number = self.things.iter().rposition(|t| t.handle == handle);
        let (Some(number), Some(body)) = (number, self.world.breakable(handle)) else {
            return;
        };
        let thing = &self.things[number];
        let plain = thing.plain.as_ref().unwrap_or(&thing.mesh);
        let surfaces = thing.surfaces.as_ref();
        let mesh = surfaces.and_then(|s| with_cracks(plain, body.asset(), body.state(), s));
        if let Some(mesh) = mesh {
            let plain = Some(plain.clone());
            let changed = Thing {
                mesh,
                plain,
                ..(**thing).clone()
            };
            self.things[number] = Arc::new(changed);
        }
    }

    /// The shapes of the pieces of a thing, in its own frame, each with the position of its centre of mass in it, m; for a break that
    /// did not happen here. None for a thing that cannot break.
    #[must_use]
    pub fn shapes(&self, thing: &Thing, fracture: &Fracture) -> Vec<(Vec3, RecordedMesh)> {
        let Some(surfaces) = &thing.surfaces else {
            return Vec::new();
        };
        let shape = |fragment: &Fragment| {
            let mesh = piece("", fragment, DVec3::ZERO, surfaces).mesh;
            (fragment.mass.centre.as_vec3(), mesh)
        };
        fracture.fragments.iter().map(shape).collect()
    }

    /// Remembers these bodies as they are before the next step.
    fn note_whole(&mut self, handles: impl Iterator<Item = RigidBodyHandle>) {
        for handle in handles {
            if let Some(body) = self.world.breakable(handle) {
                self.whole.insert(handle.into_raw_parts(), body.clone());
            }
        }
    }

    /// The breakable body behind a handle in its state before the last step, including its cracks, even if it broke in that step.
    #[must_use]
    pub fn body_before(&self, handle: RigidBodyHandle) -> Option<&Body> {
        self.whole.get(&handle.into_raw_parts())
    }

    /// The Rapier world of the simulation.
    #[must_use]
    pub fn world(&self) -> &BreakableWorld {
        &self.world
    }

    /// The Rapier world of the simulation, which may be changed between steps.
    pub fn world_mut(&mut self) -> &mut BreakableWorld {
        &mut self.world
    }

    /// Surface materials to which the meshes refer.
    #[must_use]
    pub fn surfaces(&self) -> &[SurfaceMaterial] {
        &self.surfaces
    }

    /// The floor, y = 0, if there is one.
    #[must_use]
    pub fn floor(&self) -> Option<&Floor> {
        self.floor.as_ref()
    }

    /// All objects so far, including removed ones; indices stay valid.
    #[must_use]
    pub fn things(&self) -> &[Arc<Thing>] {
        &self.things
    }

    /// Current pose of an object; `None` if it broke or was removed.
    #[must_use]
    pub fn pose(&self, thing: &Thing) -> Option<Pose> {
        let pose = self.world.physics.bodies.get(thing.handle)?.position();
        Some(Pose {
            translation: Vec3::from(pose.translation.to_array()),
            rotation: Quat::from_array(pose.rotation.to_array()),
        })
    }

    /// Speed of the centre of mass of an object, m/s.
    #[must_use]
    pub fn speed(&self, thing: &Thing) -> Option<f32> {
        let body = self.world.physics.bodies.get(thing.handle)?;
        Some(body.linvel().length())
    }

    /// Number of a surface; equal ones are kept once.
    fn surface(&mut self, look: SurfaceMaterial) -> usize {
        let known = &mut self.surfaces;
        known.iter().position(|k| *k == look).unwrap_or_else(|| {
            known.push(look);
            known.len() - 1
        })
    }

    /// Simulated time, s.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.ticks as f64 / TICKS_PER_SECOND as f64
    }
}
