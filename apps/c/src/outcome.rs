//! Outcomes of blows: reports, fragments as flat arrays, their motions, and pieces that break again.
#![expect(unsafe_code, reason = "exported functions take pointers")]

use std::sync::Arc;

use frangible::glam::{DMat3, DQuat, DVec3};
use frangible::internals::outcome::ContactReport;
use frangible::{Asset, Body, Fracture, Fragment, Outcome};
use frangible_js::plain::{self, MOTION};

use crate::arrays::{Arrays, Whose, solid};
use crate::blow::{inertia, motion, pose};
use crate::body::added;
use crate::entry::{Failure, entry, frangible_status};
use crate::memory::{Form, Place, read, read_plain};
use crate::registry::Registry;
use crate::types::{
    frangible_body, frangible_contact_report, frangible_geometry, frangible_hulls,
    frangible_motion, frangible_outcome, frangible_pose, frangible_report, frangible_solid,
    frangible_striker,
};

/// Outcome of a blow. Without fragments the body held.
pub(crate) struct Came {
    asset: Arc<Asset>,
    /// The body, if it broke.
    body: Option<Body>,
    margin: f64,
    fracture: Fracture,
    /// Flat arrays of each fragment, filled on request.
    arrays: Vec<Arrays>,
}

pub(crate) static OUTCOMES: Registry<Came> = Registry::new("an outcome");

impl Came {
    /// Takes an outcome, and gives the body the cracks of a blow that it held.
    pub(crate) fn new(body: &mut Body, outcome: Outcome) -> Result<Self, Failure> {
        match outcome {
            Outcome::Held {
                margin,
                report,
                state,
            } => {
                if let Some(state) = state {
                    body.set_state(*state).map_err(Failure::input)?;
                }
                Ok(Self {
                    asset: Arc::clone(body.asset()),
                    body: None,
                    margin,
                    fracture: Fracture::new(Vec::new(), report),
                    arrays: Vec::new(),
                })
            }
            Outcome::Broke(fracture) => Ok(Self {
                asset: Arc::clone(body.asset()),
                body: Some(body.clone()),
                margin: 0.0,
                arrays: fracture
                    .fragments
                    .iter()
                    .map(|_| Arrays::default())
                    .collect(),
                fracture: *fracture,
            }),
            _ => Err(Failure(
                frangible_status::Internal,
                "an outcome of a sort that this library does not know; please report it".into(),
            )),
        }
    }

    fn fragment(&self, index: usize) -> Result<(&Fragment, &Arrays), Failure> {
        let all = self
            .fracture
            .fragments
            .get(index)
            .zip(self.arrays.get(index));
        all.ok_or_else(|| self.missing("fragment", index, self.arrays.len()))
    }

    fn missing(&self, what: &str, index: usize, count: usize) -> Failure {
        Failure::range(format!(
            "there is no {what} {index}; the outcome has {count}"
        ))
    }
}

/// Frees an outcome, and the arrays that it gave. A handle of zero is left alone.
#[unsafe(no_mangle)]
pub extern "C" fn frangible_outcome_free(outcome: frangible_outcome) -> frangible_status {
    entry(|| OUTCOMES.free(outcome.id))
}

/// Tells whether the body broke, into how many fragments, and the numbers of the blow.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_outcome_report(
    outcome: frangible_outcome,
    out: *mut frangible_report,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let came = OUTCOMES.get(outcome.id)?;
        let report = &came.fracture.report;
        let pushes = report.contacts.iter();
        let impulse: DVec3 = pushes.map(|c| c.normal.as_dvec3() * c.impulse).sum();
        out.fill(&frangible_report {
            broke: came.body.is_some().into(),
            fragments: came.fracture.fragments.len(),
            contacts: report.contacts.len(),
            cracks: report.cracks,
            margin: came.margin,
            contact_duration: report.contact_duration,
            peak_stress: report.peak_stress,
            stress_bound: report.stress_bound,
            strength: report.strength,
            approach_energy: report.approach_energy,
            fracture_energy: report.fracture_energy,
            impulse: impulse.to_array(),
            crack_area: report.crack_area,
            first_crack_time: report.first_crack_time.unwrap_or(f64::NAN),
            seconds: report.timings.total(),
            ..Default::default()
        });
        Ok(())
    })
}

/// Tells what came of the blow at one contact.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_outcome_contact(
    outcome: frangible_outcome,
    index: usize,
    out: *mut frangible_contact_report,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let came = OUTCOMES.get(outcome.id)?;
        let all = &came.fracture.report.contacts;
        let report = all.get(index);
        let report = report.ok_or_else(|| came.missing("contact", index, all.len()))?;
        out.fill(&contact(report));
        Ok(())
    })
}

fn contact(report: &ContactReport) -> frangible_contact_report {
    frangible_contact_report {
        point: report.point.as_dvec3().to_array(),
        normal: report.normal.as_dvec3().to_array(),
        impulse: report.impulse,
        peak_force: report.peak_force,
        duration: report.duration,
        departure_speed: report.departure_speed,
        crushing_energy: report.crushing_energy,
        crushed_volume: report.crushed_volume,
        ..Default::default()
    }
}

/// Gives the masses of a fragment.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_outcome_solid(
    outcome: frangible_outcome,
    fragment: usize,
    out: *mut frangible_solid,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let came = OUTCOMES.get(outcome.id)?;
        let (fragment, _) = came.fragment(fragment)?;
        out.fill(&solid(&fragment.mass, fragment.supported));
        Ok(())
    })
}

/// Gives the mesh of a fragment, to draw, in the frame of the fragment: its origin is its centre of mass, its axes are those of the body that broke.
/// Cracks within it are drawn from both sides.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_outcome_geometry(
    outcome: frangible_outcome,
    fragment: usize,
    out: *mut frangible_geometry,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let came = OUTCOMES.get(outcome.id)?;
        let (fragment, arrays) = came.fragment(fragment)?;
        out.fill(&arrays.geometry(Whose::Fragment(&came.asset, fragment)));
        Ok(())
    })
}

/// Gives the closed surface of a fragment, in the frame of the fragment: no vertex is doubled, and there are no normals and texture coordinates.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_outcome_surface(
    outcome: frangible_outcome,
    fragment: usize,
    out: *mut frangible_geometry,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let came = OUTCOMES.get(outcome.id)?;
        let (fragment, arrays) = came.fragment(fragment)?;
        out.fill(&arrays.surface(fragment));
        Ok(())
    })
}

/// Gives the convex parts of a fragment, for colliders, in the frame of the fragment.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_outcome_hulls(
    outcome: frangible_outcome,
    fragment: usize,
    out: *mut frangible_hulls,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Form::new(out, "out") }?;
        let came = OUTCOMES.get(outcome.id)?;
        let (fragment, arrays) = came.fragment(fragment)?;
        out.fill(&arrays.hulls(Whose::Fragment(&came.asset, fragment)));
        Ok(())
    })
}

/// Makes a fragment a body that can break again, in its own frame, with its share of the weak points and cracks, and with vibration modes of its
/// own. Computing the modes takes some tenths of a second: call it from another thread than that of the frames. Fails with
/// FRANGIBLE_STATUS_TOO_SMALL if the fragment is too small for that. Free it with `frangible_body_free`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_outcome_piece(
    outcome: frangible_outcome,
    fragment: usize,
    out: *mut frangible_body,
) -> frangible_status {
    entry(|| {
        // SAFETY: by the contract of the crate.
        let out = unsafe { Place::new(out, "out") }?;
        let came = OUTCOMES.get(outcome.id)?;
        came.fragment(fragment)?;
        let unknown = || came.missing("fragment", fragment, came.arrays.len());
        let body = came.body.as_ref().ok_or_else(unknown)?;
        let piece = frangible_js_bake::piece(body, &came.fracture, fragment);
        let piece = piece.map_err(|e| Failure::of(frangible_status::TooSmall)(&e))?;
        out.write(added(piece.ok_or_else(unknown)?));
        Ok(())
    })
}

/// Computes where the fragments are and how they move after the break, and how the striker does. A ball has flown through the fragments in its way.
/// Momentum and angular momentum are conserved, and energy does not increase. `pose` and `body` are the pose and the motion of the body just **before**
/// the blow, without any response of the engine. `striker` is the one that came, in world axes with its motion before the blow; null, or fixed, if it
/// does not give way. `poses` and `motions` have room for `count` fragments, which is their number; `poses` and `striker_after` may be null.
///
/// If the body **held** the blow, `count` is 1, and the row is that of the body. Leave the contact out of the engine's step then. A blow whose report
/// has no contacts was refused by a bound, and changes nothing here: leave it to the engine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn frangible_outcome_motions(
    outcome: frangible_outcome,
    pose: *const frangible_pose,
    body: *const frangible_motion,
    striker: *const frangible_striker,
    poses: *mut frangible_pose,
    motions: *mut frangible_motion,
    count: usize,
    striker_after: *mut frangible_motion,
) -> frangible_status {
    entry(|| {
        let came = OUTCOMES.get(outcome.id)?;
        let fragments = &came.fracture.fragments;
        let held = fragments.is_empty();
        if count != fragments.len().max(1) {
            return Err(Failure::range(match held {
                true => format!("`count` is {count}, and the body held: give 1, for the body"),
                false => format!(
                    "`count` is {count}, and the outcome has {} fragments",
                    fragments.len()
                ),
            }));
        }
        // SAFETY: by the contract of the crate.
        let pose = unsafe { read_plain(pose, "pose") }?;
        // SAFETY: by the contract of the crate.
        let body = unsafe { read_plain(body, "body") }?;
        // SAFETY: by the contract of the crate.
        let motions = unsafe { Place::of(motions, count, "motions") }?;
        // SAFETY: by the contract of the crate.
        let poses = unsafe { Place::optional(poses, count, "poses") }?;
        // SAFETY: by the contract of the crate.
        let striker_after = unsafe { Place::optional(striker_after, 1, "striker_after") }?;
        let (at, turn) = self::pose(&pose)?;
        let [linear, angular] = motion(&body, "body")?;
        let striker = if striker.is_null() {
            None
        } else {
            // SAFETY: by the contract of the crate.
            row(&unsafe { read(striker, "striker") }?)?
        };
        let mut place = at.to_array().to_vec();
        place.extend(turn.to_array());
        let before = [linear.to_array(), angular.to_array()].concat();
        let by = striker.as_deref().unwrap_or(&[]);
        let rows = match held {
            true => plain::motions_held(&came.asset, &came.fracture.report, &place, &before, by),
            false => plain::motions(&came.asset, &came.fracture, &place, &before, by),
        };
        let (rows, _) = rows.as_chunks::<MOTION>();
        let after: Vec<frangible_motion> = rows.iter().map(of_row).collect();
        if let Some(poses) = poses {
            let mut all: Vec<frangible_pose> = (fragments.iter())
                .map(|f| placed(at, turn, f.mass.centre))
                .collect();
            if held {
                all.push(placed(at, turn, DVec3::ZERO));
            }
            poses.write_all(&all);
        }
        if let Some(place) = striker_after {
            place.write(after.get(count).copied().unwrap_or_default());
        }
        motions.write_all(&after[..count]);
        Ok(())
    })
}

fn placed(at: DVec3, turn: DQuat, centre: DVec3) -> frangible_pose {
    frangible_pose {
        position: (at + turn * centre).to_array(),
        rotation: turn.to_array(),
    }
}

fn of_row(row: &[f64; MOTION]) -> frangible_motion {
    let &[x, y, z, u, v, w] = row;
    frangible_motion {
        linear: [x, y, z],
        angular: [u, v, w],
    }
}

/// Numbers of a striker that gives way, as [`plain::motions`] takes them.
fn row(by: &frangible_striker) -> Result<Option<Vec<f64>>, Failure> {
    let Some((mass, centre, _)) = crate::blow::solid(by)? else {
        return Ok(None);
    };
    let inertia: DMat3 = inertia(by)?;
    let [linear, angular] = motion(&by.motion, "striker.motion")?;
    let mut row = vec![mass];
    row.extend(centre.to_array());
    row.extend(inertia.to_cols_array());
    row.extend(linear.to_array());
    row.extend(angular.to_array());
    Ok(Some(row))
}
