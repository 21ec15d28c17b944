//! A session that runs beside whoever draws, so that neither a step nor a break nor a bake makes anybody wait: on a thread of its own, or
//! where there are no threads in another program, which tells in bytes what there is to see. That program runs its session on the only
//! thread it has.

use std::collections::VecDeque;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use frangible_sound::Outlet;
use web_time::Instant;

use crate::command::Command;
use crate::host::Host;
use crate::session::Session;
use crate::shown::Shown;
use crate::wire::Unpacker;

/// Longest time between two looks at what there is to see, while something moves.
const FRAME: Duration = Duration::from_millis(16);

/// How long steps are taken before anybody else has a turn. A clock that cannot be kept up with goes slower.
const PATIENCE: Duration = Duration::from_millis(10);

/// A session that runs beside whoever draws.
pub struct Worker {
    place: Place,
    sent: u64,
}

/// Where a session runs.
enum Place {
    Thread {
        commands: Option<Sender<Command>>,
        latest: Arc<Mutex<Arc<Shown>>>,
        thread: Option<JoinHandle<()>>,
    },
    Here(Box<Here>),
    There(Box<There>),
}

/// A session on the thread of whoever draws.
struct Here {
    work: Work,
    commands: VecDeque<Command>,
    latest: Arc<Shown>,
}

/// A program in which a session runs, without any memory in common.
pub trait Remote {
    /// Gives it a command.
    fn give(&mut self, line: String);

    /// What its [`Packer`](crate::Packer) made since this was asked last, oldest first.
    fn news(&mut self) -> Vec<Vec<u8>>;
}

/// A session in another program.
struct There {
    remote: Box<dyn Remote>,
    unpacker: Unpacker,
    latest: Arc<Shown>,
    /// Whether it told what cannot be read.
    broken: bool,
}

impl Worker {
    /// Starts a session on a thread; with `by_clock` its scenes run in real time, else only by [`Command::Step`]. What happens is heard at the
    /// outlet, if there is one.
    #[must_use]
    pub fn start(by_clock: bool, outlet: Option<Outlet>) -> Self {
        let (commands, received) = channel();
        let latest = Arc::new(Mutex::new(Arc::new(Shown::default())));
        let shared = Arc::clone(&latest);
        let thread = std::thread::spawn(move || {
            let work_there = Work::new(Session::new(), by_clock, outlet);
            work(work_there, &received, |shown| {
                *shared.lock().unwrap_or_else(PoisonError::into_inner) = shown;
            });
        });
        Self {
            place: Place::Thread {
                commands: Some(commands),
                latest,
                thread: Some(thread),
            },
            sent: 0,
        }
    }

    /// A session that runs in another program; [`Worker::advance`] takes in what it tells.
    #[must_use]
    pub fn start_there(remote: Box<dyn Remote>) -> Self {
        Self {
            place: Place::There(Box::new(There {
                remote,
                unpacker: Unpacker::default(),
                latest: Arc::default(),
                broken: false,
            })),
            sent: 0,
        }
    }

    /// Starts a session on this thread, which has to call [`Worker::advance`] again and again. A break, an analysis and a
    /// second impact make it wait.
    #[must_use]
    pub fn start_here(by_clock: bool, host: Box<dyn Host>, outlet: Option<Outlet>) -> Self {
        let session = Session::in_host(host);
        Self {
            place: Place::Here(Box::new(Here {
                work: Work::new(session, by_clock, outlet),
                commands: VecDeque::new(),
                latest: Arc::default(),
            })),
            sent: 0,
        }
    }

    /// Lets a session of this thread go on for some milliseconds, or takes in what one in another program tells; one that has a thread
    /// needs no help.
    pub fn advance(&mut self) {
        match &mut self.place {
            Place::Thread { .. } => {}
            Place::Here(here) => here.advance(),
            Place::There(there) => there.listen(),
        }
    }

    /// Gives a command; it is carried out after those given before. False if the session's thread is gone.
    pub fn send(&mut self, command: Command) -> bool {
        self.sent += 1;
        match &mut self.place {
            Place::Thread { commands, .. } => {
                let sender = commands.as_ref();
                sender.is_some_and(|commands| commands.send(command).is_ok())
            }
            Place::Here(here) => {
                here.commands.push_back(command);
                true
            }
            Place::There(there) => {
                there.remote.give(command.to_string());
                !there.broken
            }
        }
    }

    /// What there is to see, as of a few milliseconds ago.
    #[must_use]
    pub fn latest(&self) -> Arc<Shown> {
        match &self.place {
            Place::Thread { latest, .. } => {
                Arc::clone(&latest.lock().unwrap_or_else(PoisonError::into_inner))
            }
            Place::Here(here) => Arc::clone(&here.latest),
            Place::There(there) => Arc::clone(&there.latest),
        }
    }

    /// Whether all commands given so far are done, with all they began, in what is shown.
    #[must_use]
    pub fn is_done(&self, shown: &Shown) -> bool {
        shown.commands == self.sent && !shown.busy
    }

    /// Whether the session ended by itself, which it does not unless something is wrong.
    #[must_use]
    pub fn is_dead(&self) -> bool {
        match &self.place {
            Place::Thread { thread, .. } => thread.as_ref().is_none_or(JoinHandle::is_finished),
            Place::Here(_) => false,
            Place::There(there) => there.broken,
        }
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        let Place::Thread {
            commands, thread, ..
        } = &mut self.place
        else {
            return;
        };
        *commands = None;
        if let Some(thread) = thread.take() {
            // It panicked: its message was printed then.
            let _ = thread.join();
        }
    }
}

impl There {
    fn listen(&mut self) {
        for bytes in self.remote.news() {
            match self.unpacker.unpack(&bytes) {
                Some(shown) => self.latest = Arc::new(shown),
                None => self.broken = true,
            }
        }
    }
}

impl Here {
    fn advance(&mut self) {
        while !self.work.session.owes() {
            let Some(command) = self.commands.pop_front() else {
                break;
            };
            self.work.take(command);
        }
        self.work.turn();
        if self.work.news {
            self.latest = self.work.publish();
        }
    }
}

/// A session, its clock, and what of it was not shown yet.
struct Work {
    session: Session,
    clock: Clock,
    by_clock: bool,
    published: Instant,
    news: bool,
}

impl Work {
    fn new(mut session: Session, by_clock: bool, outlet: Option<Outlet>) -> Self {
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

    /// Whether something moves.
    fn moves(&self) -> bool {
        self.session.owes() || self.by_clock && self.session.is_running()
    }

    fn take(&mut self, command: Command) {
        // What went wrong is in what is shown.
        let _ = self.session.begin(command);
        self.news = true;
    }

    /// Collects what was computed elsewhere and takes the steps that are due, for some milliseconds; true if the clock runs
    /// and none was due.
    fn turn(&mut self) -> bool {
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

    /// What there is to see now.
    fn publish(&mut self) -> Arc<Shown> {
        self.published = Instant::now();
        self.news = false;
        Arc::new(self.session.shown())
    }
}

fn work(mut work: Work, commands: &Receiver<Command>, mut show: impl FnMut(Arc<Shown>)) {
    loop {
        let moving = work.moves();
        let patience = match (moving, work.session.is_busy()) {
            (true, _) => Duration::ZERO,
            (false, true) => Duration::from_millis(4),
            (false, false) => Duration::from_millis(30),
        };
        // A command waits for the steps of the one before it.
        if !work.session.owes() {
            match commands.recv_timeout(patience) {
                Ok(command) => work.take(command),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
        match work.turn() {
            true => std::thread::sleep(Duration::from_millis(2)),
            false => std::thread::yield_now(),
        }
        let due = !moving || work.published.elapsed() >= FRAME || !work.session.is_busy();
        if work.news && due {
            show(work.publish());
        }
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
            // A refused break is told by the session; the scene goes on.
            let _ = session.step();
            self.due -= (session.time() - before).max(1e-6);
            any = true;
        }
        any
    }
}
