//! What the stress bounds pass over holds no crack, so results with and without them are the same bits.

mod common;

use common::{block, blow, glass, pane, rim_hit, steel_ball, stone_floor};
use frangible::glam::Vec3;
use frangible::{
    Asset, Breakable, Contact, Force, FractureConfig, LookedAt, Outcome, impact, rest, would_break,
};
use std::sync::Arc;

/// Numbers in 0..1 (a linear congruential generator).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A blow on a random place of the surface, from outside, up to 20 m/s, most of them soft.
    fn blow(&mut self, asset: &Asset) -> Contact {
        let triangle = (self.next() * asset.surface.triangles.len() as f64) as usize;
        let corners =
            asset.surface.triangles[triangle].map(|v| asset.fracture.positions[v as usize]);
        let inward = -asset.surface.normals[triangle][0];
        let tilt = Vec3::from_array(std::array::from_fn(|_| self.next() as f32 - 0.5));
        let speed = 20.0 * self.next().powi(6);
        let striker = if self.next() < 0.5 {
            steel_ball(0.02 + 0.2 * self.next())
        } else {
            stone_floor()
        };
        blow(asset, corners[0], inward + tilt, speed, striker)
    }
}

fn cracks_and_pieces(outcome: &Outcome) -> Vec<u64> {
    let report = outcome.report();
    let mut bits = vec![
        report.cracks as u64,
        report.crack_area.to_bits(),
        report.fracture_energy.to_bits(),
        report.first_crack_time.unwrap_or(-1.0).to_bits(),
    ];
    if let Outcome::Broke(fracture) = outcome {
        for fragment in &fracture.fragments {
            bits.push(fragment.mass.mass.to_bits());
            bits.extend(
                fragment
                    .mesh
                    .positions
                    .iter()
                    .flat_map(|p| p.to_array().map(|x| u64::from(x.to_bits()))),
            );
        }
    }
    bits
}

fn models() -> [FractureConfig; 2] {
    [FractureConfig::default(), FractureConfig::as_in_the_paper()]
}

#[test]
fn culling_changes_no_bit_of_what_breaks() {
    let mut numbers = Numbers(1);
    let mut looked = [0; 3];
    let mut ratios = [const { Vec::new() }; 3];
    for (name, asset) in [("glass", glass()), ("pane", pane()), ("block", block())] {
        let kind = Breakable::new(Arc::clone(asset)).unwrap();
        let mut broke = 0;
        for k in 0..16 {
            let body = kind.body(k);
            let contacts: Vec<Contact> = (0..1 + k % 3).map(|_| numbers.blow(asset)).collect();
            for config in models() {
                let mut without = config.clone();
                without.culling = false;
                let fast = impact(&body, &contacts, &config).unwrap();
                let slow = impact(&body, &contacts, &without).unwrap();
                assert!(
                    cracks_and_pieces(&fast) == cracks_and_pieces(&slow),
                    "{name}, blow {k}: {:?} against {:?}",
                    fast.report(),
                    slow.report()
                );
                assert!(
                    fast.report().stress_bound >= slow.report().peak_stress * (1.0 - 1e-6),
                    "{name}, blow {k}: the bound {} is below the stress {}",
                    fast.report().stress_bound,
                    slow.report().peak_stress
                );
                let breaks = matches!(slow, Outcome::Broke(_));
                assert_eq!(would_break(&body, &contacts, &config).unwrap(), breaks);
                if let Outcome::Held { margin, .. } = fast {
                    let within = slow.report().peak_stress <= slow.report().strength;
                    assert_eq!(margin >= 1.0, within, "{name}, blow {k}: {margin}");
                }
                let level = fast.report().looked_at as usize;
                looked[level] += 1;
                if slow.report().peak_stress > 0.0 {
                    ratios[level].push(fast.report().stress_bound / slow.report().peak_stress);
                }
                broke += usize::from(breaks);
            }
        }
        println!("{name}: {broke} of 32 broke");
        assert!(broke > 2, "{name}");
    }
    for (what, ratios) in ["free of time", "by time steps"].iter().zip(&mut ratios) {
        ratios.sort_by(f64::total_cmp);
        let at = |share: f64| ratios[(share * (ratios.len() - 1) as f64) as usize];
        println!(
            "bound over stress, {what}: {:.2}, {:.2}, {:.2}",
            at(0.0),
            at(0.5),
            at(1.0)
        );
    }
    println!("refused free of time, by time steps, looked at: {looked:?}");
    assert!(looked.iter().all(|&n| n > 3), "{looked:?}");
}

#[test]
fn a_refused_contact_allocates_nothing() {
    let body = Breakable::new(Arc::clone(glass())).unwrap().body(1);
    let config = FractureConfig::default();
    let soft = rim_hit(0.0, 0.001);
    let contacts = [
        soft,
        Contact {
            friction: Vec3::Y * 1e-5,
            ..soft
        },
    ];
    let force = Force {
        point: soft.point,
        force: Vec3::NEG_X,
    };
    let refused = |outcome: Outcome| {
        matches!(outcome, Outcome::Held { margin, report, .. }
            if margin > 1.0 && report.looked_at == LookedAt::Impulses)
    };
    let mut all = true;
    let counted = allocation_counter::measure(|| {
        all &= refused(impact(&body, &contacts, &config).unwrap());
        all &= !would_break(&body, &contacts, &config).unwrap();
        all &= refused(rest(&body, &[force], Vec3::NEG_Z, &config).unwrap());
    });
    assert!(all);
    assert_eq!(counted.count_total, 0, "{counted:?}");
}
