//! Timing of a slow-motion film: normal speed up to the break, slow during it, and normal to the end.

use frangible_recording::{Recording, View};

/// Share of a film that passes before the first crack, at least: from the moment that the first view is of.
const BEFORE: f64 = 0.1;

/// Share of a film in which it is slow.
const SLOW: f64 = 0.55;

/// Seconds for which the last picture stands.
const END: f64 = 0.6;

/// Mapping from the time of a film to the frame and camera of a recording.
#[derive(Clone, Debug)]
pub struct SlowMotion<'a> {
    recording: &'a Recording,
    /// Times of the film, s, and frames of the recording, linear between them.
    knots: [[f64; 2]; 4],
}

impl<'a> SlowMotion<'a> {
    /// A film of `seconds`, slowed down by the factor `slow` around breaks.
    #[must_use]
    pub fn new(recording: &'a Recording, seconds: f64, slow: f64) -> Self {
        let rate = f64::from(recording.frame_rate);
        let moments = recording.moments;
        let (crack, end) = (moments.first_crack as f64, moments.at_rest as f64);
        let moving = (seconds - END).max(0.5 * seconds);
        let first = (moments.before as f64).min(crack);
        let before = ((crack - first) / rate).clamp(BEFORE * moving, 0.4 * moving);
        let slowly = SLOW * moving;
        let parted = (crack + slowly * rate / slow).min(end);
        Self {
            recording,
            knots: [
                [0.0, first],
                [before, crack],
                [before + slowly, parted],
                [moving, end.max(parted)],
            ],
        }
    }

    /// Frame of the recording at a time of the film, s; fractional values lie between two frames.
    #[must_use]
    pub fn frame(&self, time: f64) -> f64 {
        between(&self.knots, time)
    }

    /// Time at which the last picture is reached, s; the film stands still from then on.
    #[must_use]
    pub fn stands_from(&self) -> f64 {
        self.knots[3][0]
    }

    /// Camera at a frame, interpolated between the views of the moments.
    #[must_use]
    pub fn view(&self, frame: f64) -> View {
        let recording = self.recording;
        let Some(views) = recording.views else {
            return recording.camera;
        };
        let moments = recording.labelled_moments().map(|(frame, _)| frame as f64);
        let next = moments
            .partition_point(|&moment| moment <= frame)
            .clamp(1, 3);
        let [from, to] = [next - 1, next].map(|i| moments[i]);
        let share = ((frame - from) / (to - from).max(1e-9)).clamp(0.0, 1.0) as f32;
        // It starts and stops gently.
        let share = share * share * (3.0 - 2.0 * share);
        let [a, b] = [views[next - 1], views[next]];
        View {
            eye: a.eye.lerp(b.eye, share),
            target: a.target.lerp(b.target, share),
            up: a.up.lerp(b.up, share),
            vertical_fov: a.vertical_fov + (b.vertical_fov - a.vertical_fov) * share,
        }
    }
}

/// The value of a line through these points, which is level before the first and after the last.
fn between(knots: &[[f64; 2]], at: f64) -> f64 {
    let next = knots.partition_point(|knot| knot[0] <= at);
    match (next.checked_sub(1).map(|i| knots[i]), knots.get(next)) {
        (None, Some(first)) => first[1],
        (Some([from, a]), Some([to, b])) => a + (b - a) * (at - from) / (to - from),
        (Some([_, last]), None) => last,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use frangible_recording::Moments;
    use frangible_recording::glam::Vec3;

    use super::*;

    #[test]
    fn a_film_is_slow_where_things_break_and_ends_at_rest() {
        let recording = Recording {
            frame_rate: 60.0,
            frame_count: 400,
            moments: Moments {
                before: 50,
                first_crack: 60,
                just_after: 66,
                at_rest: 399,
                moves_on: false,
            },
            ..Recording::default()
        };
        let clock = SlowMotion::new(&recording, 6.0, 8.0);
        let frames: Vec<f64> = (0..120).map(|i| clock.frame(f64::from(i) / 20.0)).collect();
        assert!(frames.is_sorted());
        assert_eq!(frames[119], 399.0);
        assert_eq!(frames[0], 50.0);
        let at = frames.partition_point(|frame| *frame < 60.0);
        let step = frames[at + 2] - frames[at + 1];
        assert!((step - 60.0 / 8.0 / 20.0).abs() < 1e-9, "{step}");
        // A scene that is over before the film is slow for as long as it lasts.
        let short = SlowMotion::new(&recording, 6.0, 1.0);
        assert!((0..120).all(|i| short.frame(f64::from(i) / 20.0) <= 399.0));
    }

    #[test]
    fn the_camera_is_at_each_moment_where_its_view_is() {
        let view = |x: f32| View {
            eye: Vec3::X * x,
            ..View::default()
        };
        let recording = Recording {
            moments: Moments {
                before: 0,
                first_crack: 10,
                just_after: 10,
                at_rest: 30,
                moves_on: false,
            },
            views: Some([0.0, 1.0, 2.0, 3.0].map(view)),
            ..Recording::default()
        };
        let film = SlowMotion::new(&recording, 6.0, 8.0);
        let eye = |frame| film.view(frame).eye.x;
        assert_eq!(
            [eye(0.0), eye(5.0), eye(20.0), eye(30.0), eye(99.0)],
            [0.0, 0.5, 2.5, 3.0, 3.0]
        );
    }
}
