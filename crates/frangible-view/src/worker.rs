//! A session that runs beside its window, so that neither a step nor a break nor a bake makes anybody wait: on a thread of its own, or without
//! threads in another program, which sends its state as bytes. That program runs its session on the only thread it has.

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

/// A session that runs beside its window.
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
    /// Starts a session on a thread; with `by_clock` its scenes run in real time, else only by [`Command::Step`]. Their sound goes to the outlet, if
    /// there is one.
    #[must_use]
    pub fn start(by_clock: bool, outlet: Option<Outlet>) -> Self {
        Self::at(OnThread::start(by_clock, outlet))
    }

    /// A session that runs in another program; [`Worker::advance`] takes in its news.
    #[must_use]
    pub fn start_there(remote: Box<dyn Remote>) -> Self {
        Self::at(There::start(remote))
    }

    /// Starts a session on this thread, which has to call [`Worker::advance`] again and again. A break, an analysis and a
    /// second impact make it wait.
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

    /// Lets a session of this thread go on for some milliseconds, or takes in the news of one in another program; one that has a thread needs no
    /// help.
    pub fn advance(&mut self) {
        self.place.advance();
    }

    /// Gives a command; it is carried out after those given before. False if the session's thread is gone.
    pub fn send(&mut self, command: Command) -> bool {
        self.sent += 1;
        self.place.send(command)
    }

    /// Latest state of the session, as of a few milliseconds ago.
    #[must_use]
    pub fn latest(&self) -> Arc<Shown> {
        self.place.latest()
    }

    /// Returns true if the state shows all commands given so far as done, with all they began.
    #[must_use]
    pub fn is_done(&self, shown: &Shown) -> bool {
        shown.commands == self.sent && !shown.busy
    }

    /// Returns true if the session ended by itself, which it does not unless something is wrong.
    #[must_use]
    pub fn is_dead(&self) -> bool {
        self.place.is_dead()
    }
}
