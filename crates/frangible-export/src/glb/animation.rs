//! Poses and visibility as key frames.

use std::collections::BTreeMap;

use glam::Quat;
use gltf_json as json;
use json::animation::{Channel, Interpolation, Property, Sampler, Target};
use json::validation::Checked::Valid;

use super::binary::push_rows;
use frangible_recording::{RecordedNode, Recording};

/// Collects the channels of the one animation. Tracks with the same key frames
/// share the accessor of their times.
struct Tracks<'a> {
    root: &'a mut json::Root,
    binary: &'a mut Vec<u8>,
    frame_rate: f32,
    times: BTreeMap<Vec<usize>, json::Index<json::Accessor>>,
    channels: Vec<Channel>,
    samplers: Vec<Sampler>,
}

/// Adds the animation `break`, unless nothing moves, appears or vanishes.
pub(super) fn push_animation(root: &mut json::Root, binary: &mut Vec<u8>, recording: &Recording) {
    let mut tracks = Tracks {
        root,
        binary,
        frame_rate: recording.frame_rate,
        times: BTreeMap::new(),
        channels: Vec::new(),
        samplers: Vec::new(),
    };
    for (index, node) in recording.nodes.iter().enumerate() {
        push_motion(&mut tracks, index, node);
        push_visibility(&mut tracks, index, node, recording.frame_count);
    }
    let Tracks {
        root,
        channels,
        samplers,
        ..
    } = tracks;
    if !channels.is_empty() {
        root.push(json::Animation {
            extensions: None,
            extras: None,
            channels,
            name: Some("break".into()),
            samplers,
        });
    }
}

/// Translation and rotation, over the frames in which the node can be seen.
fn push_motion(tracks: &mut Tracks<'_>, index: usize, node: &RecordedNode) {
    if node.poses.len() < 2 {
        return;
    }
    let first = node.visible.start;
    let poses = &node.poses[node.visible.clone()];
    let translations: Vec<_> = poses
        .iter()
        .map(|pose| pose.translation.to_array())
        .collect();
    let mut previous: Option<Quat> = None;
    let rotations: Vec<_> = poses
        .iter()
        .map(|pose| {
            // q and −q are the same rotation, but halfway between them lies
            // nonsense: keep to the side of the frame before.
            let unit = pose.rotation.normalize();
            let near = previous.is_none_or(|previous| previous.dot(unit) >= 0.0);
            let unit = if near { unit } else { -unit };
            previous = Some(unit);
            unit.to_array()
        })
        .collect();
    tracks.push_linear(index, Property::Translation, first, &translations);
    tracks.push_linear(index, Property::Rotation, first, &rotations);
}

/// Scale 1 while the node is visible, 0 before and after.
fn push_visibility(tracks: &mut Tracks<'_>, index: usize, node: &RecordedNode, frames: usize) {
    let seen = &node.visible;
    if seen.is_empty() || *seen == (0..frames) {
        return;
    }
    let mut keys = vec![(0, f32::from(u8::from(seen.start == 0)))];
    if seen.start > 0 {
        keys.push((seen.start, 1.0));
    }
    if seen.end < frames {
        keys.push((seen.end, 0.0));
    }
    let frames = keys.iter().map(|key| key.0).collect();
    let scales: Vec<_> = keys.iter().map(|key| [key.1; 3]).collect();
    tracks.push(index, Property::Scale, Interpolation::Step, frames, &scales);
}

impl Tracks<'_> {
    /// A track without the key frames that change nothing: of a run of equal
    /// values only the two ends stay, and a constant needs no track at all.
    fn push_linear<const WIDTH: usize>(
        &mut self,
        node: usize,
        property: Property,
        first_frame: usize,
        values: &[[f32; WIDTH]],
    ) {
        if values.windows(2).all(|pair| pair[0] == pair[1]) {
            return;
        }
        let moves = |i: usize| i + 1 == values.len() || values[i] != values[i + 1];
        let kept: Vec<usize> = (0..values.len())
            .filter(|&i| i == 0 || moves(i - 1) || moves(i))
            .collect();
        let rows: Vec<_> = kept.iter().map(|&i| values[i]).collect();
        let frames = kept.iter().map(|i| first_frame + i).collect();
        self.push(node, property, Interpolation::Linear, frames, &rows);
    }

    fn push<const WIDTH: usize>(
        &mut self,
        node: usize,
        property: Property,
        interpolation: Interpolation,
        frames: Vec<usize>,
        values: &[[f32; WIDTH]],
    ) {
        let input = self.push_times(frames);
        let output = push_rows(self.root, self.binary, values, None, false);
        let sampler = json::Index::new(self.samplers.len() as u32);
        self.samplers.push(Sampler {
            extensions: None,
            extras: None,
            input,
            interpolation: Valid(interpolation),
            output,
        });
        self.channels.push(Channel {
            sampler,
            target: Target {
                extensions: None,
                extras: None,
                node: json::Index::new(node as u32),
                path: Valid(property),
            },
            extensions: None,
            extras: None,
        });
    }

    fn push_times(&mut self, frames: Vec<usize>) -> json::Index<json::Accessor> {
        if let Some(&known) = self.times.get(&frames) {
            return known;
        }
        let rate = f64::from(self.frame_rate);
        let seconds: Vec<_> = frames
            .iter()
            .map(|&frame| [(frame as f64 / rate) as f32])
            .collect();
        let times = push_rows(self.root, self.binary, &seconds, None, true);
        self.times.insert(frames, times);
        times
    }
}
