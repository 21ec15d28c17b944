//! Motion of fragments as they part: each with the group of nodes that it was part of while the blow was followed.

use glam::{DMat3, DVec3};

use super::Fragment;
use crate::blow::Apart;

impl Apart {
    /// Gives fragments, whose centres are in the frame of the fracture mesh, the motion of their groups. `labels`: that of each fragment's nodes;
    /// `label_of_node` and the nodes' `volumes` tell which group a fragment is part of. Momentum and angular momentum of them all are zero where
    /// nothing is held.
    pub(crate) fn give_to(
        &self,
        fragments: &mut [Fragment],
        labels: impl Iterator<Item = u32>,
        label_of_node: &[u32],
        volumes: &[u64],
    ) {
        let groups = self.motions.len() + 1;
        let mut shares = vec![0_u64; fragments.len() * groups];
        for ((&label, &group), volume) in label_of_node.iter().zip(&self.of_node).zip(volumes) {
            if let Some(share) = shares.get_mut(label as usize * groups + group as usize) {
                *share += volume;
            }
        }
        let mut reference = Vec::new();
        let (mut momentum, mut spin) = (DVec3::ZERO, DVec3::ZERO);
        for (number, label) in labels.enumerate() {
            let own = &shares[label as usize * groups..][..groups];
            let largest = (0..groups).reduce(|a, b| if own[b] > own[a] { b } else { a });
            let fragment = &mut fragments[number];
            let Some(motion) = largest.unwrap_or(0).checked_sub(1) else {
                reference.push(number);
                continue;
            };
            let (motion, mass) = (&self.motions[motion], &fragment.mass);
            fragment.velocity = motion.velocity + motion.angular.cross(mass.centre - motion.centre);
            fragment.angular_velocity = motion.angular;
            momentum += mass.mass * fragment.velocity;
            spin +=
                mass.inertia * motion.angular + mass.centre.cross(mass.mass * fragment.velocity);
        }
        if self.held {
            return;
        }
        // What is left takes the opposite momentum.
        let members = || reference.iter().map(|&number| &fragments[number].mass);
        let mass: f64 = members().map(|m| m.mass).sum();
        let centre = members().map(|m| m.mass * m.centre).sum::<DVec3>() / mass;
        let mut inertia = DMat3::ZERO;
        for m in members() {
            let d = m.centre - centre;
            let outer = DMat3::from_cols(d * d.x, d * d.y, d * d.z);
            let steiner = DMat3::from_diagonal(DVec3::splat(d.length_squared())) - outer;
            inertia += m.inertia + steiner * m.mass;
        }
        let velocity = -momentum / mass;
        let angular = inertia.inverse() * (centre.cross(momentum) - spin);
        if !(velocity.is_finite() && angular.is_finite()) {
            fragments.iter_mut().for_each(|f| {
                (f.velocity, f.angular_velocity) = (DVec3::ZERO, DVec3::ZERO);
            });
            return;
        }
        for number in reference {
            let fragment = &mut fragments[number];
            fragment.velocity = velocity + angular.cross(fragment.mass.centre - centre);
            fragment.angular_velocity = angular;
        }
    }
}
