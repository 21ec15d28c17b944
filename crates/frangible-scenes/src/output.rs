//! Output files of a scene.

/// Output files of a scene, relative to the folder of the caller.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// The animation, by default `NAME.glb`.
    pub glb: FileWish,
    /// The sound, by default `NAME.wav`.
    pub wav: FileWish,
    /// The four moments of the break, by default `NAME.png`.
    pub picture: FileWish,
    /// The final state for several seeds, `NAME-seeds.png`; by default not written.
    pub contact_sheet: FileWish,
    /// The report, `NAME.json`; by default not written.
    pub json: FileWish,
    /// Number of seeds on the contact sheet, default 9.
    pub seeds: usize,
    /// Detail of the drawn pieces.
    pub drawing: Drawing,
}

/// Detail with which pieces are drawn, in files and pictures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Drawing {
    /// Crack faces as computed, with the cracks that end inside a body.
    #[default]
    Full,
    /// Crack faces with fewer triangles, at most [`TOLERANCE`] of the body's longest side away from the computed ones; so are surfaces that no one
    /// drew. Cracks that end inside a body are left out.
    Light,
    /// Crack faces finer than computed: edges at most a quarter of the mesh's mean edge, with the roughness of the material. Those of materials
    /// without roughness stay as computed.
    Fine,
}

/// Largest distance of simplified crack faces from the computed ones, of the longest side of the body.
pub const TOLERANCE: f32 = 0.005;

/// Triangles wanted of a light drawing: for each of its body as its author drew it, and for each piece.
pub(crate) const WANTED_OF_DRAWN: usize = 3;
pub(crate) const WANTED_OF_PIECE: usize = 200;

/// Effect of [`Drawing::Light`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Simplified {
    /// Triangles of all pieces before.
    pub full: usize,
    /// Triangles after.
    pub light: usize,
    /// Triangles wanted: at most 3 for each triangle of the bodies as their authors drew them, and 200 for each piece. Rough crack faces take more to
    /// stay within the distance, which comes first.
    pub wanted: usize,
    /// Largest distance between the two, m, measured at the corners and middles of triangles.
    pub error: f32,
    /// Largest distance as a share of the longest side of the body.
    pub share: f32,
}

impl Simplified {
    /// Adds another piece.
    pub(crate) fn add(&mut self, other: &Self) {
        self.full += other.full;
        self.light += other.light;
        self.wanted += other.wanted;
        self.error = self.error.max(other.error);
        self.share = self.share.max(other.share);
    }
}

/// Choice of writing a file, with its name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum FileWish {
    /// Do not write it.
    No,
    /// Write it under the default name.
    Yes,
    /// Write it under this name.
    Named(String),
}

impl Default for Output {
    fn default() -> Self {
        Self {
            glb: FileWish::Yes,
            wav: FileWish::Yes,
            picture: FileWish::Yes,
            contact_sheet: FileWish::No,
            json: FileWish::No,
            seeds: 9,
            drawing: Drawing::Full,
        }
    }
}

impl FileWish {
    /// Name of the file, if it is to be written.
    #[must_use]
    pub fn file_name(&self, usual: impl FnOnce() -> String) -> Option<String> {
        match self {
            Self::No => None,
            Self::Yes => Some(usual()),
            Self::Named(name) => Some(name.clone()),
        }
    }

    /// Returns true if the file is to be written.
    #[must_use]
    pub fn is_wanted(&self) -> bool {
        *self != Self::No
    }
}

impl Output {
    /// Names of the files a scene of this name will write: animation, sound, picture, contact sheet, report.
    #[must_use]
    pub fn file_names(&self, scene: &str) -> [Option<String>; 5] {
        [
            self.glb.file_name(|| format!("{scene}.glb")),
            self.wav.file_name(|| format!("{scene}.wav")),
            self.picture.file_name(|| format!("{scene}.png")),
            self.contact_sheet
                .file_name(|| format!("{scene}-seeds.png")),
            self.json.file_name(|| format!("{scene}.json")),
        ]
    }
}
