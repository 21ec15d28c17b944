//! Impulses between bodies that met, from blows that were integrated.

use frangible::glam::{DVec3, Vec3};
use frangible::internals::DurationModel;
use frangible::internals::rigid::nearest_first;
use frangible::{Fracture, ImpactReport};
use rapier3d::dynamics::RigidBodyHandle;
use rapier3d::math::Pose;

use crate::contact::contacts::Impact;

/// One contact of a blow; world axes and places at the start of the step.
#[derive(Clone, Debug)]
pub(crate) struct Touch {
    /// Position of the contact, m.
    pub(crate) point: DVec3,
    /// Its position in the frame of the body that was asked, m.
    pub(crate) local: Vec3,
    /// Unit direction of the impulse on the body that was asked.
    pub(crate) normal: DVec3,
    /// The normal, and what friction there is beside it.
    pub(crate) direction: DVec3,
    /// Speed of approach before the step, m/s.
    pub(crate) approach: f64,
    /// The engine's normal impulse, N·s.
    pub(crate) engine: f64,
    /// The blow's, until the contact parted or the wall under it was gone, N·s.
    pub(crate) blow: f64,
}

/// All contacts of a body that was asked with one partner.
#[derive(Clone, Debug)]
pub(crate) struct Meeting {
    pub(crate) body: RigidBodyHandle,
    /// None for a collider without a body.
    pub(crate) partner: Option<RigidBodyHandle>,
    pub(crate) touches: Vec<Touch>,
    /// Weight of this answer: half where both bodies were asked.
    pub(crate) share: f64,
}

/// The meetings of an impact that was integrated; none of one that a bound refused, and none where impulses are given.
pub(crate) fn meetings(
    body: RigidBodyHandle,
    pose: &Pose,
    impact: &Impact,
    report: &ImpactReport,
    model: DurationModel,
) -> Vec<Meeting> {
    let mut meetings: Vec<Meeting> = Vec::new();
    if model != DurationModel::Integrated || report.contacts.len() != impact.contacts.len() {
        return meetings;
    }
    let contacts = impact.contacts.iter().zip(&impact.partners);
    for ((contact, &partner), answer) in contacts.zip(&report.contacts) {
        if !(answer.impulse.is_finite() && answer.impulse >= 0.0 && contact.impulse > 0.0) {
            continue;
        }
        let normal = (pose.rotation * contact.normal)
            .as_dvec3()
            .normalize_or_zero();
        let beside = (pose.rotation * (contact.friction / contact.impulse)).as_dvec3();
        let touch = Touch {
            point: (*pose * contact.point).as_dvec3(),
            local: contact.point,
            normal,
            direction: normal + beside,
            approach: f64::from(contact.approach_speed),
            engine: f64::from(contact.impulse),
            blow: answer.impulse,
        };
        match meetings.iter_mut().find(|m| m.partner == partner) {
            Some(meeting) => meeting.touches.push(touch),
            None => meetings.push(Meeting {
                body,
                partner,
                touches: vec![touch],
                share: 1.0,
            }),
        }
    }
    meetings
}

impl Meeting {
    /// The pieces from the nearest to the contacts.
    pub(crate) fn nearest(
        &self,
        fracture: &Fracture,
        fragments: &[RigidBodyHandle],
    ) -> Vec<RigidBodyHandle> {
        let points: Vec<Vec3> = self.touches.iter().map(|t| t.local).collect();
        let order = nearest_first(fracture, &points);
        let there = order.into_iter().filter_map(|i| fragments.get(i));
        there.copied().collect()
    }

    /// Returns true if the other meeting is of the same two bodies, asked the other way round.
    fn is_mirrored_by(&self, other: &Self) -> bool {
        other.partner == Some(self.body) && self.partner == Some(other.body)
    }
}

/// Two bodies that were both asked find one force, but for what else each of them meets and how it cracks: the mean of their answers
/// counts, in whichever order they are asked.
pub(crate) fn share_out(meetings: &mut [&mut Meeting]) {
    for k in 0..meetings.len() {
        if (0..meetings.len()).any(|l| meetings[k].is_mirrored_by(&*meetings[l])) {
            meetings[k].share = 0.5;
        }
    }
}
