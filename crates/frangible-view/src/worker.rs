//! A session on a thread of its own: neither a step nor a break nor a bake makes whoever draws wait.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::command::Command;
use crate::session::Session;
use crate::shown::Shown;

/// Longest time between two looks at what there is to see, while something moves.
const FRAME: Duration = Duration::from_millis(16);

/// How long steps are taken before anybody else has a turn. A clock that cannot be kept up with goes slower.
const PATIENCE: Duration = Duration::from_millis(10);

/// A session that runs elsewhere.
pub struct Worker {
    commands: Option<Sender<Command>>,
    latest: Arc<Mutex<Arc<Shown>>>,
    sent: u64,
    thread: Option<JoinHandle<()>>,
}

impl Worker {
    /// Starts a session; with `by_clock` its scenes run in real time, else only by [`Command::Step`].
    #[must_use]
    pub fn start(by_clock: bool) -> Self {
        let (commands, received) = channel();
        let latest = Arc::new(Mutex::new(Arc::new(Shown::default())));
        let shared = Arc::clone(&latest);
        let thread = std::thread::spawn(move || {
            let mut session = Session::new();
            work(&mut session, &received, by_clock, |session| {
                let shown = Arc::new(session.shown());
                *shared.lock().unwrap_or_else(PoisonError::into_inner) = shown;
            });
        });
        Self {
            commands: Some(commands),
            latest,
            sent: 0,
            thread: Some(thread),
        }
    }

    /// Gives a command; it is carried out after those given before. False if the session's thread is gone.
    pub fn send(&mut self, command: Command) -> bool {
        self.sent += 1;
        let sender = self.commands.as_ref();
        sender.is_some_and(|commands| commands.send(command).is_ok())
    }

    /// What there is to see, as of a few milliseconds ago.
    #[must_use]
    pub fn latest(&self) -> Arc<Shown> {
        Arc::clone(&self.latest.lock().unwrap_or_else(PoisonError::into_inner))
    }

    /// Whether all commands given so far are done, with all they began, in what is shown.
    #[must_use]
    pub fn is_done(&self, shown: &Shown) -> bool {
        shown.commands == self.sent && !shown.busy
    }

    /// Whether the session's thread ended by itself, which it does not unless something is wrong.
    #[must_use]
    pub fn is_dead(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            // It panicked: its message was printed then.
            let _ = thread.join();
        }
    }
}

fn work(
    session: &mut Session,
    commands: &Receiver<Command>,
    by_clock: bool,
    mut publish: impl FnMut(&mut Session),
) {
    let mut clock = Clock::new();
    let mut published = Instant::now();
    let mut news = true;
    loop {
        let moving = session.owes() || by_clock && session.is_running();
        let patience = match (moving, session.is_busy()) {
            (true, _) => Duration::ZERO,
            (false, true) => Duration::from_millis(4),
            (false, false) => Duration::from_millis(30),
        };
        // A command waits for the steps of the one before it.
        if !session.owes() {
            match commands.recv_timeout(patience) {
                Ok(command) => {
                    // What went wrong is in what is shown.
                    let _ = session.begin(command);
                    news = true;
                }
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
        // How far a bake is, is news too.
        news |= session.poll() || session.is_busy();
        let began = Instant::now();
        while session.owes() && began.elapsed() < PATIENCE {
            let _ = session.take_owed_step();
            news = true;
        }
        let runs = by_clock && session.is_running() && !session.owes();
        news |= clock.run(session, runs);
        if news && (!moving || published.elapsed() >= FRAME || !session.is_busy()) {
            publish(session);
            published = Instant::now();
            news = false;
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
            std::thread::yield_now();
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
        if !any {
            std::thread::sleep(Duration::from_millis(2));
        }
        any
    }
}
