//! Release waves on their way to a point.
//!
//! A wave that arrives after one from a nearer site of the same crack releases nothing more. So a point remembers, for each crack, only
//! the sites whose waves no nearer site's wave precedes. They stand in a queue per crack: whoever arrives later in it is nearer.

/// The end of a queue.
const END: u32 = u32::MAX;

/// A site whose wave is on its way.
#[derive(Clone, Copy, Debug)]
struct Arrival {
    site: u32,
    /// m.
    distance: f32,
    /// s.
    time: f64,
    /// The next site in the crack's queue, whose wave arrives sooner and comes from farther away.
    next: u32,
}

/// The waves of one crack, the one that arrives last first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Queue {
    first: u32,
}

impl Default for Queue {
    fn default() -> Self {
        Self::EMPTY
    }
}

impl Queue {
    pub(super) const EMPTY: Self = Self { first: END };

    pub(super) fn is_empty(self) -> bool {
        self.first == END
    }
}

/// The waves of all cracks.
#[derive(Clone, Debug, Default)]
pub(super) struct Arrivals {
    all: Vec<Arrival>,
    /// Places in `all` that are free again.
    free: Vec<u32>,
}

impl Arrivals {
    /// Adds a site to its crack's queue unless one there is no farther and no later, and drops those that it precedes; whether it was
    /// added.
    pub(super) fn add(&mut self, queue: &mut Queue, site: u32, distance: f32, time: f64) -> bool {
        let mut before = END;
        let mut at = queue.first;
        while let Some(later) = self.get(at).filter(|a| a.time > time) {
            if later.distance < distance {
                before = at;
            } else {
                self.free.push(at);
            }
            at = later.next;
        }
        if let Some(sooner) = self.get(at) {
            if sooner.distance <= distance {
                return false;
            }
            if sooner.time == time {
                self.free.push(at);
                at = sooner.next;
            }
        }
        let new = Arrival {
            site,
            distance,
            time,
            next: at,
        };
        let place = match self.free.pop() {
            Some(place) => {
                self.all[place as usize] = new;
                place
            }
            None => {
                self.all.push(new);
                self.all.len() as u32 - 1
            }
        };
        self.link(queue, before, place);
        true
    }

    /// Whether a queue has a site that is no farther than this distance, m, and no later than this time, s.
    pub(super) fn precedes(&self, queue: Queue, distance: f32, time: f64) -> bool {
        let mut at = queue.first;
        while let Some(later) = self.get(at).filter(|a| a.time > time) {
            at = later.next;
        }
        self.get(at)
            .is_some_and(|sooner| sooner.distance <= distance)
    }

    /// Takes all sites that arrive before `now`, s, the nearest first: that one, and its distance.
    pub(super) fn arrive(
        &mut self,
        queue: &mut Queue,
        now: f64,
        mut each: impl FnMut(u32, f32),
    ) -> Option<(u32, f32)> {
        let mut before = END;
        let mut at = queue.first;
        while let Some(later) = self.get(at).filter(|a| a.time >= now) {
            before = at;
            at = later.next;
        }
        let nearest = self.get(at)?;
        while let Some(farther) = self.get(at) {
            each(farther.site, farther.distance);
            self.free.push(at);
            at = farther.next;
        }
        self.link(queue, before, END);
        Some((nearest.site, nearest.distance))
    }

    /// When the first of a queue arrives that does not arrive before `now`, s; infinite where none does.
    pub(super) fn next(&self, queue: Queue, now: f64) -> f64 {
        let mut next = f64::INFINITY;
        let mut at = queue.first;
        while let Some(later) = self.get(at).filter(|a| a.time >= now) {
            next = later.time;
            at = later.next;
        }
        next
    }

    /// None at the end of a queue.
    fn get(&self, at: u32) -> Option<Arrival> {
        self.all.get(at as usize).copied()
    }

    fn link(&mut self, queue: &mut Queue, before: u32, place: u32) {
        match before {
            END => queue.first = place,
            before => self.all[before as usize].next = place,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::{Purpose, stream, uniform};

    /// A list that does what the queues do, without an order.
    #[derive(Default)]
    struct Plain(Vec<(u32, f32, f64)>);

    impl Plain {
        fn add(&mut self, site: u32, distance: f32, time: f64) -> bool {
            if self.0.iter().any(|p| p.1 <= distance && p.2 <= time) {
                return false;
            }
            self.0.retain(|p| p.1 < distance || p.2 < time);
            self.0.push((site, distance, time));
            true
        }

        /// Those that arrive, the nearest first.
        fn arrive(&mut self, now: f64) -> Vec<(u32, f32)> {
            let here = self.0.iter().filter(|p| p.2 < now);
            let mut here: Vec<_> = here.map(|p| (p.0, p.1)).collect();
            here.sort_by(|a, b| a.1.total_cmp(&b.1));
            self.0.retain(|p| p.2 >= now);
            here
        }
    }

    #[test]
    fn queues_hold_what_plain_lists_hold() {
        let mut rng = stream(1, Purpose::WeakPoints, 0);
        let mut number = |count: f64| (uniform(&mut rng) * count).floor();
        let mut arrivals = Arrivals::default();
        let mut queues = [Queue::default(); 3];
        let mut plain: [Plain; 3] = Default::default();
        let (mut added, mut arrived) = (0, 0);
        for k in 0..4000_u32 {
            let i = number(3.0) as usize;
            // Few different numbers, so that many are equal.
            let (distance, mut time) = (number(12.0) as f32, number(12.0));
            if time == 0.0 {
                time = f64::NEG_INFINITY;
            }
            let (queue, plain) = (&mut queues[i], &mut plain[i]);
            let expected = plain.add(k, distance, time);
            assert_eq!(arrivals.add(queue, k, distance, time), expected);
            added += u32::from(expected);
            let now = number(14.0);
            if k % 4 == 0 {
                let expected = plain.arrive(now);
                let mut met = Vec::new();
                let nearest = arrivals.arrive(queue, now, |site, _| met.push(site));
                assert_eq!(nearest, expected.first().copied());
                assert!(met.iter().eq(expected.iter().map(|(site, _)| site)));
                arrived += expected.len();
            }
            let times = plain.0.iter().map(|p| p.2).filter(|&t| t >= now);
            assert_eq!(
                arrivals.next(*queue, now),
                times.fold(f64::INFINITY, f64::min)
            );
            assert_eq!(queue.is_empty(), plain.0.is_empty());
        }
        assert!(added > 500 && arrived > 200, "{added} {arrived}");
        assert!(arrivals.all.len() < 40);
    }
}
