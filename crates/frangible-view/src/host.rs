//! Substitute for the disk and for threads on a page in a browser, which has neither.

use std::path::Path;
use std::sync::mpsc::Sender;

use frangible_scenes::{BakedBody, Scene, SceneError};

use crate::error::ViewError;
use crate::jobs::Teller;

/// Has scenes and files, brings baked bodies and takes files.
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

/// Receives the bodies that were asked for.
pub struct Delivery {
    pub(crate) teller: Teller,
    pub(crate) sender: Sender<Result<Vec<BakedBody>, SceneError>>,
}

impl Delivery {
    /// Reports the current stage, and the share of it that is done.
    pub fn tell(&self, what: &str, share: f64) {
        self.teller.tell(what.into(), share);
    }

    /// Returns true if nobody waits for it any more.
    #[must_use]
    pub fn is_unwanted(&self) -> bool {
        self.teller.cancel.is_cancelled()
    }

    /// Hands the bodies in, one per body of the scene, in their order.
    pub fn finish(self, bodies: Result<Vec<BakedBody>, SceneError>) {
        // Nobody waits for a cancelled delivery.
        let _ = self.sender.send(bodies);
    }
}
