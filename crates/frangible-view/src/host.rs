//! Substitute for file access and threads in a browser.

use std::path::Path;
use std::sync::mpsc::Sender;

use frangible_scenes::{BakedBody, Scene, SceneError};

use crate::error::ViewError;
use crate::jobs::Teller;

/// Provides scenes, files and baked bodies, and stores written files.
pub trait Host {
    /// The scene of this name.
    ///
    /// # Errors
    /// There is no such scene; the message lists those that there are.
    fn scene(&self, name: &str) -> Result<Scene, ViewError>;

    /// The scene that a file stands for.
    ///
    /// # Errors
    /// There is no such file, or its contents cannot be broken.
    fn open(&self, path: &Path) -> Result<Scene, ViewError>;

    /// Has the bodies of a scene brought, ready-made or baked; it may be one of the host's scenes with knobs turned.
    fn bring(&self, scene: &Scene, delivery: Delivery);

    /// Takes a file.
    ///
    /// # Errors
    /// The file cannot be saved.
    fn save(&self, name: &Path, bytes: &[u8]) -> Result<(), ViewError>;
}

/// Receiver of the requested bodies.
pub struct Delivery {
    pub(crate) teller: Teller,
    pub(crate) sender: Sender<Result<Vec<BakedBody>, SceneError>>,
}

impl Delivery {
    /// Reports the current stage and its completed fraction.
    pub fn tell(&self, what: &str, share: f64) {
        self.teller.tell(what.into(), share);
    }

    /// Returns true if the result is no longer needed.
    #[must_use]
    pub fn is_unwanted(&self) -> bool {
        self.teller.cancel.is_cancelled()
    }

    /// Delivers the bodies, one per body of the scene, in the same order.
    pub fn finish(self, bodies: Result<Vec<BakedBody>, SceneError>) {
        // Nobody waits for a cancelled delivery.
        let _ = self.sender.send(bodies);
    }
}
