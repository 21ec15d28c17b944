//! Sound of blows, cracks and landing pieces.
//!
//! [`frangible_sound`] computes the sound pressure at the ears in the time of the fixed steps, without an audio device and reproducibly. The
//! [`Outlet`] in the resource [`Heard`] is a queue of samples for playback.

mod cast;
mod pushes;

use avian3d::prelude::ContactGraph;
use bevy::prelude::*;
use frangible::{Asset as Baked, ImpactReport, Material};
use frangible_sound::glam::DVec3;
use frangible_sound::{
    Hearing, Level, Leveller, Limiter, Listener, Outlet, RecordedBlow, RecordedSlide,
    RecordedTouch, SoundError, SoundFloor, SynthConfig, SynthReport, Touching, recorded_blow,
};

use crate::meshes::into;
use crate::{BreakableBody, Broke, Broken, Held};

use cast::{Playing, Troupe};

/// Plugin for the sound of breaking bodies at an entity with [`Ears`]. Blows and cracks sound with any physics engine, touches and slides only with
/// Avian.
#[derive(Clone, Debug)]
pub struct FrangibleSoundPlugin {
    /// Samples per second. Default 48 000.
    pub rate: f64,
    /// Height, m, and material of a level floor, which reflects sound and sounds itself when struck. Default: stone at y = 0.
    pub floor: Option<(f32, Material)>,
    /// Level of the samples. Default [`Level::Loudness`]: soft sounds are raised and loud ones limited by a [`Leveller`]. With [`Level::True`] all
    /// have the same gain, and a soft limiter acts above 0.7 of full scale.
    pub level: Level,
    /// Sound pressure at full scale, Pa. Default [`Leveller::LIVE`], 10.
    pub full_scale: f64,
}

impl Default for FrangibleSoundPlugin {
    fn default() -> Self {
        Self {
            rate: 48_000.0,
            floor: Material::preset("stone").ok().map(|stone| (0.0, stone)),
            level: Level::default(),
            full_scale: Leveller::LIVE,
        }
    }
}

/// Marker of the listener, usually the camera; its local x axis is the direction to the right. Without such an entity there is no sound.
#[derive(Component, Clone, Copy, Debug, Default)]
#[require(Transform)]
pub struct Ears;

/// Resource with the sound of the world, step by step.
#[derive(Resource)]
pub struct Heard {
    hearing: Hearing,
    touching: Touching,
    troupe: Troupe,
    /// Blows since the last step that was heard.
    blows: Vec<RecordedBlow>,
    touches: Vec<RecordedTouch>,
    slides: Vec<RecordedSlide>,
    floor: Option<f32>,
    listener: Option<Listener>,
    playback: Playback,
    outlet: Outlet,
    pressures: Vec<f32>,
}

/// Converts pressures, Pa, to samples.
enum Playback {
    Levelled(Box<Leveller>),
    True(Limiter),
}

impl Playback {
    fn new(plugin: &FrangibleSoundPlugin, channels: usize) -> Result<Self, SoundError> {
        let (rate, full_scale) = (plugin.rate, plugin.full_scale);
        Ok(match plugin.level {
            Level::Loudness => Self::Levelled(Box::new(Leveller::new(rate, channels, full_scale)?)),
            Level::True => Self::True(Limiter::new(full_scale)?),
        })
    }

    fn samples(&mut self, pressures: &[f32]) -> Result<Vec<f32>, SoundError> {
        match self {
            Self::Levelled(leveller) => {
                let mut samples = Vec::with_capacity(pressures.len());
                leveller.level(pressures, &mut samples)?;
                Ok(samples)
            }
            Self::True(limiter) => Ok(pressures.iter().map(|&p| limiter.sample(p)).collect()),
        }
    }
}

impl Heard {
    fn new(plugin: &FrangibleSoundPlugin) -> Result<Self, SoundError> {
        let listener = Listener::at(DVec3::ZERO, DVec3::NEG_Z);
        let floor = plugin.floor.as_ref();
        let config = SynthConfig {
            rate: plugin.rate,
            floor: floor.map(|(height, material)| SoundFloor::of(material, f64::from(*height))),
            ..SynthConfig::new(listener)
        };
        Ok(Self {
            hearing: Hearing::new(config.live(), floor.map(|(_, material)| material.clone()))?,
            touching: Touching::default(),
            troupe: Troupe::default(),
            blows: Vec::new(),
            touches: Vec::new(),
            slides: Vec::new(),
            floor: floor.map(|(height, _)| *height),
            listener: None,
            playback: Playback::new(plugin, listener.channels)?,
            outlet: Outlet::new(plugin.rate),
            pressures: Vec::new(),
        })
    }

    /// Sound pressures of the last fixed step, Pa, left and right interleaved.
    #[must_use]
    pub fn pressures(&self) -> &[f32] {
        &self.pressures
    }

    /// The queue of samples for playback, −1 to 1, left and right interleaved. Clones share one queue, which holds at most half a second.
    #[must_use]
    pub fn outlet(&self) -> Outlet {
        self.outlet.clone()
    }

    /// Returns the synthesiser's statistics so far.
    #[must_use]
    pub fn report(&self) -> SynthReport {
        self.hearing.synth().report()
    }

    /// Takes note of a blow on a body of an asset.
    fn struck(
        &mut self,
        entity: Entity,
        (asset, report): (&Baked, &ImpactReport),
        time: f64,
        fragments: &[Entity],
    ) {
        let Some(node) = self.troupe.node(entity) else {
            return;
        };
        let pieces = self.troupe.pieces(fragments);
        let blow = recorded_blow(node, asset, report, time, pieces);
        // A blow that a bound refused is heard as the touch that it is.
        if !(blow.pulses.is_empty() && blow.cracks.is_empty()) {
            self.blows.push(blow);
        }
    }
}

impl Plugin for FrangibleSoundPlugin {
    fn build(&self, app: &mut App) {
        match Heard::new(self) {
            Ok(heard) => app.insert_resource(heard),
            Err(error) => {
                error!("the sound cannot be played: {error}");
                return;
            }
        };
        app.add_observer(appear)
            .add_observer(breaks)
            .add_observer(holds)
            .add_systems(
                FixedLast,
                (pushes::touch.run_if(resource_exists::<ContactGraph>), hear).chain(),
            );
    }
}

/// A body that is ready can sound.
fn appear(
    ready: On<Insert, BreakableBody>,
    bodies: Query<&BreakableBody>,
    mut heard: ResMut<Heard>,
) {
    if let Ok(body) = bodies.get(ready.entity) {
        heard.troupe.appear(ready.entity, &body.0);
    }
}

fn breaks(broke: On<Broke>, time: Res<Time<Fixed>>, mut heard: ResMut<Heard>) {
    let Some(asset) = heard.troupe.asset(broke.entity) else {
        return;
    };
    let material = asset.material().clone();
    heard
        .troupe
        .born(&broke.fragments, &broke.fracture, &material);
    let report = &broke.fracture.report;
    heard.struck(
        broke.entity,
        (&asset, report),
        time.elapsed_secs_f64(),
        &broke.fragments,
    );
}

fn holds(held: On<Held>, time: Res<Time<Fixed>>, mut heard: ResMut<Heard>) {
    if let Some(asset) = heard.troupe.asset(held.entity) {
        heard.struck(
            held.entity,
            (&asset, &held.report),
            time.elapsed_secs_f64(),
            &[],
        );
    }
}

/// Hears the step that was just taken.
fn hear(
    mut heard: ResMut<Heard>,
    ears: Query<Entity, With<Ears>>,
    places: TransformHelper,
    there: Query<Has<Broken>>,
    time: Res<Time<Fixed>>,
) {
    let heard = &mut *heard;
    let now = time.elapsed_secs_f64();
    let listener = ears.iter().next();
    let listener = listener.and_then(|ears| places.compute_global_transform(ears).ok());
    let heard_now = listener.map_or(Ok(()), |place| {
        heard.move_ears(listening(&place), now)?;
        heard.take_in(&places)
    });
    if let Err(error) = heard_now {
        error!("part of the sound is missing: {error}");
    }
    heard.blows.clear();
    heard.touches.clear();
    heard.slides.clear();
    heard.troupe.leave(&mut heard.hearing, &there, now);
    heard.pressures.clear();
    heard.hearing.until(now, &mut heard.pressures);
    match heard.playback.samples(&heard.pressures) {
        Ok(samples) => heard.outlet.put(&samples),
        Err(error) => error!("the sound of a step is missing: {error}"),
    }
}

impl Heard {
    fn move_ears(&mut self, listener: Listener, now: f64) -> Result<(), SoundError> {
        if self.listener == Some(listener) {
            return Ok(());
        }
        self.listener = Some(listener);
        self.hearing.synth_mut().listen(now, listener)
    }

    /// Passes the events to the synthesiser.
    fn take_in(&mut self, places: &TransformHelper) -> Result<(), SoundError> {
        let new = self.troupe.new_bodies();
        let cast = Playing {
            troupe: &self.troupe,
            places,
            floor: self.floor,
        };
        // Lest the first blow on a body of its kind waits.
        for node in new {
            self.hearing.prepare(&cast, node)?;
        }
        let felt = (&self.touches[..], &self.slides[..]);
        self.hearing.happened(&cast, &self.blows, felt)
    }
}

/// Ears where an entity is, with its own x to the right.
fn listening(place: &GlobalTransform) -> Listener {
    let double = |v: Vec3| into(v).as_dvec3();
    Listener {
        place: double(place.translation()),
        right: double(*place.right()),
        channels: 2,
    }
}
