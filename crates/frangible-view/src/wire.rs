//! State of a session as bytes, for a window that shares no memory with it: on a page the session runs in a worker of the browser.
//!
//! Numbers are little-endian and lists begin with their length. Both ends are built from the same sources, so the bytes have no version and are never
//! stored. Triangles that the window has already are not sent again: both ends remember the last picture, and a part of it is named by its place
//! there.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible_rapier::{LoadCounts, StepTimings};
use frangible_recording::{Floor, Grain, SurfaceMaterial, View};

use crate::command::{BallSpec, HammerSpec, Mark, Subject, Tool};
use crate::numbers::{BlowNumbers, ComparedNumbers, Course, KnobValues, Series};
use crate::parse::words::{MARKS, SUBJECTS, TOOLS};
use crate::picture::{Batch, BatchLooks, Dot, Label, Line, Picture};
use crate::shown::{BakeShown, Focus, Selection, Shown};
use crate::times::Spread;

/// Packs the state of a session into bytes.
#[derive(Debug, Default)]
pub struct Packer {
    picture: Arc<Picture>,
    course: Option<Arc<Course>>,
}

/// Unpacks the state of a session from the bytes of one [`Packer`], all of them and in their order.
#[derive(Debug, Default)]
pub struct Unpacker {
    picture: Arc<Picture>,
    course: Option<Arc<Course>>,
}

impl Packer {
    /// Packs the state into bytes.
    #[must_use]
    pub fn pack(&mut self, shown: &Shown) -> Vec<u8> {
        let mut out = Vec::new();
        shown.write(&mut out);
        let same = |a: &Arc<Course>, b: &Arc<Course>| Arc::ptr_eq(a, b);
        let known = match (&shown.course, &self.course) {
            (Some(now), Some(before)) => same(now, before),
            (now, before) => now.is_none() && before.is_none(),
        };
        (!known).write(&mut out);
        if !known {
            shown.course.write(&mut out);
            self.course.clone_from(&shown.course);
        }
        let known = Arc::ptr_eq(&shown.picture, &self.picture);
        (!known).write(&mut out);
        if !known {
            write_picture(&shown.picture, &self.picture, &mut out);
            self.picture = Arc::clone(&shown.picture);
        }
        out
    }
}

impl Unpacker {
    /// Unpacks a session's state. None if the bytes are not those that were packed next.
    #[must_use]
    pub fn unpack(&mut self, bytes: &[u8]) -> Option<Shown> {
        let mut from = Bytes(bytes);
        let mut shown = Shown::read(&mut from)?;
        if bool::read(&mut from)? {
            self.course = Wire::read(&mut from)?;
        }
        shown.course.clone_from(&self.course);
        if bool::read(&mut from)? {
            self.picture = Arc::new(read_picture(&self.picture, &mut from)?);
        }
        shown.picture = Arc::clone(&self.picture);
        from.0.is_empty().then_some(shown)
    }
}

/// Bytes that are still to be read.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*first)
    }
}

/// Something that has bytes.
trait Wire: Sized {
    fn write(&self, out: &mut Vec<u8>);

    fn read(from: &mut Bytes<'_>) -> Option<Self>;
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Wire for $number {
            fn write(&self, out: &mut Vec<u8>) {
                out.extend_from_slice(&self.to_le_bytes());
            }

            fn read(from: &mut Bytes<'_>) -> Option<Self> {
                from.array().map(Self::from_le_bytes)
            }
        }
    )*};
}

numbers!(u8, u32, u64, f32, f64);

impl Wire for usize {
    fn write(&self, out: &mut Vec<u8>) {
        (*self as u64).write(out);
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        u64::read(from)?.try_into().ok()
    }
}

impl Wire for bool {
    fn write(&self, out: &mut Vec<u8>) {
        u8::from(*self).write(out);
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        u8::read(from).map(|byte| byte != 0)
    }
}

impl Wire for String {
    fn write(&self, out: &mut Vec<u8>) {
        self.len().write(out);
        out.extend_from_slice(self.as_bytes());
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        let length = usize::read(from)?;
        let (text, rest) = from.0.split_at_checked(length)?;
        from.0 = rest;
        Self::from_utf8(text.to_vec()).ok()
    }
}

impl Wire for Vec3 {
    fn write(&self, out: &mut Vec<u8>) {
        self.to_array().write(out);
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        <[f32; 3]>::read(from).map(Self::from_array)
    }
}

impl<T: Wire> Wire for Option<T> {
    fn write(&self, out: &mut Vec<u8>) {
        self.is_some().write(out);
        self.iter().for_each(|value| value.write(out));
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        Some(match bool::read(from)? {
            true => Some(T::read(from)?),
            false => None,
        })
    }
}

impl<T: Wire> Wire for Vec<T> {
    fn write(&self, out: &mut Vec<u8>) {
        self.len().write(out);
        self.iter().for_each(|value| value.write(out));
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        let length = usize::read(from)?;
        // Everything in a list has a byte at least.
        let mut values = Self::with_capacity(length.min(from.0.len()));
        for _ in 0..length {
            values.push(T::read(from)?);
        }
        Some(values)
    }
}

impl<T: Wire + Default, const N: usize> Wire for [T; N] {
    fn write(&self, out: &mut Vec<u8>) {
        self.iter().for_each(|value| value.write(out));
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        let mut values = std::array::from_fn(|_| T::default());
        for value in &mut values {
            *value = T::read(from)?;
        }
        Some(values)
    }
}

impl<A: Wire, B: Wire> Wire for (A, B) {
    fn write(&self, out: &mut Vec<u8>) {
        self.0.write(out);
        self.1.write(out);
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        Some((A::read(from)?, B::read(from)?))
    }
}

impl<A: Wire, B: Wire, C: Wire> Wire for (A, B, C) {
    fn write(&self, out: &mut Vec<u8>) {
        self.0.write(out);
        self.1.write(out);
        self.2.write(out);
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        Some((A::read(from)?, B::read(from)?, C::read(from)?))
    }
}

impl<T: Wire> Wire for Arc<T> {
    fn write(&self, out: &mut Vec<u8>) {
        (**self).write(out);
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        T::read(from).map(Self::new)
    }
}

/// One of a list, by its place there.
macro_rules! choices {
    ($($choice:ty: $list:expr;)*) => {$(
        impl Wire for $choice {
            fn write(&self, out: &mut Vec<u8>) {
                let place = $list.iter().position(|choice| choice == self);
                place.unwrap_or_default().write(out);
            }

            fn read(from: &mut Bytes<'_>) -> Option<Self> {
                $list.get(usize::read(from)?).copied()
            }
        }
    )*};
}

/// All grains.
const GRAINS: [Grain; 7] = [
    Grain::Even,
    Grain::Clay,
    Grain::Aggregate,
    Grain::Veined,
    Grain::Cloudy,
    Grain::Broken,
    Grain::Marked,
];

choices! {
    Grain: GRAINS;
    Subject: SUBJECTS.map(|(_, subject)| subject);
    Mark: MARKS.map(|(_, mark)| mark);
    Tool: TOOLS.map(|(_, tool)| tool);
}

/// A struct, field by field. Those that are not named keep their default.
macro_rules! fields {
    ($($name:ty { $($field:ident),* $(,)? })*) => {$(
        impl Wire for $name {
            fn write(&self, out: &mut Vec<u8>) {
                $(self.$field.write(out);)*
            }

            fn read(from: &mut Bytes<'_>) -> Option<Self> {
                let mut value = Self::default();
                $(value.$field = Wire::read(from)?;)*
                Some(value)
            }
        }
    )*};
}

fields! {
    // The course and the picture go by themselves.
    Shown {
        commands, busy, scene, summary, starts, home, focus, time, steps, paused, slow_motion, sound, whole, pieces, fingerprint,
        undoable, ball, hammer, tool, bake, filming, reel, analysing, message, subject, scrub, exaggeration, explode, marks, mode, blow, largest_color,
        selection, compared, knobs, turned, contacts, break_step, publishing,
    }
    View { eye, target, up, vertical_fov }
    Focus { number, on }
    BallSpec { mass, radius, speed, material }
    HammerSpec { mass, speed, material }
    BakeShown { what, share }
    Selection { name, mass, volume, size, speed }
    BlowNumbers {
        name, time, broke, pieces, masses, point, impulse, speed, contact_duration, most_excited_frequency, strength, stress_bound,
        peak_stress, cracks, crack_area, first_crack_time, approach_energy, peak_strain_energy, fracture_energy, energy_paid, seconds,
        tetrahedra,
    }
    Series { name, points }
    Course { force, modes, tension, strength, peak_tension, cracks, cracking, duration, swings }
    ComparedNumbers { blows, differences }
    KnobValues { materials, values }
    LoadCounts { asked, contacts, by_impulses, by_amplitudes, by_clusters, by_stresses, broke }
    StepTimings { rigid, undone, copies, contacts, fracture, fragments, loads, upkeep }
    Spread { count, median, p99 }
    Floor { height, base_color }
    Line { ends, color, width }
    Dot { at, color, size }
    Label { at, text }
    SurfaceMaterial {
        name, base_color, metallic, roughness, transmission, ior, double_sided, attenuation_color, attenuation_distance, thin, grain,
        emission, ends_inside,
    }
}

impl Wire for BatchLooks {
    fn write(&self, out: &mut Vec<u8>) {
        match self {
            Self::Surface(surface) => {
                0_u8.write(out);
                surface.write(out);
            }
            Self::Values => 1_u8.write(out),
            Self::Edges(color) => {
                2_u8.write(out);
                color.write(out);
            }
        }
    }

    fn read(from: &mut Bytes<'_>) -> Option<Self> {
        Some(match u8::read(from)? {
            0 => Self::Surface(Wire::read(from)?),
            1 => Self::Values,
            2 => Self::Edges(Wire::read(from)?),
            _ => return None,
        })
    }
}

/// Writes a picture; a part that the previous one has too is named by its place there.
fn write_picture(picture: &Picture, before: &Picture, out: &mut Vec<u8>) {
    picture.version.write(out);
    picture.batches.len().write(out);
    for batch in &picture.batches {
        let same = before.batches.iter().position(|b| Arc::ptr_eq(b, batch));
        same.write(out);
        if same.is_some() {
            continue;
        }
        let shared = |b: &Arc<Batch>| Arc::ptr_eq(&b.faces, &batch.faces);
        let faces = before.batches.iter().position(shared);
        faces.write(out);
        if faces.is_none() {
            batch.faces.write(out);
        }
        batch.looks.write(out);
        batch.positions.write(out);
        batch.normals.write(out);
        batch.values.write(out);
        batch.stamp.write(out);
    }
    picture.lines.write(out);
    picture.dots.write(out);
    picture.labels.write(out);
    picture.floor.write(out);
    picture.wireframe.write(out);
}

fn read_picture(before: &Picture, from: &mut Bytes<'_>) -> Option<Picture> {
    let version = Wire::read(from)?;
    let mut batches = Vec::new();
    for _ in 0..usize::read(from)? {
        if let Some(same) = Option::<usize>::read(from)? {
            batches.push(Arc::clone(before.batches.get(same)?));
            continue;
        }
        let faces = match Option::<usize>::read(from)? {
            Some(shared) => Arc::clone(&before.batches.get(shared)?.faces),
            None => Wire::read(from)?,
        };
        batches.push(Arc::new(Batch {
            faces,
            looks: Wire::read(from)?,
            positions: Wire::read(from)?,
            normals: Wire::read(from)?,
            values: Wire::read(from)?,
            stamp: Wire::read(from)?,
        }));
    }
    Some(Picture {
        version,
        batches,
        lines: Wire::read(from)?,
        dots: Wire::read(from)?,
        labels: Wire::read(from)?,
        floor: Wire::read(from)?,
        wireframe: Wire::read(from)?,
    })
}
