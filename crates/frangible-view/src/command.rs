//! Commands of the viewer.

use std::path::PathBuf;

use frangible::glam::Vec3;

use crate::error::{ViewError, within};

/// A command of the viewer, from mouse, keys, panels or scripts. [`Command::parse`] reads one, `to_string` writes it.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Load a built-in scene.
    Scene(String),
    /// Load a scene file, a mesh or a baked body.
    Open(PathBuf),
    /// Cancel the running bake.
    CancelBake,
    /// Restart the scene with the current knobs.
    Reset,
    /// Pause the simulation.
    Pause,
    /// Continue the simulation.
    Run,
    /// Take this many steps.
    Step(u32),
    /// Advance by this many frames of 1/60 s; a window draws each.
    Frames(u32),
    /// Speed of simulated time relative to real time, such as 1 or 0.001.
    SlowMotion(f64),
    /// Volume, a share of the loudspeaker's range, 0..=1.
    Volume(f64),
    /// Turn the sound on or off.
    Sound(bool),
    /// Set the ball that a click throws.
    Ball(BallSpec),
    /// Set the hammer that a click swings.
    Hammer(HammerSpec),
    /// Choose the tool that a click uses.
    Tool(Tool),
    /// Throw a ball from a point through another, m.
    Throw {
        /// Starting point.
        from: Vec3,
        /// Aim point of its centre.
        through: Vec3,
    },
    /// Swing the hammer at the object that a ray hits.
    Swing {
        /// Origin of the ray, m.
        from: Vec3,
        /// A point on the ray, m.
        through: Vec3,
    },
    /// Grab the object that a ray hits.
    Grab {
        /// Origin of the ray, m.
        from: Vec3,
        /// A point on the ray, m.
        through: Vec3,
    },
    /// Move the grabbed object to the point of this ray at the distance at which it was grabbed.
    Pull {
        /// Origin of the ray, m.
        from: Vec3,
        /// A point on the ray, m.
        through: Vec3,
    },
    /// Release the grabbed object with its velocity.
    LetGo,
    /// Restart the scene with its bodies dropped from this height, m.
    Drop(f64),
    /// Go back to just before the last break.
    Undo,
    /// Choose the displayed subject.
    Look(Subject),
    /// Choose a time of the contact, as a share of the motion's duration, 0..=1.
    Scrub(f64),
    /// Set the magnification of the displayed deformation.
    Exaggerate(f64),
    /// Set the spread of the drawn pieces, as a share of their distance from their parent's centre; 0 leaves them in place.
    Explode(f64),
    /// Show or hide a mark.
    Show(Mark, bool),
    /// Choose the displayed vibration mode, from 1.
    Mode(usize),
    /// Select the object that a ray hits, or nothing.
    Select {
        /// Origin of the ray, m.
        from: Vec3,
        /// A point on the ray, m.
        through: Vec3,
    },
    /// Set a knob to a value in its own unit.
    Knob(String, f64),
    /// Reset a knob.
    ResetKnob(String),
    /// Reset all knobs.
    ResetKnobs,
    /// Set the material of all bodies.
    Material(String),
    /// Repeat the last impact on the intact body with the current knobs, and show both outcomes side by side.
    HitAgain,
    /// Write a file.
    Save(Target, PathBuf),
    /// Draw a film of the last seconds off-screen, or path-trace a still, and write it.
    Film(FilmKind, PathBuf, FilmOptions),
    /// Cancel the film that is being made.
    CancelSave,
    /// Set the view of films and stills, and of a window's camera.
    LookFrom {
        /// Position of the camera, m.
        eye: Vec3,
        /// Target of the view, m.
        target: Vec3,
    },
    /// Write a picture of the window.
    Screenshot(PathBuf),
    /// Turn the camera, degrees to the right and up.
    Orbit(f32, f32),
    /// Move the view's target, shares of the picture's height to the right and up.
    Pan(f32, f32),
    /// Zoom in by this factor, or out if it is below 1.
    Zoom(f32),
    /// Reset the camera.
    Home,
    /// Throw or swing at this position of the window, as shares of its width and height from the upper left.
    Click(f32, f32),
    /// Select the object at this position of the window.
    Pick(f32, f32),
    /// Grab the object at this position of the window.
    GrabAt(f32, f32),
    /// Move the grabbed object to this position of the window.
    PullTo(f32, f32),
    /// Open or close a panel.
    Panel(String, bool),
    /// Choose the dark or light theme.
    Dark(bool),
    /// Close the window.
    Quit,
}

/// Subject of the display.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Subject {
    /// The scene.
    #[default]
    World,
    /// The body during the last contact, deformed and coloured by stress.
    Stress,
    /// The cracks of the last contact, and their growth.
    Cracks,
    /// A vibration mode of the body that was hit last.
    Modes,
    /// The last impact, and the same impact with the current knobs.
    Compare,
}

impl Subject {
    /// Returns true if the subject has moments.
    #[must_use]
    pub const fn has_moments(self) -> bool {
        matches!(self, Self::Stress | Self::Cracks | Self::Modes)
    }
}

/// Marks over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Edges instead of faces.
    Wireframe,
    /// Surface of the fracture mesh.
    FractureMesh,
    /// Surface of the analysis mesh.
    AnalysisMesh,
    /// Weak points, where cracks may start.
    WeakPoints,
    /// Starting points of cracks.
    Starts,
    /// Contact points and impulses.
    Impulse,
}

/// Files that can be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The scene with the current knobs, TOML.
    Scene,
    /// The current scene, GLB.
    Glb,
    /// All commands since the scene was loaded, as a script.
    Script,
    /// The numbers of the last contact, JSON.
    Report,
    /// Times of the last pictures, JSON.
    Times,
}

/// Kind of an off-screen drawing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmKind {
    /// The current scene, path-traced, PNG.
    Still,
    /// The last seconds, GIF.
    Gif,
    /// The last seconds, a folder of PNG.
    Frames,
    /// The last seconds, MP4; requires `ffmpeg`.
    Mp4,
}

/// Settings of a film.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmOptions {
    /// Length of the film in displayed time, s, up to now; at most 20.
    pub seconds: f64,
    /// Pictures per second, 1/s.
    pub rate: f64,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Paths per pixel of a still; noise falls with the square root of this number.
    pub samples: u32,
}

impl Default for FilmOptions {
    fn default() -> Self {
        Self {
            seconds: 3.0,
            rate: 20.0,
            size: [640, 400],
            samples: 64,
        }
    }
}

impl FilmOptions {
    /// Refuses settings that cannot be drawn, or would take for ever.
    pub(crate) fn check(&self) -> Result<(), ViewError> {
        let longest = crate::film::KEPT;
        within("the film's length", self.seconds, [0.01, longest], "s")?;
        within("the number of pictures", self.rate, [1.0, 60.0], "1/s")?;
        within(
            "the number of samples",
            f64::from(self.samples),
            [1.0, 65_536.0],
            "",
        )
    }
}

/// A ball to throw.
#[derive(Clone, Debug, PartialEq)]
pub struct BallSpec {
    /// Mass, kg.
    pub mass: f64,
    /// Radius, m.
    pub radius: f64,
    /// Speed, m/s.
    pub speed: f64,
    /// Material preset.
    pub material: String,
}

impl Default for BallSpec {
    /// The ball of the scene `pane`: steel, 250 g, 20 m/s.
    fn default() -> Self {
        Self {
            mass: 0.25,
            radius: 0.02,
            speed: 20.0,
            material: "steel".into(),
        }
    }
}

/// A hammer to swing.
#[derive(Clone, Debug, PartialEq)]
pub struct HammerSpec {
    /// Mass of its head, kg.
    pub mass: f64,
    /// Speed of its head where it strikes, m/s.
    pub speed: f64,
    /// Material preset.
    pub material: String,
}

impl Default for HammerSpec {
    /// The hammer of the scene `five-blows`: steel, 500 g, 7.5 m/s.
    fn default() -> Self {
        Self {
            mass: 0.5,
            speed: 7.5,
            material: "steel".into(),
        }
    }
}

/// Tool that a click uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Throws the ball.
    #[default]
    Ball,
    /// Swings the hammer.
    Hammer,
}

impl Command {
    /// Returns true if it changes the scene, so that a script must contain it to do the same again.
    pub(crate) fn is_deed(&self) -> bool {
        matches!(
            self,
            Self::Scene(_)
                | Self::Open(_)
                | Self::Reset
                | Self::Step(_)
                | Self::Ball(_)
                | Self::Hammer(_)
                | Self::Throw { .. }
                | Self::Swing { .. }
                | Self::Grab { .. }
                | Self::Pull { .. }
                | Self::LetGo
                | Self::Drop(_)
                | Self::Undo
                | Self::Knob(..)
                | Self::ResetKnob(_)
                | Self::ResetKnobs
                | Self::Material(_)
        )
    }
}
