//! Plays the sound through the machine's loudspeaker or the browser's. On Linux this takes the feature `speaker`, which needs the headers of ALSA to
//! be built.

use std::num::NonZero;

use bevy::audio::{AddAudioSource, ChannelCount, Decodable, Sample, SampleRate, Source};
use bevy::prelude::*;
use bevy_frangible::Heard;
use bevy_frangible::frangible_sound::Outlet;

/// Samples that are taken from the queue at one time: 2.7 ms.
const CHUNK: usize = 256;

/// Plays the sound.
pub(crate) fn play(app: &mut App) {
    app.add_audio_source::<Queue>().add_systems(Startup, start);
}

fn start(heard: Res<Heard>, mut queues: ResMut<Assets<Queue>>, mut commands: Commands) {
    commands.spawn(AudioPlayer(queues.add(Queue(heard.outlet()))));
}

/// The queue of samples, as Bevy plays it.
#[derive(Asset, TypePath, Clone)]
struct Queue(Outlet);

/// The samples, one by one and for ever.
struct Samples {
    outlet: Outlet,
    chunk: [f32; CHUNK],
    next: usize,
}

impl Decodable for Queue {
    type Decoder = Samples;

    fn decoder(&self) -> Samples {
        Samples {
            outlet: self.0.clone(),
            chunk: [0.0; CHUNK],
            next: CHUNK,
        }
    }
}

impl Iterator for Samples {
    type Item = Sample;

    fn next(&mut self) -> Option<Sample> {
        if self.next == CHUNK {
            self.outlet.play(&mut self.chunk);
            self.next = 0;
        }
        self.next += 1;
        Some(self.chunk[self.next - 1])
    }
}

impl Source for Samples {
    fn current_span_len(&self) -> Option<usize> {
        None
    }

    fn channels(&self) -> ChannelCount {
        const { NonZero::new(2).unwrap() }
    }

    fn sample_rate(&self) -> SampleRate {
        NonZero::new(self.outlet.rate() as u32).unwrap_or(NonZero::<u32>::MIN)
    }

    fn total_duration(&self) -> Option<std::time::Duration> {
        None
    }
}
