//! A session on its own thread.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use frangible_sound::Outlet;

use super::Place;
use super::work::Work;
use crate::command::Command;
use crate::session::Session;
use crate::shown::Shown;

/// Longest time between two published states, while something moves.
const FRAME: Duration = Duration::from_millis(16);

/// A session's thread, which ends when this is dropped.
pub(super) struct OnThread {
    commands: Option<Sender<Command>>,
    latest: Arc<Mutex<Arc<Shown>>>,
    thread: Option<JoinHandle<()>>,
}

impl OnThread {
    pub(super) fn start(by_clock: bool, outlet: Option<Outlet>) -> Self {
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
            commands: Some(commands),
            latest,
            thread: Some(thread),
        }
    }
}

impl Place for OnThread {
    fn send(&mut self, command: Command) -> bool {
        let sender = self.commands.as_ref();
        sender.is_some_and(|commands| commands.send(command).is_ok())
    }

    fn latest(&self) -> Arc<Shown> {
        Arc::clone(&self.latest.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn is_dead(&self) -> bool {
        self.thread.as_ref().is_none_or(JoinHandle::is_finished)
    }
}

impl Drop for OnThread {
    fn drop(&mut self) {
        self.commands = None;
        if let Some(thread) = self.thread.take() {
            // It panicked: its message was printed then.
            let _ = thread.join();
        }
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
