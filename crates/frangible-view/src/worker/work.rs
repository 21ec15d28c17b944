//! A session and the clock that drives it, on any thread.

use std::sync::Arc;
use std::time::Duration;

use frangible_sound::Outlet;
use web_time::Instant;

use crate::command::Command;
use crate::session::Session;
use crate::shown::Shown;

/// Time for which steps are taken before anybody else has a turn. A clock that cannot be kept up with goes slower.
const PATIENCE: Duration = Duration::from_millis(10);

/// A session, its clock, and its news that were not published yet.
pub(super) struct Work {
    pub(super) session: Session,
    clock: Clock,
    by_clock: bool,
    pub(super) published: Instant,
    pub(super) news: bool,
}

impl Work {
    pub(super) fn new(mut session: Session, by_clock: bool, outlet: Option<Outlet>) -> Self {
        if let Some(outlet) = outlet {
            session.listen(outlet);
        }
        Self {
            session,
            clock: Clock::new(),
            by_clock,
            published: Instant::now(),
            news: true,
        }
    }

    /// Returns true if steps are due or the clock runs.
    pub(super) fn moves(&self) -> bool {
        self.session.owes() || self.by_clock && self.session.is_running()
    }

    pub(super) fn take(&mut self, command: Command) {
        // An error is a part of the shown state.
        let _ = self.session.begin(command);
        self.news = true;
    }

    /// Collects results computed elsewhere and takes the steps that are due, for some milliseconds; true if the clock runs and none was due.
    pub(super) fn turn(&mut self) -> bool {
        let session = &mut self.session;
        // How far a bake is, is news too.
        self.news |= session.poll() || session.is_busy();
        let began = Instant::now();
        while session.owes() && began.elapsed() < PATIENCE {
            let _ = session.take_owed_step();
            self.news = true;
        }
        let runs = self.by_clock && session.is_running() && !session.owes();
        let any = self.clock.run(session, runs);
        self.news |= any;
        runs && !any
    }

    /// Returns the current state, to be shown.
    pub(super) fn publish(&mut self) -> Arc<Shown> {
        self.published = Instant::now();
        self.news = false;
        Arc::new(self.session.shown())
    }
}

/// Lets simulated time go on with the time of day.
struct Clock {
    last: Instant,
    /// Simulated time that is due, s.
    due: f64,
}

impl Clock {
    fn new() -> Self {
        Self {
            last: Instant::now(),
            due: 0.0,
        }
    }

    /// Takes the steps that are due; true if there were any.
    fn run(&mut self, session: &mut Session, runs: bool) -> bool {
        let now = Instant::now();
        let passed = now.duration_since(self.last).as_secs_f64();
        self.last = now;
        if !runs {
            self.due = 0.0;
            return false;
        }
        self.due += passed.min(0.1) * session.slow_motion();
        let mut any = false;
        while self.due > 0.0 {
            if now.elapsed() > PATIENCE {
                self.due = 0.0;
                break;
            }
            let before = session.time();
            // The session shows a refused break; the scene goes on.
            let _ = session.step();
            self.due -= (session.time() - before).max(1e-6);
            any = true;
        }
        any
    }
}
