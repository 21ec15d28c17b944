//! Coupling of contacts to vibrating bodies: the oscillators driven by each contact, those that contribute to its gap, and the residual
//! compliance.

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use super::bank::padded;
use super::plan::{Plan, Site};
use super::receptance::Push;
use crate::contact::Receptance;
use crate::near_field::Bands;

impl Plan {
    /// Couples the contacts to the body. They drive its oscillators; their gaps depend on these, or with friction on copies that are driven by
    /// the normal forces only.
    pub(super) fn couple_body(&mut self, felt: &[(Receptance, Push)]) {
        let rubs = |s: &Site| s.touch.contact.friction != Vec3::ZERO;
        let rubs = self.sites.iter().any(rubs);
        let coupled: Vec<Coupled<'_>> = (felt.iter().enumerate())
            .map(|(contact, (felt, push))| Coupled {
                contact,
                felt,
                drive: &push.drive,
                across: push.across,
                is_felt: !rubs,
                first: 0,
                waves: (self.sites[contact].near.as_ref())
                    .map(|near| (near.oscillators.clone(), near.bands.clone())),
            })
            .collect();
        self.own_compliance = self.couple(&coupled);
        self.compliance = match rubs {
            true => self.feel_without_friction(felt),
            false => self.own_compliance.clone(),
        };
    }

    /// Sets the contacts' forces on the oscillators of their bodies, and the contributions of these to the gaps. Returns the residual compliances,
    /// m/N, row-major.
    fn couple(&mut self, contacts: &[Coupled<'_>]) -> Vec<f64> {
        let count = self.sites.len();
        let mut compliance = vec![0.0; count * count];
        for one in contacts {
            let felt = one.felt;
            let (pushes, feels) = (&mut self.drive[one.contact], &mut self.gap[one.contact]);
            for i in 0..felt.followed {
                let at = one.first + i;
                pushes[at] = one.drive[i];
                if one.is_felt {
                    feels[at] = felt.shape[i] / self.oscillators[at].0;
                }
            }
            if let (Some(wall), Some((oscillators, bands))) = (&felt.wall, &one.waves) {
                for (i, band) in oscillators.clone().zip(&bands.oscillators) {
                    let xi = band.give.sqrt();
                    pushes[i] = xi * one.across;
                    if one.is_felt {
                        feels[i] = xi * wall.along_normal / self.oscillators[i].0;
                    }
                }
            }
            // The residual compliance holds energy even if it is not felt.
            let shape = if one.is_felt { &felt.shape } else { one.drive };
            for other in contacts.iter().filter(|other| other.first == one.first) {
                let entry = &mut compliance[one.contact * count + other.contact];
                *entry = felt.compliance(shape, other.drive);
            }
            if let (Some(wall), Some((_, bands))) = (&felt.wall, &one.waves) {
                let along = if one.is_felt {
                    wall.along_normal
                } else {
                    one.across
                };
                compliance[one.contact * count + one.contact] +=
                    along * one.across * bands.compliance();
            }
        }
        compliance
    }

    /// Adds the oscillators of breakable strikers, which contribute to the gaps of their contacts. Several contacts of a striker share its modes.
    pub(super) fn add_strikers(&mut self) {
        let strikers: Vec<(usize, Arc<Receptance>)> = (self.sites.iter().enumerate())
            .filter_map(|(k, site)| {
                let felt = site.touch.contact.striker.receptance.as_ref()?;
                site.script.is_none().then(|| (k, Arc::clone(felt)))
            })
            .collect();
        if strikers.is_empty() {
            return;
        }
        let before = self.fill_group();
        let mut coupled: Vec<Coupled<'_>> = Vec::with_capacity(strikers.len());
        for (k, felt) in &strikers {
            let (site, count) = (&self.sites[*k], self.sites.len());
            let body = |k: usize| self.sites[k].touch.contact.striker.shared.map(|s| s.body);
            let same = |c: &&Coupled<'_>| {
                body(*k).is_some() && body(c.contact) == body(*k) && c.felt.swings_with(felt)
            };
            let first = coupled.iter().find(same).map_or_else(
                || {
                    let first = self.oscillators.len();
                    self.oscillators.extend(felt.oscillators());
                    // A striker without followed modes needs a number of its own all the same.
                    if felt.followed == 0 {
                        self.oscillators.push((1.0, 0.0));
                    }
                    first
                },
                |known| known.first,
            );
            let mass = 1.0 / self.inverse_mass[k * count + k];
            let waves = felt.wall.as_ref().map(|wall| {
                let (bands, _) = wall.bands(site, mass);
                (add_waves(felt, &bands, &mut self.oscillators), bands)
            });
            coupled.push(Coupled::without_friction(*k, felt, first, waves));
        }
        self.widen();
        let given = self.couple(&coupled);
        for (sum, given) in self.compliance.iter_mut().zip(given) {
            *sum += given;
        }
        self.strikers = before..self.oscillators.len();
    }

    /// Adds copies of the body's oscillators that are driven by the normal forces only, and uses them for the gaps in place of those also driven
    /// by friction.
    ///
    /// Friction is proportional to the normal force and may move the contact point towards the striker; if this affected the gap, it could add
    /// energy without bound. Returns the residual compliances for the gaps, m/N, row-major.
    fn feel_without_friction(&mut self, felt: &[(Receptance, Push)]) -> Vec<f64> {
        let first = self.fill_group();
        self.felt_first = first;
        self.oscillators.extend_from_within(..self.own);
        let coupled: Vec<Coupled<'_>> = (felt.iter().enumerate())
            .map(|(contact, (felt, _))| {
                let near = self.sites[contact].near.as_ref();
                let waves = near.map(|near| {
                    let Range { start, end } = near.oscillators;
                    (first + start..first + end, near.bands.clone())
                });
                Coupled::without_friction(contact, felt, first, waves)
            })
            .collect();
        self.widen();
        self.couple(&coupled)
    }

    /// Pads the last group with oscillators that nothing pushes, and returns the number of oscillators.
    fn fill_group(&mut self) -> usize {
        let count = padded(self.oscillators.len());
        self.oscillators.resize(count, (1.0, 0.0));
        count
    }

    /// Makes room for all oscillators in each row.
    fn widen(&mut self) {
        let width = padded(self.oscillators.len());
        for row in self.drive.iter_mut().chain(&mut self.gap) {
            row.resize(width, 0.0);
        }
    }
}

/// A contact, and a body that vibrates under it.
struct Coupled<'a> {
    contact: usize,
    felt: &'a Receptance,
    /// Push of the contact on the body's modes, 1/√kg, and share of its force that acts across the wall.
    drive: &'a [f64],
    across: f64,
    /// True if these oscillators contribute to the gap of the contact.
    is_felt: bool,
    /// Number of the body's first mode among the oscillators: contacts with the same number drive the same modes.
    first: usize,
    /// The wall oscillators about the contact, and the bands that they stand for.
    waves: Option<(Range<usize>, Bands)>,
}

impl<'a> Coupled<'a> {
    /// Creates the coupling to a body that is driven by the contact's normal force only and contributes to its gap.
    fn without_friction(
        contact: usize,
        felt: &'a Receptance,
        first: usize,
        waves: Option<(Range<usize>, Bands)>,
    ) -> Self {
        Self {
            contact,
            felt,
            drive: &felt.shape,
            across: felt.wall.as_ref().map_or(0.0, |wall| wall.along_normal),
            is_felt: true,
            first,
            waves,
        }
    }
}

/// Appends the wall oscillators of a contact to the others, and returns their range.
pub(super) fn add_waves(
    felt: &Receptance,
    bands: &Bands,
    all: &mut Vec<(f64, f64)>,
) -> Range<usize> {
    let first = all.len();
    for band in &bands.oscillators {
        all.push((band.eigenvalue.sqrt(), felt.damping(band.eigenvalue)));
    }
    first..all.len()
}
