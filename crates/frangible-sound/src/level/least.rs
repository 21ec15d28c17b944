//! The least of the last values.

use std::collections::VecDeque;

/// The least of the last values.
#[derive(Clone, Debug, Default)]
pub(super) struct Least {
    /// Values that may become the least, the least first, and their times.
    waiting: VecDeque<(u64, f64)>,
    now: u64,
}

impl Least {
    /// Takes the next value, and returns the least of the last `count`.
    pub(super) fn next(&mut self, value: f64, count: usize) -> f64 {
        while self.waiting.back().is_some_and(|&(_, last)| last >= value) {
            self.waiting.pop_back();
        }
        self.waiting.push_back((self.now, value));
        self.now += 1;
        while (self.waiting.front()).is_some_and(|&(then, _)| then + (count as u64) < self.now) {
            self.waiting.pop_front();
        }
        self.waiting.front().map_or(value, |&(_, least)| least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_is_that_of_the_last_ones_and_no_others() {
        let values = [5.0, 3.0, 4.0, 4.0, 9.0, 2.0, 2.0, 8.0, 8.0, 8.0];
        let mut least = Least::default();
        let found: Vec<f64> = values.iter().map(|&v| least.next(v, 3)).collect();
        let wanted = [5.0, 3.0, 3.0, 3.0, 4.0, 2.0, 2.0, 2.0, 2.0, 8.0];
        assert_eq!(found, wanted);
    }
}
