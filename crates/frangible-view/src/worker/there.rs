//! A session in another program, which sends its state as bytes.

use std::sync::Arc;

use super::Place;
use crate::command::Command;
use crate::shown::Shown;
use crate::wire::Unpacker;

/// A program that runs a session, without shared memory.
pub trait Remote {
    /// Gives it a command.
    fn give(&mut self, line: String);

    /// Bytes that its [`Packer`](crate::Packer) made since the last call, oldest first.
    fn news(&mut self) -> Vec<Vec<u8>>;
}

pub(super) struct There {
    remote: Box<dyn Remote>,
    unpacker: Unpacker,
    latest: Arc<Shown>,
    /// True if it sent bytes that cannot be decoded.
    broken: bool,
}

impl There {
    pub(super) fn start(remote: Box<dyn Remote>) -> Self {
        Self {
            remote,
            unpacker: Unpacker::default(),
            latest: Arc::default(),
            broken: false,
        }
    }
}

impl Place for There {
    fn advance(&mut self) {
        for bytes in self.remote.news() {
            match self.unpacker.unpack(&bytes) {
                Some(shown) => self.latest = Arc::new(shown),
                None => self.broken = true,
            }
        }
    }

    fn send(&mut self, command: Command) -> bool {
        self.remote.give(command.to_string());
        !self.broken
    }

    fn latest(&self) -> Arc<Shown> {
        Arc::clone(&self.latest)
    }

    fn is_dead(&self) -> bool {
        self.broken
    }
}
