//! A session that runs independently of its window, so that steps, breaks and bakes do not block the window: on a separate thread, or without
//! threads in another program, which sends its state as bytes and runs its session on its only thread.

mod here;
mod there;
mod thread;
mod work;

use std::sync::Arc;

use frangible_sound::Outlet;

use crate::command::Command;
use crate::host::Host;
use crate::shown::Shown;

use here::Here;
use there::There;
use thread::OnThread;

pub use there::Remote;

/// A session that runs independently of its window.
pub struct Worker {
    // A program that starts only sessions of one place has the code of that place only: the window of a page has no physics.
    place: Box<dyn Place>,
    sent: u64,
}

/// Place in which a session runs.
trait Place {
    /// Lets it go on, where it has no thread of its own.
    fn advance(&mut self) {}

    /// Gives it a command; false if it is gone.
    fn send(&mut self, command: Command) -> bool;

    /// Latest state of the session.
    fn latest(&self) -> Arc<Shown>;

    /// Returns true if it ended by itself.
    fn is_dead(&self) -> bool {
        false
    }
}

impl Worker {
    /// Starts a session on a thread. With `by_clock` its scenes run in real time, otherwise only by [`Command::Step`]. Sound is output to `outlet`,
    /// if given.
    #[must_use]
    pub fn start(by_clock: bool, outlet: Option<Outlet>) -> Self {
        Self::at(OnThread::start(by_clock, outlet))
    }

    /// Connects to a session in another program; [`Worker::advance`] receives its state.
    #[must_use]
    pub fn start_there(remote: Box<dyn Remote>) -> Self {
        Self::at(There::start(remote))
    }

    /// Starts a session on this thread, which must call [`Worker::advance`] regularly. Breaks, analyses and repeated impacts block the
    /// thread.
    #[must_use]
    pub fn start_here(by_clock: bool, host: Box<dyn Host>, outlet: Option<Outlet>) -> Self {
        Self::at(Here::start(by_clock, host, outlet))
    }

    fn at(place: impl Place + 'static) -> Self {
        Self {
            place: Box::new(place),
            sent: 0,
        }
    }

    /// Advances a session on this thread for some milliseconds, or receives the state of one in another program. Not needed for a session with its
    /// own thread.
    pub fn advance(&mut self) {
        self.place.advance();
    }

    /// Queues a command. Returns false if the session's thread has ended.
    pub fn send(&mut self, command: Command) -> bool {
        self.sent += 1;
        self.place.send(command)
    }

    /// Returns the latest state of the session, at most a few milliseconds old.
    #[must_use]
    pub fn latest(&self) -> Arc<Shown> {
        self.place.latest()
    }

    /// Returns true if, in this state, all commands sent so far and their background jobs are complete.
    #[must_use]
    pub fn is_done(&self, shown: &Shown) -> bool {
        shown.commands == self.sent && !shown.busy
    }

    /// Returns true if the session ended unexpectedly.
    #[must_use]
    pub fn is_dead(&self) -> bool {
        self.place.is_dead()
    }
}
