//! The impact to compare methods on.

use frangible::glam::{DVec3, Vec3};
use frangible::{Body, Contact, FractureConfig};

use super::error::CompareError;

/// A whole body and its contacts.
#[derive(Clone, Copy, Debug)]
pub struct Hit<'a> {
    /// The body before the impact. [`Method::Ours`](super::Method::Ours) and [`Method::QuasiStatic`](super::Method::QuasiStatic) take existing cracks
    /// into account; the other methods treat it as intact.
    pub body: &'a Body,
    /// Its contacts, body frame.
    pub contacts: &'a [Contact],
    /// Settings of the fracture model.
    pub config: &'a FractureConfig,
}

impl Hit<'_> {
    pub(crate) fn check(&self) -> Result<(), CompareError> {
        let asset = self.body.asset();
        if asset.portion().is_some() {
            return Err(CompareError::Piece(asset.name().to_owned()));
        }
        self.contacts.iter().try_for_each(Contact::validate)?;
        match self.contacts.iter().any(|contact| contact.impulse > 0.0) {
            true => Ok(()),
            false => Err(CompareError::NoImpulse),
        }
    }

    /// Mean of the contact points, weighted by their impulses, m.
    pub(crate) fn point(&self) -> DVec3 {
        let impulses = self.contacts.iter();
        let (sum, weight) = impulses.fold((Vec3::ZERO, 0.0_f32), |(sum, weight), contact| {
            let impulse = contact.impulse;
            (sum + contact.point * impulse, weight + impulse)
        });
        (sum / weight).as_dvec3()
    }
}
