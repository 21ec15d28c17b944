//! Durations of work, on the thread that does it.

use std::collections::VecDeque;
use std::time::Duration;

/// Number of laps that are kept: four seconds of pictures.
const KEPT: usize = 240;

/// Processor time of this thread so far; where the system does not tell, the time of day, and in a browser nothing.
pub(crate) fn thread_time() -> Duration {
    #[cfg(unix)]
    {
        let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
        Duration::new(
            time.tv_sec.unsigned_abs(),
            time.tv_nsec.unsigned_abs() as u32,
        )
    }
    #[cfg(all(not(unix), not(target_arch = "wasm32")))]
    {
        use std::sync::OnceLock;
        use web_time::Instant;
        static START: OnceLock<Instant> = OnceLock::new();
        START.get_or_init(Instant::now).elapsed()
    }
    #[cfg(all(not(unix), target_arch = "wasm32"))]
    Duration::ZERO
}

/// The last times of one kind.
#[derive(Clone, Debug, Default)]
pub(crate) struct Laps {
    /// Their lengths, s.
    last: VecDeque<f64>,
}

/// Distribution of the laps' lengths, s.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct Spread {
    /// Number of laps.
    pub count: usize,
    /// Half of them are shorter.
    pub median: f64,
    /// One in a hundred is longer.
    pub p99: f64,
}

impl Laps {
    pub(crate) fn note(&mut self, lap: Duration) {
        if self.last.len() == KEPT {
            self.last.pop_front();
        }
        self.last.push_back(lap.as_secs_f64());
    }

    pub(crate) fn spread(&self) -> Spread {
        let mut sorted: Vec<f64> = self.last.iter().copied().collect();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let last = sorted.len().saturating_sub(1) as f64;
            sorted.get((share * last).round() as usize).copied()
        };
        Spread {
            count: sorted.len(),
            median: at(0.5).unwrap_or_default(),
            p99: at(0.99).unwrap_or_default(),
        }
    }

    /// All laps, s, from the first to the last.
    #[cfg(feature = "window")]
    pub(crate) fn iter(&self) -> impl Iterator<Item = f64> {
        self.last.iter().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_a_hundred_laps_one_is_longer_than_the_p99_and_old_ones_are_forgotten() {
        let mut laps = Laps::default();
        assert_eq!(laps.spread(), Spread::default());
        (0..1000).for_each(|_| laps.note(Duration::from_secs(9)));
        (1..=KEPT as u64).for_each(|i| laps.note(Duration::from_millis(i)));
        let spread = laps.spread();
        assert_eq!(spread.count, KEPT);
        assert!((spread.median - 0.1205).abs() < 1e-3, "{spread:?}");
        let longer = laps.last.iter().filter(|&&lap| lap > spread.p99).count();
        assert_eq!(longer, KEPT / 100);
    }

    #[test]
    fn work_takes_processor_time_and_sleep_takes_none() {
        let start = thread_time();
        let mut sum = 0.0_f64;
        while thread_time() == start {
            sum = std::hint::black_box(sum + 1.0);
        }
        let worked = thread_time();
        std::thread::sleep(Duration::from_millis(30));
        if cfg!(target_os = "linux") {
            assert!(thread_time() - worked < Duration::from_millis(20));
        }
    }
}
