//! A session on the owner's thread.

use std::collections::VecDeque;
use std::sync::Arc;

use frangible_sound::Outlet;

use super::Place;
use super::work::Work;
use crate::command::Command;
use crate::host::Host;
use crate::session::Session;
use crate::shown::Shown;

pub(super) struct Here {
    work: Work,
    commands: VecDeque<Command>,
    latest: Arc<Shown>,
}

impl Here {
    pub(super) fn start(by_clock: bool, host: Box<dyn Host>, outlet: Option<Outlet>) -> Self {
        Self {
            work: Work::new(Session::in_host(host), by_clock, outlet),
            commands: VecDeque::new(),
            latest: Arc::default(),
        }
    }
}

impl Place for Here {
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

    fn send(&mut self, command: Command) -> bool {
        self.commands.push_back(command);
        true
    }

    fn latest(&self) -> Arc<Shown> {
        Arc::clone(&self.latest)
    }
}
