//! Results of background jobs: bakes, analyses, repeated impacts, comparisons and films.
//!
//! A long-running command starts a job on another thread and returns. The owner of the session polls for results, or waits for all of them.

use std::time::Duration;

use super::Session;

impl Session {
    /// Collects the results of background jobs. Returns true if there were any.
    pub fn poll(&mut self) -> bool {
        let any = self.poll_all(None);
        self.stale |= any;
        any
    }

    /// Waits for all background jobs.
    pub fn finish_jobs(&mut self) {
        let wait = Some(Duration::from_millis(200));
        while self.has_jobs() {
            let any = self.poll_all(wait);
            self.stale |= any;
        }
    }

    fn poll_all(&mut self, wait: Option<Duration>) -> bool {
        let first = self.poll_bake(wait) | self.poll_analysis(wait);
        first | self.poll_again(wait) | self.poll_film(wait)
    }

    fn has_jobs(&self) -> bool {
        self.bake_job.is_some()
            || self.analysis_job.is_some()
            || self.again_job.is_some()
            || self.film_job.is_some()
    }

    /// Returns true while a background job runs.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        self.owes() || self.has_jobs()
    }
}
