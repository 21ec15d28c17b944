//! The entities that sound, by numbers.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use bevy::prelude::*;
use frangible::{Asset as Baked, Body, Fracture, Material, glam};
use frangible_sound::{Cast, Hearing, Pose, Sounding};

use crate::Broken;
use crate::meshes::into;

/// Longest time for which a thing that is gone rings on, s. It is then forgotten.
const FADES: f64 = 0.1;

/// Something that can sound.
struct Thing {
    entity: Entity,
    name: String,
    sounding: Sounding,
    /// The break that it comes from, and which piece of it it is.
    piece: Option<(Arc<Fracture>, usize)>,
    /// Its baked body, if it can break.
    asset: Option<Arc<Baked>>,
    /// Time at which it disappeared, s.
    gone: Option<f64>,
}

/// All that can sound. Numbers are never given again.
#[derive(Default)]
pub(super) struct Troupe {
    things: BTreeMap<usize, Thing>,
    numbers: BTreeMap<Entity, usize>,
    next: usize,
    /// Bodies that nothing was prepared for yet.
    new: Vec<usize>,
}

impl Troupe {
    fn add(&mut self, entity: Entity, sounding: Sounding) -> &mut Thing {
        let node = self.next;
        self.next += 1;
        self.numbers.insert(entity, node);
        self.things.entry(node).or_insert(Thing {
            entity,
            name: entity.to_string(),
            sounding,
            piece: None,
            asset: None,
            gone: None,
        })
    }

    /// A body that is ready, or a piece that can break again, which sounds as it did.
    pub(super) fn appear(&mut self, entity: Entity, body: &Body) {
        let asset = Some(Arc::clone(body.asset()));
        let known = self.numbers.get(&entity);
        if let Some(thing) = known.and_then(|node| self.things.get_mut(node)) {
            thing.asset = asset;
            return;
        }
        self.add(entity, Sounding::Modes(body.clone())).asset = asset;
        self.new.push(self.next - 1);
    }

    /// The pieces of a body of a material.
    pub(super) fn born(&mut self, pieces: &[Entity], fracture: &Arc<Fracture>, of: &Material) {
        for (i, (&entity, fragment)) in pieces.iter().zip(&fracture.fragments).enumerate() {
            let mass = fragment.mass.mass;
            let sounding = match fracture.clump(i) {
                Some(clump) => Sounding::Dice(of.clone(), mass, Arc::clone(clump)),
                None => Sounding::Piece(of.clone(), mass),
            };
            self.add(entity, sounding).piece = Some((Arc::clone(fracture), i));
        }
    }

    /// A thing that strikes others: a ball of a material, a radius, m, and a mass, kg.
    pub(super) fn ball(&mut self, entity: Entity, material: &Material, size: [f64; 2]) {
        let [radius, mass] = size;
        self.add(entity, Sounding::Ball(material.clone(), radius, mass));
    }

    /// The number of an entity that sounds.
    pub(super) fn node(&self, entity: Entity) -> Option<usize> {
        self.numbers.get(&entity).copied()
    }

    /// The numbers of pieces that were born together.
    pub(super) fn pieces(&self, pieces: &[Entity]) -> Range<usize> {
        let first = pieces.first().and_then(|&piece| self.node(piece));
        first.map_or(0..0, |first| first..first + pieces.len())
    }

    /// Baked body of an entity that can break.
    pub(super) fn asset(&self, entity: Entity) -> Option<Arc<Baked>> {
        let thing = self.things.get(&self.node(entity)?)?;
        thing.asset.clone()
    }

    /// Bodies that came since this was last asked.
    pub(super) fn new_bodies(&mut self) -> Vec<usize> {
        let things = &self.things;
        let mut new = std::mem::take(&mut self.new);
        new.retain(|node| things.contains_key(node));
        new
    }

    /// Silences things that are gone, and forgets them a little later. A body that broke was silenced by its break.
    pub(super) fn leave(&mut self, hearing: &mut Hearing, there: &Query<Has<Broken>>, now: f64) {
        let numbers = &mut self.numbers;
        self.things.retain(|&node, thing| {
            let since = match (thing.gone, there.get(thing.entity)) {
                (Some(since), _) => since,
                (None, Ok(false)) => return true,
                (None, gone) => {
                    thing.gone = Some(now);
                    numbers.remove(&thing.entity);
                    if gone.is_err() {
                        // The time is finite.
                        let _ = hearing.hush(node, now);
                    }
                    now
                }
            };
            let stays = now - since < FADES;
            if !stays {
                hearing.forget(node);
            }
            stays
        });
    }
}

/// All that can sound, where it is now.
pub(super) struct Playing<'a, 'w, 's> {
    pub(super) troupe: &'a Troupe,
    pub(super) places: &'a TransformHelper<'w, 's>,
    pub(super) floor: Option<f32>,
}

impl Playing<'_, '_, '_> {
    /// Only numbers that the troupe has given are asked for, and those that happened in a step are there until it has been heard.
    fn thing(&self, node: usize) -> &Thing {
        &self.troupe.things[&node]
    }
}

impl Cast for Playing<'_, '_, '_> {
    fn name(&self, node: usize) -> &str {
        &self.thing(node).name
    }

    fn sounding(&self, node: usize) -> &Sounding {
        &self.thing(node).sounding
    }

    fn vertices(&self, node: usize) -> &[glam::Vec3] {
        let piece = self.thing(node).piece.as_ref();
        piece.map_or(&[], |(fracture, i)| &fracture.fragments[*i].mesh.positions)
    }

    fn triangles(&self, node: usize) -> Vec<[u32; 3]> {
        let piece = self.thing(node).piece.as_ref();
        piece.map_or_else(Vec::new, |(fracture, i)| {
            fracture.fragments[*i].mesh.triangles.clone()
        })
    }

    fn balls(&self, _time: f64) -> Vec<usize> {
        let things = self.troupe.things.iter();
        things
            .filter(|(_, thing)| matches!(thing.sounding, Sounding::Ball(..)))
            .filter(|(_, thing)| thing.gone.is_none())
            .map(|(&node, _)| node)
            .collect()
    }

    fn pose(&self, node: usize, _time: f64) -> Pose {
        let place = self
            .places
            .compute_global_transform(self.thing(node).entity);
        let (_, turn, at) = place.unwrap_or_default().to_scale_rotation_translation();
        Pose {
            translation: into(at),
            rotation: glam::Quat::from_array(turn.to_array()),
        }
    }

    fn floor(&self) -> Option<f32> {
        self.floor
    }
}
