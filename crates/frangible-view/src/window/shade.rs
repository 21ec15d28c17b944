//! The floor's shadow, computed on a thread of its own: roughly while things move, finely when they rest.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::{Duration, Instant};

use frangible_draw::{LiveShadow, Place, ShadowCaster};
use frangible_export::SurfaceMaterial;

use crate::picture::{BatchLooks, Picture};

/// How long a picture must stand before its shadow is computed finely.
const REST: Duration = Duration::from_millis(250);

/// A shadow to be cast.
struct Wish {
    picture: Arc<Picture>,
    place: Place,
    fine: bool,
}

/// A shadow cast: of which picture, and how.
struct Cast {
    version: u64,
    fine: bool,
    shadow: Option<Arc<LiveShadow>>,
}

/// Casts one shadow after the other.
pub(super) struct Shade {
    wishes: Sender<Wish>,
    casts: Receiver<Cast>,
    place: Option<Place>,
    waiting: bool,
    seen: (u64, Instant),
    latest: Option<Cast>,
    /// How many there were.
    count: u64,
}

impl Shade {
    pub(super) fn start() -> Self {
        let (wishes, wished) = channel::<Wish>();
        let (done, casts) = channel();
        std::thread::spawn(move || {
            for wish in wished {
                if done.send(cast(&wish)).is_err() {
                    return;
                }
            }
        });
        Self {
            wishes,
            casts,
            place: None,
            waiting: false,
            seen: (0, Instant::now()),
            latest: None,
            count: 0,
        }
    }

    /// The stage has other units from now on.
    pub(super) fn set_place(&mut self, place: Place) {
        self.place = Some(place);
        self.latest = None;
        self.seen = (0, Instant::now());
    }

    /// Has this picture's shadow cast, unless that is done.
    pub(super) fn want(&mut self, picture: &Arc<Picture>) {
        while let Ok(cast) = self.casts.try_recv() {
            self.waiting = false;
            self.count += 1;
            self.latest = Some(cast);
        }
        if self.seen.0 != picture.version {
            self.seen = (picture.version, Instant::now());
        }
        let fine = self.seen.1.elapsed() > REST;
        let known = self.latest.as_ref();
        let have = known.is_some_and(|c| c.version == picture.version && (c.fine || !fine));
        let Some(place) = self.place.filter(|_| !self.waiting && !have) else {
            return;
        };
        let wish = Wish {
            picture: Arc::clone(picture),
            place,
            fine,
        };
        self.waiting = self.wishes.send(wish).is_ok();
    }

    /// The last shadow, and its number.
    pub(super) fn latest(&self) -> Option<(u64, Option<Arc<LiveShadow>>)> {
        let cast = self.latest.as_ref()?;
        Some((self.count, cast.shadow.clone()))
    }

    /// Whether the shadow of this picture is there as good as it gets.
    pub(super) fn is_fine(&self, version: u64) -> bool {
        let latest = self.latest.as_ref();
        latest.is_some_and(|cast| cast.version == version && cast.fine)
    }
}

fn cast(wish: &Wish) -> Cast {
    let opaque = SurfaceMaterial::default();
    let casters: Vec<ShadowCaster<'_>> = wish
        .picture
        .batches
        .iter()
        .filter(|batch| !matches!(batch.looks, BatchLooks::Edges(_)))
        .map(|batch| ShadowCaster {
            surface: match &batch.looks {
                BatchLooks::Surface(surface) => surface,
                BatchLooks::Values | BatchLooks::Edges(_) => &opaque,
            },
            positions: &batch.positions,
            faces: &batch.faces,
        })
        .collect();
    let floor = wish.picture.floor.as_ref();
    Cast {
        version: wish.picture.version,
        fine: wish.fine,
        shadow: floor
            .map(|floor| Arc::new(LiveShadow::cast(wish.place, &casters, floor, wish.fine))),
    }
}
