//! Commands that a person or a script can give.

use std::path::PathBuf;

use frangible::glam::Vec3;
use frangible_compare::Method;

use crate::error::{ViewError, within};

/// One thing to do. Mouse, keys, panels and scripts all give these; [`Command::parse`] reads one, `to_string` writes it.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Load a built-in scene.
    Scene(String),
    /// Load a scene file, a mesh or a baked body.
    Open(PathBuf),
    /// Give up the bake that runs, or the comparison of methods.
    CancelBake,
    /// The scene from its beginning, with the knobs as they are.
    Reset,
    /// Stop the clock.
    Pause,
    /// Let the clock run.
    Run,
    /// Take this many steps.
    Step(u32),
    /// Take the steps of this many pictures of 1/60 s; a window draws each.
    Frames(u32),
    /// Speed of simulated time: 1 is as in life, 0.001 a thousandth of it.
    SlowMotion(f64),
    /// Volume, a share of the loudspeaker's range, 0..=1.
    Volume(f64),
    /// Sound, or silence.
    Sound(bool),
    /// Ball to throw from now on; a click throws it.
    Ball(BallSpec),
    /// Hammer to swing from now on; a click swings it.
    Hammer(HammerSpec),
    /// Tool that a click uses.
    Tool(Tool),
    /// Throw a ball from a point through another, m.
    Throw {
        /// Starting point.
        from: Vec3,
        /// Point that its centre is aimed at.
        through: Vec3,
    },
    /// Swing the hammer onto the thing that a ray meets.
    Swing {
        /// Origin of the ray, m.
        from: Vec3,
        /// A point it goes through.
        through: Vec3,
    },
    /// Take hold of the thing that a ray meets.
    Grab {
        /// Origin of the ray, m.
        from: Vec3,
        /// A point it goes through.
        through: Vec3,
    },
    /// Pull the held thing to the point of this ray that is as far off as it was taken.
    Pull {
        /// Origin of the ray, m.
        from: Vec3,
        /// A point it goes through.
        through: Vec3,
    },
    /// Let go of the held thing; it flies on.
    LetGo,
    /// The scene again, its bodies dropped from this height, m.
    Drop(f64),
    /// Back to just before the last break.
    Undo,
    /// Choose the subject to look at.
    Look(Subject),
    /// Choose a moment of the contact: its share of the motion's time, 0..=1.
    Scrub(f64),
    /// Factor by which the deformation is enlarged in the picture.
    Exaggerate(f64),
    /// Spread of the drawn pieces, as a share of their distance from their parent's middle: 0 leaves them in place.
    Explode(f64),
    /// Show a mark, or hide it.
    Show(Mark, bool),
    /// Choose the vibration mode to look at, from 1.
    Mode(usize),
    /// Select the thing that a ray meets, or nothing.
    Select {
        /// Origin of the ray, m.
        from: Vec3,
        /// A point it goes through.
        through: Vec3,
    },
    /// Turn a knob; the number in the knob's own unit.
    Knob(String, f64),
    /// Turn a knob back.
    ResetKnob(String),
    /// Turn all knobs back.
    ResetKnobs,
    /// Another material for all bodies.
    Material(String),
    /// The last impact again on the intact body, with the knobs as they are; both are shown side by side.
    HitAgain,
    /// The last impact by these methods, up to four side by side; none: those that were shown, or the first four.
    CompareMethods(Vec<Method>),
    /// Write a file.
    Save(Target, PathBuf),
    /// Draw a film of the last seconds off-screen, or path-trace a still, and write it.
    Film(FilmKind, PathBuf, FilmOptions),
    /// Give up the film that is being made.
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
    /// Go nearer by this factor, or farther below 1.
    Zoom(f32),
    /// Look at the scene as in the beginning.
    Home,
    /// Throw, or swing, through this place of the window, shares of its width and height from the upper left.
    Click(f32, f32),
    /// Select the thing at this place of the window.
    Pick(f32, f32),
    /// Take hold of the thing at this place of the window.
    GrabAt(f32, f32),
    /// Pull the held thing to this place of the window.
    PullTo(f32, f32),
    /// Open or close a panel.
    Panel(String, bool),
    /// Dark or light.
    Dark(bool),
    /// Close the window.
    Quit,
}

/// Subject to look at.
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
    /// The last impact, and the same impact with the knobs as they are.
    Compare,
    /// The last impact by several methods.
    Methods,
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
    /// The skin of the fine mesh that carries the cracks.
    FractureMesh,
    /// The skin of the coarse mesh that carries the modes.
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
    /// The scene with the knobs as they are, TOML.
    Scene,
    /// The current scene, GLB.
    Glb,
    /// All commands since the scene was loaded, as a script that does the same again.
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
    /// The last seconds, MP4; takes `ffmpeg`.
    Mp4,
}

/// Settings of a film.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmOptions {
    /// Length of the film, s, counted back from now as it was seen: in slow motion a step takes long. At most 20.
    pub seconds: f64,
    /// Pictures per second, 1/s.
    pub rate: f64,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// Paths per pixel of a still; its noise falls with the square root of this number.
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
