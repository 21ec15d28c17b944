//! Pieces of one origin that rest, as one fixed body with one compound collider: its rubble.
//!
//! A merged piece stays in Rapier's sets under its handle, fixed and with its colliders disabled, so that its pose, its surface, its cracks and
//! its place in events are where they were; what it collides with is a part of the rubble. The world copies, orders and pairs one collider in
//! place of hundreds. Nothing is lost by merging, so a piece that comes loose (`loosen.rs`) is what it was.

use std::collections::{BTreeMap, BTreeSet};

use rapier3d::dynamics::{RigidBodyBuilder, RigidBodyHandle, RigidBodyType};
use rapier3d::geometry::{Aabb, Collider, ColliderHandle, SharedShape};
use rapier3d::math::Pose;

use crate::world::{BreakableWorld, Key, key};

/// A piece that lies in a rubble.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Merged {
    /// The piece, under the handle that it was born with.
    pub piece: RigidBodyHandle,
    /// The fixed body that it is a part of.
    pub rubble: RigidBodyHandle,
    /// Pose of the piece in the rubble's frame.
    pub pose: Pose,
}

/// The pieces of one origin that are merged.
#[derive(Clone, Debug)]
pub(crate) struct Rubble {
    pub(crate) body: RigidBodyHandle,
    pub(crate) collider: ColliderHandle,
    pieces: Vec<RigidBodyHandle>,
    /// For each part of the compound the piece that it belongs to.
    pub(crate) parts: Vec<RigidBodyHandle>,
}

/// Place of a merged piece.
#[derive(Clone, Copy, Debug)]
struct Place {
    /// Number of the body that it comes from, whose rubble it is a part of.
    origin: u64,
    /// Bounds of its colliders in the world, where it stays.
    bounds: Aabb,
}

/// All rubble of a world.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rubbles {
    /// Rubble of each body, by the number of the body.
    pub(crate) all: BTreeMap<u64, Rubble>,
    /// The place of each merged piece.
    places: BTreeMap<Key, Place>,
    /// Rubble whose compound no longer matches its pieces.
    stale: BTreeSet<u64>,
}

impl Rubbles {
    /// Number of merged pieces.
    pub(crate) fn len(&self) -> usize {
        self.places.len()
    }

    pub(crate) fn contains(&self, piece: RigidBodyHandle) -> bool {
        self.places.contains_key(&key(piece))
    }

    /// Bounds of a merged piece in the world.
    pub(super) fn bounds(&self, piece: RigidBodyHandle) -> Option<Aabb> {
        Some(self.places.get(&key(piece))?.bounds)
    }

    pub(super) fn pieces(&self) -> impl Iterator<Item = RigidBodyHandle> {
        let pieces = self.all.values().flat_map(|r| &r.pieces).copied();
        pieces.filter(|&piece| self.contains(piece))
    }

    /// Strikes a piece off the list, whose rubble keeps it until it is rebuilt; whether it was on it.
    pub(crate) fn strike_off(&mut self, piece: RigidBodyHandle) -> bool {
        let place = self.places.remove(&key(piece));
        self.stale.extend(place.map(|place| place.origin));
        place.is_some()
    }
}

impl BreakableWorld {
    /// Merged pieces ([`AtRest::Merge`](crate::AtRest::Merge)). Each stays in the world, fixed at its rest pose, with its colliders disabled;
    /// its part of the rubble collides instead. Drawing pieces by their handles needs no change; to draw a rubble as one mesh, combine the
    /// meshes of its pieces at these poses.
    pub fn merged(&self) -> impl Iterator<Item = Merged> {
        let bodies = &self.physics.bodies;
        let rubble = self.state.rubble.all.values();
        rubble.flat_map(move |rubble| {
            let frame = bodies.get(rubble.body).map(|b| b.position().inverse());
            let pieces = rubble.pieces.iter();
            let pieces = pieces.filter(|&&piece| self.state.rubble.contains(piece));
            pieces.filter_map(move |&piece| {
                Some(Merged {
                    piece,
                    rubble: rubble.body,
                    pose: frame? * *bodies.get(piece)?.position(),
                })
            })
        })
    }

    /// The rubble of a merged piece; `None` for a piece that is not merged.
    #[must_use]
    pub fn rubble_of(&self, piece: RigidBodyHandle) -> Option<RigidBodyHandle> {
        let place = self.state.rubble.places.get(&key(piece))?;
        Some(self.state.rubble.all.get(&place.origin)?.body)
    }

    /// The piece behind a part of a rubble's compound collider; `part` is the `subshape` of Rapier's contacts.
    #[must_use]
    pub fn piece_of_rubble(&self, rubble: RigidBodyHandle, part: u32) -> Option<RigidBodyHandle> {
        let mut all = self.state.rubble.all.values();
        let rubble = all.find(|known| known.body == rubble)?;
        rubble.parts.get(part as usize).copied()
    }

    /// Bodies that count: a merged piece does not.
    pub(crate) fn body_count(&self) -> usize {
        self.physics
            .bodies
            .len()
            .saturating_sub(self.state.rubble.len())
    }

    /// Puts pieces that rest into the rubble of their origins. What hangs on a joint, or has a collider that is no part of a compound,
    /// goes on sleeping.
    pub(crate) fn merge(&mut self, pieces: &[RigidBodyHandle]) {
        for &piece in pieces {
            let Some(origin) = self.siblings.origin(piece) else {
                continue;
            };
            let skin = self.skin_to_merge(piece).cloned();
            let body = self.physics.bodies.get(piece);
            let (Some(skin), Some(bounds)) = (skin, body.and_then(|body| self.bounds(body))) else {
                continue;
            };
            let known = self.state.rubble.all.contains_key(&origin);
            if !known && !self.begin_rubble(origin, piece, skin) {
                continue;
            }
            let rubble = &mut self.state.rubble;
            if let Some(own) = rubble.all.get_mut(&origin) {
                own.pieces.push(piece);
                rubble.places.insert(key(piece), Place { origin, bounds });
                rubble.stale.insert(origin);
            }
            self.set_collides(piece, false);
        }
        self.rebuild_rubble();
    }

    /// Returns true if a piece can be a part of a rubble.
    pub(super) fn can_merge(&self, piece: RigidBodyHandle) -> bool {
        self.siblings.origin(piece).is_some() && self.skin_to_merge(piece).is_some()
    }

    /// The first collider of a piece that can be merged.
    fn skin_to_merge(&self, piece: RigidBodyHandle) -> Option<&Collider> {
        let body = self.physics.bodies.get(piece)?;
        let hangs = (self.physics.impulse_joints.attached_joints(piece))
            .next()
            .is_some()
            || (self.physics.multibody_joints.rigid_body_link(piece)).is_some();
        let colliders = body.colliders().iter();
        let mut colliders = colliders.map(|&c| self.physics.colliders.get(c));
        let fits = |c: &Option<&Collider>| {
            c.is_some_and(|c| {
                let plain = c.is_enabled() && !c.is_sensor();
                plain && (c.shape().as_compound().is_some() || c.shape().is_convex())
            })
        };
        let first = colliders.next().filter(fits).flatten()?;
        (!hangs && colliders.all(|c| fits(&c))).then_some(first)
    }

    /// A fixed body without parts yet, where a piece is, that rubs and collides as that piece.
    fn begin_rubble(&mut self, origin: u64, piece: RigidBodyHandle, skin: Collider) -> bool {
        let Some(body) = self.physics.bodies.get(piece) else {
            return false;
        };
        let rubble = RigidBodyBuilder::fixed()
            .translation(body.translation())
            .dominance_group(body.dominance_group())
            .user_data(body.user_data);
        let surface = self.state.surfaces.get(&key(piece)).copied();
        let body = self.physics.bodies.insert(rubble);
        let mut skin = skin;
        skin.set_position_wrt_parent(Pose::IDENTITY);
        let collider = self.physics.insert_collider(skin, Some(body));
        if let Some(surface) = surface {
            self.state.surfaces.insert(key(body), surface);
        }
        self.siblings.lies(body, origin);
        let rubble = Rubble {
            body,
            collider,
            pieces: Vec::new(),
            parts: Vec::new(),
        };
        self.state.rubble.all.insert(origin, rubble);
        true
    }

    /// A piece is fixed and does not collide, or it is a body like any other.
    pub(crate) fn set_collides(&mut self, piece: RigidBodyHandle, collides: bool) {
        let Some(body) = self.physics.bodies.get_mut(piece) else {
            return;
        };
        if !collides {
            body.set_body_type(RigidBodyType::Fixed, false);
        } else if body.is_fixed() {
            // Somebody may have made it kinematic to carry it away.
            body.set_body_type(RigidBodyType::Dynamic, true);
        }
        for &collider in body.colliders() {
            if let Some(collider) = self.physics.colliders.get_mut(collider) {
                collider.set_enabled(collides);
            }
        }
    }

    /// Makes the compounds what their pieces are. Rubble without pieces goes.
    pub(crate) fn rebuild_rubble(&mut self) {
        for origin in std::mem::take(&mut self.state.rubble.stale) {
            let Rubbles { all, places, .. } = &mut self.state.rubble;
            let Some(rubble) = all.get_mut(&origin) else {
                continue;
            };
            let lies = |piece| places.get(&key(piece)).is_some_and(|p| p.origin == origin);
            rubble.pieces.retain(|&piece| lies(piece));
            let body = rubble.body;
            let (shapes, parts) = self.parts_of(origin);
            if shapes.is_empty() {
                self.state.rubble.all.remove(&origin);
                self.state.surfaces.remove(&key(body));
                self.physics.remove_body(body);
                continue;
            }
            if let Some(rubble) = self.state.rubble.all.get_mut(&origin) {
                rubble.parts = parts;
                if let Some(collider) = self.physics.colliders.get_mut(rubble.collider) {
                    collider.set_shape(SharedShape::compound(shapes));
                }
            }
        }
    }

    /// The convex parts of a rubble in its frame, and the piece of each.
    fn parts_of(&self, origin: u64) -> (Vec<(Pose, SharedShape)>, Vec<RigidBodyHandle>) {
        let (mut shapes, mut parts) = (Vec::new(), Vec::new());
        let Some(rubble) = self.state.rubble.all.get(&origin) else {
            return (shapes, parts);
        };
        let bodies = &self.physics.bodies;
        let frame = bodies.get(rubble.body).map(|b| b.position().inverse());
        let frame = frame.unwrap_or(Pose::IDENTITY);
        for &piece in &rubble.pieces {
            let Some(body) = bodies.get(piece) else {
                continue;
            };
            let colliders = body.colliders().iter();
            for collider in colliders.filter_map(|&c| self.physics.colliders.get(c)) {
                let local = collider.position_wrt_parent().copied().unwrap_or_default();
                let place = frame * *body.position() * local;
                match collider.shape().as_compound() {
                    // A compound in another one is none that Parry knows.
                    Some(compound) => {
                        let own = compound.shapes().iter();
                        shapes.extend(own.map(|(at, shape)| (place * *at, shape.clone())));
                    }
                    None => shapes.push((place, collider.shared_shape().clone())),
                }
            }
            parts.resize(shapes.len(), piece);
        }
        (shapes, parts)
    }

    /// Pieces of a rubble that is no longer there go with it; those that are no longer there are no part of it, and those that
    /// somebody has let move come loose.
    pub(crate) fn keep_rubble_true(&mut self) {
        let bodies = &self.physics.bodies;
        let rubble = &self.state.rubble;
        let there = |r: &Rubble| {
            bodies.contains(r.body) && self.physics.colliders.get(r.collider).is_some()
        };
        let gone = rubble.all.iter().filter(|(_, r)| !there(r));
        let gone: Vec<u64> = gone.map(|(&origin, _)| origin).collect();
        for origin in gone {
            let Some(rubble) = self.state.rubble.all.remove(&origin) else {
                continue;
            };
            for piece in rubble.pieces {
                self.state.rubble.places.remove(&key(piece));
                self.physics.remove_body(piece);
            }
            self.physics.remove_body(rubble.body);
        }
        let bodies = &self.physics.bodies;
        let moved = |&piece: &RigidBodyHandle| bodies.get(piece).is_none_or(|b| !b.is_fixed());
        let moved: Vec<RigidBodyHandle> = self.state.rubble.pieces().filter(moved).collect();
        self.loosen_with_load(moved);
        self.rebuild_rubble();
    }
}
