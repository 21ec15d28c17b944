//! The shadow on the floor, computed on a separate thread or incrementally per frame: coarse while objects move, fine at rest.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Duration;

use web_time::Instant;

use frangible_draw::{LiveCasting, LiveShadow, Place, ShadowCaster};
use frangible_recording::SurfaceMaterial;

use crate::picture::{BatchLooks, Picture};

/// Time that a picture must stand before its shadow is computed finely.
const REST: Duration = Duration::from_millis(250);

/// Time per frame for computing a shadow where there is no other thread.
const SHARE: Duration = Duration::from_millis(5);

/// A shadow to be cast.
struct Wish {
    picture: Arc<Picture>,
    place: Place,
    fine: bool,
}

/// A shadow that was cast, with its picture and fineness.
struct Cast {
    version: u64,
    fine: bool,
    shadow: Option<Arc<LiveShadow>>,
}

/// The thread that casts shadows, or this one.
enum Caster {
    Thread {
        wishes: Sender<Wish>,
        casts: Receiver<Cast>,
    },
    Here(Option<Begun>),
}

/// A shadow that was begun here; none without a floor.
struct Begun {
    version: u64,
    fine: bool,
    casting: Option<LiveCasting>,
}

/// Casts one shadow after the other.
pub(super) struct Shade {
    caster: Caster,
    place: Option<Place>,
    waiting: bool,
    seen: (u64, Instant),
    latest: Option<Cast>,
    /// Number of shadows so far.
    count: u64,
}

impl Shade {
    /// Starts on a thread of its own, or `here`: a little of a shadow each time that one is wanted.
    pub(super) fn start(here: bool) -> Self {
        if here {
            return Self::by(Caster::Here(None));
        }
        let (wishes, wished) = channel::<Wish>();
        let (done, casts) = channel();
        std::thread::spawn(move || {
            for wish in wished {
                if done.send(cast(&wish)).is_err() {
                    return;
                }
            }
        });
        Self::by(Caster::Thread { wishes, casts })
    }

    fn by(caster: Caster) -> Self {
        Self {
            caster,
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
        while let Some(cast) = self.caster.next() {
            self.waiting = false;
            self.count += 1;
            self.latest = Some(cast);
        }
        if self.seen.0 != picture.version {
            self.seen = (picture.version, Instant::now());
            if self.caster.give_up_fine() {
                self.waiting = false;
            }
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
        self.waiting = self.caster.begin(wish);
    }

    /// The last shadow, and its number.
    pub(super) fn latest(&self) -> Option<(u64, Option<Arc<LiveShadow>>)> {
        let cast = self.latest.as_ref()?;
        Some((self.count, cast.shadow.clone()))
    }

    /// Returns true if the fine shadow of this picture is there.
    pub(super) fn is_fine(&self, version: u64) -> bool {
        let latest = self.latest.as_ref();
        latest.is_some_and(|cast| cast.version == version && cast.fine)
    }
}

impl Caster {
    /// Has a shadow cast; false if nobody does it any more.
    fn begin(&mut self, wish: Wish) -> bool {
        match self {
            Self::Thread { wishes, .. } => wishes.send(wish).is_ok(),
            Self::Here(begun) => {
                *begun = Some(Begun {
                    version: wish.picture.version,
                    fine: wish.fine,
                    casting: begin(&wish),
                });
                true
            }
        }
    }

    /// The next shadow that is done.
    fn next(&mut self) -> Option<Cast> {
        let begun = match self {
            Self::Thread { casts, .. } => return casts.try_recv().ok(),
            Self::Here(begun) => begun,
        };
        let started = Instant::now();
        if let Some(casting) = &mut begun.as_mut()?.casting {
            while casting.go_on() {
                if started.elapsed() > SHARE {
                    return None;
                }
            }
        }
        let Begun {
            version,
            fine,
            casting,
        } = begun.take()?;
        Some(Cast {
            version,
            fine,
            shadow: casting.map(|casting| Arc::new(casting.finish())),
        })
    }

    /// Gives up a fine shadow that was begun here; true if there was one. It would be late, and keep rough ones waiting.
    fn give_up_fine(&mut self) -> bool {
        match self {
            Self::Here(begun) => begun.take_if(|begun| begun.fine).is_some(),
            Self::Thread { .. } => false,
        }
    }
}

fn cast(wish: &Wish) -> Cast {
    Cast {
        version: wish.picture.version,
        fine: wish.fine,
        shadow: begin(wish).map(|casting| Arc::new(casting.finish())),
    }
}

/// None without a floor.
fn begin(wish: &Wish) -> Option<LiveCasting> {
    let floor = wish.picture.floor.as_ref()?;
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
    Some(LiveCasting::begin(wish.place, &casters, floor, wish.fine))
}
