//! The sound-emitting objects of a scene, by numbers chosen by the caller.

use std::sync::Arc;

use frangible::internals::outcome::Clump;
use frangible::{Body, Material};
use frangible_recording::Pose;
use glam::Vec3;

/// Kind of sound source that a thing is.
#[derive(Clone, Debug)]
pub enum Sounding {
    /// A body, or a piece with its own modes.
    Modes(Body),
    /// A piece without its own modes: its material and its mass, kg.
    Piece(Material, f64),
    /// A projectile, as a ball: its material, radius, m, and mass, kg.
    Ball(Material, f64, f64),
    /// A clump of dice of tempered glass: its material, its mass, kg, and the dice. It does not ring, as nothing holds it together.
    Dice(Material, f64, Arc<Clump>),
}

impl Sounding {
    /// Returns its material.
    #[must_use]
    pub fn material(&self) -> &Material {
        match self {
            Self::Modes(body) => body.asset().material(),
            Self::Piece(material, _) | Self::Ball(material, ..) | Self::Dice(material, ..) => {
                material
            }
        }
    }

    /// Returns the mass, kg.
    #[must_use]
    pub fn mass(&self) -> f64 {
        match self {
            Self::Modes(body) => body.asset().mass().mass,
            Self::Piece(_, mass) | Self::Ball(_, _, mass) | Self::Dice(_, mass, _) => *mass,
        }
    }

    /// Returns the mass of what meets others one by one, kg: of a clump the mean of its dice, of all else the whole.
    #[must_use]
    pub fn grain_mass(&self) -> f64 {
        match self {
            Self::Dice(_, mass, clump) => mass / clump.count().max(1) as f64,
            _ => self.mass(),
        }
    }
}

/// The objects of a scene: of a finished run or of a live world.
pub trait Cast {
    /// Name of a thing.
    fn name(&self, node: usize) -> &str;
    /// The thing as a sound source.
    fn sounding(&self, node: usize) -> &Sounding;
    /// The corners of its surface in its own frame, m.
    fn vertices(&self, node: usize) -> &[Vec3];
    /// The triangles of its closed surface, as numbers of corners.
    fn triangles(&self, node: usize) -> Vec<[u32; 3]>;
    /// The [balls](Sounding::Ball) that are there at a time, s.
    fn balls(&self, time: f64) -> Vec<usize>;
    /// Pose of a thing at a time, s.
    fn pose(&self, node: usize, time: f64) -> Pose;
    /// Height of the floor, m, if there is one.
    fn floor(&self) -> Option<f32>;

    /// Distance of a point, m, in the frame of a thing, from the nearest corner of its surface.
    fn distance(&self, node: usize, point: Vec3) -> f32 {
        let vertices = self.vertices(node).iter();
        vertices
            .map(|v| v.distance_squared(point))
            .fold(f32::INFINITY, f32::min)
    }
}
