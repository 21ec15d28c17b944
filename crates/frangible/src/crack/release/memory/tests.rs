use super::*;
use crate::crack::surface::CrackFrame;
use crate::rng::{Purpose, stream, uniform};
use crate::stress::bent;

const EDGE: f32 = 1e-3;
const WAVE: f64 = 3000.0;

/// Cracks made by hand.
struct Cracks {
    cracks: Vec<Crack>,
    extents: Extents,
}

impl Default for Cracks {
    fn default() -> Self {
        Self {
            cracks: Vec::new(),
            extents: Extents::new(EDGE, WAVE),
        }
    }
}

impl Cracks {
    fn start(&mut self, at: Vec3) -> u32 {
        self.cracks
            .push(Crack::new(CrackFrame::new(at, Vec3::Y, 0.0, 1.0, 1, 0), 0));
        self.extents.start(at);
        self.cracks.len() as u32 - 1
    }

    fn grow(&mut self, crack: u32, position: Vec3, direction: Vec3, time: f64) {
        self.extents.grow(crack as usize, position, time);
        self.cracks[crack as usize].area += f64::from(5.0 * EDGE * EDGE);
        self.cracks[crack as usize].sites.push(Site {
            position,
            direction,
            time,
        });
    }

    /// Takes in what they all leave by `now`, s; returns true if any releases the point more than before.
    fn heard_by(&self, memory: &mut Memory, now: f64) -> bool {
        let update = |ring| memory.update(self.sources(), ring, None, now);
        Ring::ALL.map(update).contains(&true)
    }

    fn sources(&self) -> Sources<'_> {
        Sources {
            cracks: &self.cracks,
            extents: &self.extents,
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
        let mut memory = Memory::new(Vec3::Y * y, Some(beta));
        let arrival = f64::from(y) / WAVE;
        assert!(!cracks.heard_by(&mut memory, 0.999 * arrival) && !memory.is_dark());
        assert!(cracks.heard_by(&mut memory, 1.001 * arrival) && memory.is_dark());
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
        assert!(!cracks.heard_by(&mut memory, 1.0));
    }
}

/// A front in a solid, beside a crack that ran along x at its speed and stopped.
#[test]
fn a_front_is_released_as_by_the_part_of_a_crack_that_is_ahead_of_it() {
    let mut cracks = Cracks::default();
    let crack = cracks.start(Vec3::ZERO);
    let time = |k: i32| f64::from(k as f32 * EDGE) / (CRACK_SPEED * WAVE);
    for k in 0..=20 {
        cracks.grow(crack, Vec3::X * (k as f32 * EDGE), Vec3::Y, time(k));
    }
    let left = |k: i32| {
        let place = Vec3::new(k as f32 * EDGE, 2.0 * EDGE, 0.0);
        let mut memory = Memory::of_front(place, None);
        cracks.heard_by(&mut memory, 1.0);
        let stretched = memory.shadows().next().map(|shadow| shadow.stretched);
        stretched.unwrap_or(1.0)
    };
    let half_length = cracks.extents.half_length(0);
    let half_width = cracks.cracks[0].half_width(half_length);
    assert!(half_width > EDGE && half_width < 0.5 * half_length);
    let behind = share_in_solid(2.0 * EDGE, half_width, half_length);
    assert!((left(3) - behind).abs() < 1e-4 && behind < 0.9);
    let narrow = share_in_solid(2.0 * EDGE, EDGE, half_length);
    assert!((left(19) - narrow).abs() < 1e-3 && narrow > behind + 0.02);
    assert_eq!(left(20), 1.0);
}

#[test]
fn ahead_of_a_cracks_tips_nothing_is_taken() {
    let cracks = straight(0.01);
    for x in [0.0111, 0.012, 0.015, 0.05, -0.02] {
        let mut memory = Memory::new(Vec3::X * x, Some(bent(0.23)));
        assert!(
            !cracks.heard_by(&mut memory, 1.0) && !memory.is_dark(),
            "{x}"
        );
    }
}

#[test]
fn a_point_between_two_places_of_a_crack_is_beside_it() {
    let cracks = straight(0.01);
    for x in [0.0, 0.3, 0.5] {
        let mut memory = Memory::new(Vec3::new(x, 0.1, 0.0) * EDGE, Some(bent(0.23)));
        assert!(cracks.heard_by(&mut memory, 1.0));
        assert!(memory.shadows().all(|shadow| shadow.bent < 0.02), "{x}");
    }
}

#[test]
fn a_longer_crack_leaves_less_without_a_place_nearer_by() {
    let mut cracks = straight(0.002);
    let mut memory = Memory::new(Vec3::Y * 0.005, Some(bent(0.23)));
    assert!(cracks.heard_by(&mut memory, 1.0));
    let mut before = memory.shadows().next().unwrap().bent;
    for k in 3..9 {
        cracks.grow(0, Vec3::X * (k as f32 * EDGE), Vec3::Y, 1.0);
        // Long before the wave from the new place arrives.
        assert!(cracks.heard_by(&mut memory, 1.0 + 1e-9));
        let left = memory.shadows().next().unwrap().bent;
        assert!(left < before - LEAST, "{left} {before}");
        before = left;
    }
}

/// Shares of the stress that a crack leaves at a point, found site by site.
fn plainly(cracks: &Cracks, crack: usize, memory: &Memory, now: f64) -> Option<Shadow> {
    let distance = |site: &Site| site.position.distance(memory.place);
    let sites = cracks.cracks[crack].sites.list().iter();
    let reach = |site: &Site| WAVE as f32 * (now as f32 - site.time as f32);
    let heard = sites.filter(|site| distance(site) < reach(site));
    let nearest = heard.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let half_length = cracks.extents.half_length(crack);
    let to_crack = nearest_place(nearest, memory.place, 0.5 * EDGE);
    let normal = nearest.direction;
    let share = |beta| share_left(to_crack, normal, |y| share_beside(y, half_length, beta));
    let [stretched, bent] = [STRETCHED, memory.bent.unwrap_or(STRETCHED)].map(share);
    Some(Shadow {
        normal,
        stretched,
        bent,
    })
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
                Memory::new(place, (k % 3 != 0).then(|| bent(0.23)))
            })
            .collect();
        let mut least = vec![[[1.0_f32; 2]; 6]; memories.len()];
        for step in 0..60 {
            let now = f64::from(step) * 1e-6;
            if step % 8 == 0 && tips.len() < 6 {
                let at = Vec3::new(number(), number(), 0.0) * 0.04;
                let crack = cracks.start(at);
                tips.push((crack, at, 6.3 * number(), 4.0 * number() - 2.0));
            }
            // In the end they rest, while their waves are still on their way.
            for (crack, at, angle, turn) in tips.iter_mut().filter(|_| step < 50) {
                // Curved: a nearer place may lie less straight beside a point.
                *angle += 0.2 * *turn;
                let ahead = Vec3::new(angle.cos(), angle.sin(), 0.0);
                *at += ahead * (1.2 * EDGE);
                cracks.grow(*crack, *at, Vec3::new(-ahead.y, ahead.x, 0.0), now);
            }
            for (memory, least) in memories.iter_mut().zip(&mut least) {
                let before = memory.shadows.clone();
                cracks.heard_by(memory, now);
                assert!(memory.shadows.is_sorted_by(|a, b| a.0 < b.0));
                for (crack, was) in before {
                    let find = |(of, _): &&(u32, Shadow)| *of == crack;
                    let (_, is) = memory.shadows.iter().find(find).unwrap();
                    assert!(is.bent <= was.bent && is.stretched <= was.stretched);
                }
                for (crack, least) in least.iter_mut().enumerate().take(cracks.cracks.len()) {
                    let known = memory.shadows.iter().find(|(of, _)| *of == crack as u32);
                    let ours = known.map_or([1.0; 2], |(_, s)| [s.bent, s.stretched]);
                    let theirs = plainly(&cracks, crack, memory, now);
                    let theirs = theirs.map_or([1.0; 2], |s| [s.bent, s.stretched]);
                    fell_back += u32::from(theirs[0] > least[0] + 0.1);
                    for k in 0..2 {
                        least[k] = least[k].min(theirs[k]);
                        let faint = least[0].min(least[1]) > 1.0 - FAINT;
                        let rounding = if faint { FAINT } else { LEAST } + 1e-3;
                        assert!((ours[k] - least[k]).abs() < rounding, "{ours:?} {least:?}");
                    }
                    dark += u32::from(least[0] < 0.9);
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
    let mut memory = Memory::new(Vec3::Y * 0.0045, Some(bent(0.23)));
    for now in [1e-7, 3e-7, 5e-7, 1e-6, 1.0] {
        cracks.heard_by(&mut memory, now);
    }
    let normals: Vec<Vec3> = memory.shadows().map(|shadow| shadow.normal).collect();
    assert!(normals.len() > 3);
    assert!(normals.is_sorted_by(|a, b| a.x < b.x), "{normals:?}");
}
