use super::*;
use crate::crack::surface::CrackFrame;
use crate::rng::{Purpose, stream, uniform};
use crate::stress::{bent, share_beside};

const EDGE: f32 = 1e-3;
const WAVE: f64 = 3000.0;

/// Cracks made by hand.
#[derive(Default)]
struct Cracks {
    cracks: Vec<Crack>,
    extents: Vec<Extent>,
    growth: Vec<u32>,
}

impl Cracks {
    fn start(&mut self, at: Vec3) -> u32 {
        self.cracks
            .push(Crack::new(CrackFrame::new(at, Vec3::Y, 0.0, 1.0, 1, 0), 0));
        self.extents.push(Extent::new(at));
        self.cracks.len() as u32 - 1
    }

    fn grow(&mut self, crack: u32, position: Vec3, direction: Vec3, time: f64) {
        let extent = &mut self.extents[crack as usize];
        extent.grow(position);
        extent.latest_growth = self.growth.len() as u32;
        self.growth.push(crack);
        self.cracks[crack as usize].sites.push(Site {
            position,
            direction,
            time,
        });
    }

    fn sources(&self) -> Sources<'_> {
        Sources {
            cracks: &self.cracks,
            extents: &self.extents,
            growth: &self.growth,
            edge: EDGE,
            wave: WAVE,
        }
    }
}

/// A straight crack along x of this half-length, m, cut at once at t = 0.
fn straight(half_length: f32) -> Cracks {
    let mut cracks = Cracks::default();
    let crack = cracks.start(Vec3::ZERO);
    let steps = (half_length / EDGE).round() as i32;
    for k in -steps..=steps {
        cracks.grow(crack, Vec3::X * (k as f32 * EDGE), Vec3::Y, 0.0);
    }
    cracks
}

#[test]
fn beside_a_straight_crack_the_closed_form_is_left_once_the_wave_is_there() {
    let half_length = 0.01;
    let cracks = straight(half_length);
    let beta = bent(0.23);
    for y in [0.0025_f32, 0.005, 0.01, 0.02, 0.05] {
        let mut memory = Memory::new(Vec3::Y * y, beta);
        let arrival = f64::from(y) / WAVE;
        assert!(!memory.update(cracks.sources(), 0.999 * arrival) && !memory.dark);
        assert!(memory.update(cracks.sources(), 1.001 * arrival) && memory.dark);
        let [shadow] = memory.shadows().collect::<Vec<_>>()[..] else {
            panic!("one crack casts one shadow");
        };
        // One of the sites lies exactly beside the point.
        let shares = [(shadow.bent, beta), (shadow.stretched, STRETCHED)];
        for (ours, beta) in shares {
            let theirs = share_beside(y, half_length, beta);
            assert!((ours - theirs).abs() < 1e-4, "{y} {ours} {theirs}");
        }
        assert_eq!(shadow.normal, Vec3::Y);
        // Again: nothing new.
        assert!(!memory.update(cracks.sources(), 1.0));
    }
}

#[test]
fn ahead_of_a_cracks_tips_nothing_is_taken() {
    let cracks = straight(0.01);
    for x in [0.0111, 0.012, 0.015, 0.05, -0.02] {
        let mut memory = Memory::new(Vec3::X * x, bent(0.23));
        assert!(!memory.update(cracks.sources(), 1.0) && !memory.dark, "{x}");
    }
}

#[test]
fn a_point_between_two_places_of_a_crack_is_beside_it() {
    let cracks = straight(0.01);
    for x in [0.0, 0.3, 0.5] {
        let mut memory = Memory::new(Vec3::new(x, 0.1, 0.0) * EDGE, bent(0.23));
        assert!(memory.update(cracks.sources(), 1.0));
        assert!(memory.shadows().all(|shadow| shadow.bent < 0.02), "{x}");
    }
}

#[test]
fn a_longer_crack_leaves_less_without_a_place_nearer_by() {
    let mut cracks = straight(0.002);
    let mut memory = Memory::new(Vec3::Y * 0.005, bent(0.23));
    assert!(memory.update(cracks.sources(), 1.0));
    let mut before = memory.shadows().next().unwrap().bent;
    for k in 3..9 {
        cracks.grow(0, Vec3::X * (k as f32 * EDGE), Vec3::Y, 1.0);
        // Long before the wave from the new place arrives.
        assert!(memory.update(cracks.sources(), 1.0 + 1e-9));
        let left = memory.shadows().next().unwrap().bent;
        assert!(left < before - LEAST, "{left} {before}");
        before = left;
    }
}

/// A memory without queues, growth or short cuts.
#[derive(Clone)]
struct Plain {
    arrived: Vec<bool>,
    nearest: Option<usize>,
    shadow: Shadow,
}

impl Plain {
    fn update(&mut self, cracks: &Cracks, crack: usize, memory: &Memory, now: f64) {
        let sites = &cracks.cracks[crack].sites;
        self.arrived.resize(sites.len(), false);
        let distance = |k: usize| sites[k].position.distance(memory.place);
        let mut looks: Vec<(f64, usize)> = (0..sites.len())
            .map(|k| (sites[k].time + f64::from(distance(k)) / WAVE, k))
            .filter(|&(time, k)| time < now && !self.arrived[k])
            .collect();
        looks.sort_by(|a, b| {
            a.0.total_cmp(&b.0)
                .then(distance(a.1).total_cmp(&distance(b.1)))
        });
        let mut darken = |k: usize| {
            let new = cracks
                .sources()
                .cast(crack as u32, k as u32, memory.place, memory.beta);
            self.shadow.bent = self.shadow.bent.min(new.bent);
            self.shadow.stretched = self.shadow.stretched.min(new.stretched);
        };
        for (_, k) in looks {
            self.arrived[k] = true;
            if self
                .nearest
                .is_none_or(|nearest| distance(k) < distance(nearest))
            {
                self.nearest = Some(k);
                darken(k);
            }
        }
        if let Some(nearest) = self.nearest {
            darken(nearest);
        }
    }
}

#[test]
fn what_is_released_stays_released_and_is_what_plain_lists_say() {
    let mut rng = stream(3, Purpose::WeakPoints, 0);
    let mut number = move || uniform(&mut rng) as f32;
    let (mut dark, mut fell_back) = (0, 0);
    for _ in 0..40 {
        let mut cracks = Cracks::default();
        let mut tips = Vec::new();
        let mut memories: Vec<Memory> = (0..30)
            .map(|k| {
                let place = Vec3::new(number(), number(), 0.05 * number()) * 0.04;
                Memory::new(place, if k % 3 == 0 { STRETCHED } else { bent(0.23) })
            })
            .collect();
        let nothing = Plain {
            arrived: Vec::new(),
            nearest: None,
            shadow: Seen::NOTHING.shadow,
        };
        let mut plain = vec![vec![nothing; 6]; memories.len()];
        for step in 0..60 {
            let now = f64::from(step) * 1e-6;
            if step % 8 == 0 && tips.len() < 6 {
                let at = Vec3::new(number(), number(), 0.0) * 0.04;
                let crack = cracks.start(at);
                tips.push((crack, at, 6.3 * number(), 4.0 * number() - 2.0));
            }
            for (crack, at, angle, turn) in &mut tips {
                // Curved: a nearer place may lie less straight beside a point.
                *angle += 0.2 * *turn;
                let ahead = Vec3::new(angle.cos(), angle.sin(), 0.0);
                *at += ahead * (1.2 * EDGE);
                cracks.grow(*crack, *at, Vec3::new(-ahead.y, ahead.x, 0.0), now);
            }
            for (memory, plain) in memories.iter_mut().zip(&mut plain) {
                let before: Vec<Shadow> = memory.seen.iter().map(|s| s.shadow).collect();
                let known = memory.cracks.clone();
                memory.update(cracks.sources(), now);
                for (crack, was) in known.iter().zip(before) {
                    let i = memory.cracks.binary_search(crack).unwrap();
                    let is = memory.seen[i].shadow;
                    assert!(is.bent <= was.bent && is.stretched <= was.stretched);
                }
                for crack in 0..cracks.cracks.len() {
                    plain[crack].update(&cracks, crack, memory, now);
                    let ours = memory.cracks.binary_search(&(crack as u32));
                    let ours = ours.map_or(Seen::NOTHING, |i| memory.seen[i]).shadow;
                    let theirs = plain[crack].shadow;
                    let faint = theirs.bent.min(theirs.stretched) > 1.0 - FAINT;
                    let rounding = if faint { FAINT } else { LEAST } + 1e-6;
                    assert!((ours.bent - theirs.bent).abs() < rounding);
                    assert!((ours.stretched - theirs.stretched).abs() < rounding);
                    dark += u32::from(theirs.bent < 0.9);
                    if let Some(nearest) = plain[crack].nearest {
                        let (crack, nearest) = (crack as u32, nearest as u32);
                        let now = cracks
                            .sources()
                            .cast(crack, nearest, memory.place, memory.beta);
                        fell_back += u32::from(now.bent > theirs.bent + 0.1);
                    }
                }
            }
        }
    }
    assert!(dark > 10_000 && fell_back > 100, "{dark} {fell_back}");
}

#[test]
fn cracks_release_a_point_in_their_order_however_late_it_hears_of_them() {
    let mut cracks = Cracks::default();
    for k in 0..5 {
        let at = Vec3::Y * (0.001 * k as f32);
        let crack = cracks.start(at);
        assert_eq!(crack, k);
    }
    // The last is cut, and arrives, first.
    for k in (0..5).rev() {
        let normal = Vec3::new(0.1 * k as f32, 1.0, 0.0).normalize();
        cracks.grow(k, Vec3::Y * (0.001 * k as f32), normal, 0.0);
    }
    let mut memory = Memory::new(Vec3::Y * 0.0045, bent(0.23));
    for now in [1e-7, 3e-7, 5e-7, 1e-6, 1.0] {
        memory.update(cracks.sources(), now);
    }
    let normals: Vec<Vec3> = memory.shadows().map(|shadow| shadow.normal).collect();
    assert!(normals.len() > 3);
    assert!(normals.is_sorted_by(|a, b| a.x < b.x), "{normals:?}");
}
