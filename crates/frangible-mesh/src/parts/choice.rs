//! Which parts become bodies.

use thiserror::Error;

use super::gaps::{Gap, Outline, narrowest, unbridged};
use super::words;
use super::{Part, Parts};
use crate::InputMesh;

/// A part below this share of the volume of all is left out unless something else is asked for.
const LEAST_SHARE: f64 = 0.01;

/// A part of at least this share of the largest is never left out, so that many equal ones stay.
const LIKE_THE_LARGEST: f64 = 0.5;

/// Volumes that differ by a smaller share are the same.
const SAME_VOLUME: f64 = 1e-9;

/// Most bodies of one mesh.
const MOST_BODIES: usize = 100;

/// Gap, as a share of the bounding box's diagonal, up to which bodies touch.
const TOUCH: f64 = 1e-4;

/// What to make of the parts of a surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum PartChoice {
    /// A body of each part of at least 1 % of the volume; layers that share faces are one body. The default.
    #[default]
    Auto,
    /// A body of each part of at least 1 % of the volume, also of each layer.
    Separate,
    /// The largest body alone.
    Largest,
    /// One body of all parts, across gaps of up to this width, m; without a width, of parts that touch.
    Weld {
        /// Widest gap that is bridged, m.
        gap: Option<f64>,
    },
    /// The body of this name alone.
    Only(String),
}

/// Error of choosing parts. Lengths are in metres, as the mesh should be.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum PartError {
    /// More bodies than a scene has.
    #[error(
        "the surface has {count} separate parts, more than the {MOST_BODIES} bodies of a scene; choose `largest` to keep the largest, or `weld` to join them"
    )]
    TooMany {
        /// Number of parts that would become bodies.
        count: usize,
    },
    /// No part of that name.
    #[error("the surface has no part `{name}`; its parts: {known}")]
    Unknown {
        /// Requested name.
        name: String,
        /// The names of all parts.
        known: String,
    },
    /// Parts that stand farther apart than is bridged.
    #[error(
        "`{one}` and `{other}` are {} apart, more than the gap of {} that is welded; raise the gap to {:.4} m, or keep the parts separate",
        words::length(*width), words::length(*gap), words::up(*width)
    )]
    Apart {
        /// Name of one part.
        one: String,
        /// Name of the other.
        other: String,
        /// Distance, m.
        width: f64,
        /// Widest gap that is bridged, m.
        gap: f64,
    },
    /// A gap that is no length.
    #[error("the gap that is welded is {0} m; it must be a finite length of 0 or more")]
    Gap(f64),
}

/// A body made of parts.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ChosenBody {
    /// Name, different from those of the other bodies; empty where the surface has only one part.
    pub name: String,
    /// Numbers of its parts.
    pub parts: Vec<usize>,
    /// Volume, in the cube of the mesh's unit.
    pub volume: f64,
    /// True if the volume is exact: its shells are closed and do not overlap.
    pub is_exact: bool,
}

/// The bodies chosen from a surface.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ChosenParts {
    /// The bodies, in the order of the file; at least one.
    pub bodies: Vec<ChosenBody>,
    /// Gap that is bridged in the only body, m.
    pub weld: Option<f64>,
    /// Number of parts that were left out.
    pub dropped: usize,
    /// Their share of the volume of all parts.
    pub dropped_share: f64,
    /// The narrowest gap between two of the bodies.
    pub gap: Option<Gap>,
    /// What was found and chosen, in one line; `None` for a surface of a single part.
    pub note: Option<String>,
}

impl Parts {
    /// Chooses the bodies.
    ///
    /// # Errors
    /// [`PartError`] for parts that are too many, too far apart, or of no such name.
    pub fn choose(&self, mesh: &InputMesh, choice: &PartChoice) -> Result<ChosenParts, PartError> {
        let all = match choice {
            PartChoice::Separate => self.each(),
            _ => self.joined(),
        };
        let total: f64 = all.iter().map(|body| body.volume).sum();
        let largest = all.iter().map(|body| body.volume).fold(0.0, f64::max);
        let mut chosen = ChosenParts {
            bodies: Vec::new(),
            weld: None,
            dropped: 0,
            dropped_share: 0.0,
            gap: None,
            note: None,
        };
        chosen.bodies = match choice {
            PartChoice::Auto | PartChoice::Separate => {
                let least = (LEAST_SHARE * total).min(LIKE_THE_LARGEST * largest);
                all.iter().filter(|b| b.volume >= least).cloned().collect()
            }
            PartChoice::Largest => {
                // The first of equal ones, whatever their rounding.
                let is_largest = |b: &&ChosenBody| b.volume >= largest * (1.0 - SAME_VOLUME);
                all.iter().find(is_largest).cloned().into_iter().collect()
            }
            PartChoice::Weld { gap } => {
                let width = self.bridged(mesh, &all, *gap)?;
                chosen.weld = Some(width).filter(|_| all.len() > 1);
                vec![self.body(String::new(), (0..self.list.len()).collect())]
            }
            PartChoice::Only(name) => {
                let mut known = all.clone();
                known.extend(self.each());
                let found = known.iter().find(|body| body.name == *name).cloned();
                vec![found.ok_or_else(|| PartError::Unknown {
                    name: name.clone(),
                    known: words::some_names(all.iter().map(|body| &*body.name), 20),
                })?]
            }
        };
        if chosen.bodies.len() > MOST_BODIES {
            return Err(PartError::TooMany {
                count: chosen.bodies.len(),
            });
        }
        let kept: f64 = chosen.bodies.iter().map(|body| body.volume).sum();
        if chosen.weld.is_none() {
            let used: usize = chosen.bodies.iter().map(|body| body.parts.len()).sum();
            chosen.dropped = self.list.len() - used.min(self.list.len());
            if total > 0.0 && chosen.dropped > 0 {
                chosen.dropped_share = (1.0 - kept / total).max(0.0);
            }
        }
        if chosen.bodies.len() > 1 {
            let outlines = self.outlines(mesh, &chosen.bodies);
            let gaps = narrowest(&outlines).into_iter();
            chosen.gap = gaps.min_by(|a, b| a.width.total_cmp(&b.width));
        }
        chosen.note = words::note(self, choice, &chosen);
        Ok(chosen)
    }

    /// The gap to be bridged, if that makes one body of all.
    fn bridged(
        &self,
        mesh: &InputMesh,
        all: &[ChosenBody],
        gap: Option<f64>,
    ) -> Result<f64, PartError> {
        let nothing = [glam::DVec3::INFINITY, glam::DVec3::NEG_INFINITY];
        let [low, high] = self.list.iter().fold(nothing, |[low, high], part| {
            [low.min(part.bounds[0]), high.max(part.bounds[1])]
        });
        let width = gap.unwrap_or(TOUCH * (high - low).length());
        if !(width.is_finite() && width >= 0.0) {
            return Err(PartError::Gap(width));
        }
        if all.len() > MOST_BODIES {
            // Specks are as many as they like; those too far off are dropped by the mesher, and counted.
            return Ok(width);
        }
        let outlines = self.outlines(mesh, all);
        match unbridged(&outlines, width * (1.0 + 1e-6) + f64::MIN_POSITIVE) {
            None => Ok(width),
            Some(Gap {
                bodies: [one, other],
                width: found,
            }) => Err(PartError::Apart {
                one: all[one].name.clone(),
                other: all[other].name.clone(),
                width: found,
                gap: width,
            }),
        }
    }

    fn outlines(&self, mesh: &InputMesh, bodies: &[ChosenBody]) -> Vec<Outline> {
        let outline = |body: &ChosenBody| Outline::new(self, mesh, &body.parts);
        bodies.iter().map(outline).collect()
    }

    /// A body of each part.
    fn each(&self) -> Vec<ChosenBody> {
        let parts = self.list.iter().enumerate();
        parts
            .map(|(i, part)| self.body(part.name.clone(), vec![i]))
            .collect()
    }

    /// A body of each set of parts that share faces.
    fn joined(&self) -> Vec<ChosenBody> {
        let count = self.list.iter().map(|part| part.body as usize + 1).max();
        let mut members = vec![Vec::new(); count.unwrap_or(0)];
        for (i, part) in self.list.iter().enumerate() {
            members[part.body as usize].push(i);
        }
        members
            .into_iter()
            .map(|parts| {
                let names: Vec<&str> = parts.iter().map(|&p| &*self.list[p].name).collect();
                let name = match &names[..] {
                    [] => String::new(),
                    [only] => (*only).into(),
                    [one, two] => format!("{one} + {two}"),
                    [one, rest @ ..] => format!("{one} + {} more", rest.len()),
                };
                let is_all = parts.len() == self.list.len();
                self.body(if is_all { String::new() } else { name }, parts)
            })
            .collect()
    }

    fn body(&self, name: String, parts: Vec<usize>) -> ChosenBody {
        let of = |part: &usize| -> &Part { &self.list[*part] };
        ChosenBody {
            name,
            volume: parts.iter().map(|part| of(part).volume).sum(),
            is_exact: parts.iter().all(|part| of(part).is_exact),
            parts,
        }
    }
}
