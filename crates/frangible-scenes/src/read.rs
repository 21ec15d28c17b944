//! Source of files: the disk, or memory where there is none, as in a browser.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use frangible::Asset;
use frangible_mesh::{
    InputMesh, ReadError, TetFormat, TetInput, parse_mesh_named, parse_tetgen, parse_tets,
    read_mesh, read_tets,
};

use crate::error::SceneError;
use crate::source::FileKind;

/// Largest scene file, bytes.
const LARGEST: u64 = 1 << 20;

/// Message about a file that is not in memory.
const NOT_GIVEN: &str = "this file is missing; provide it together with the file that refers to it";

/// Files that scenes are made of.
#[derive(Clone, Debug, Default)]
pub enum Files {
    /// Files on the disk.
    #[default]
    Disk,
    /// These files, by their names; there is no disk.
    Given(BTreeMap<PathBuf, Vec<u8>>),
}

impl Files {
    /// Finds out, in words, whether there is a file of this kind that holds anything.
    pub(crate) fn check(&self, path: &Path, kind: FileKind) -> Result<(), SceneError> {
        let problem = match self.length(path) {
            Err(problem) => problem,
            Ok(0) => "this file is empty".into(),
            Ok(_) if FileKind::of(path)? != kind => match kind {
                FileKind::Mesh if FileKind::of(path)? == FileKind::Asset => {
                    "this is a baked body, not a mesh; in a scene file, give it as `asset`".into()
                }
                FileKind::Mesh => "this is not a mesh (.obj, .stl, .ply, .gltf, .glb, or tetrahedra: .msh, .node, .ele, .mesh)".into(),
                FileKind::Asset => "this is not a baked body (.frangible)".into(),
                FileKind::Scene => "this is not a scene (.toml)".into(),
            },
            Ok(_) => return Ok(()),
        };
        Err(wrong(path, problem))
    }

    /// Bytes of an ordinary file, or in words why there is none.
    fn length(&self, path: &Path) -> Result<u64, String> {
        match self {
            Self::Given(files) => {
                let given = files.get(path).map(|bytes| bytes.len() as u64);
                given.ok_or_else(|| NOT_GIVEN.into())
            }
            Self::Disk => match fs::metadata(path) {
                Err(_) if frangible_mesh::is_address(&path.to_string_lossy()) => {
                    Err("this is a web address, not a file; download it first".into())
                }
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
                    Err(match frangible_mesh::nearest_file(path) {
                        Some(name) => format!("there is no such file (did you mean `{name}`?)"),
                        None => "there is no such file; check its path".to_string(),
                    })
                }
                Err(error) => Err(format!("the file cannot be read ({error})")),
                Ok(data) if data.is_dir() => Err("this is a folder; give a file in it".into()),
                Ok(data) if !data.is_file() => Err("this is not a regular file".into()),
                Ok(data) => Ok(data.len()),
            },
        }
    }

    /// Returns true if there is such a file.
    pub(crate) fn has(&self, path: &Path) -> bool {
        match self {
            Self::Disk => path.is_file(),
            Self::Given(files) => files.contains_key(path),
        }
    }

    fn bytes(&self, path: &Path) -> Result<Cow<'_, [u8]>, SceneError> {
        match self {
            Self::Given(files) => match files.get(path) {
                Some(bytes) => Ok(bytes.into()),
                None => Err(wrong(path, NOT_GIVEN.into())),
            },
            Self::Disk => match fs::read(path) {
                Ok(bytes) => Ok(bytes.into()),
                Err(error) => Err(wrong(path, format!("the file cannot be read ({error})"))),
            },
        }
    }

    /// The text of a scene file.
    pub(crate) fn scene(&self, path: &Path) -> Result<String, SceneError> {
        self.check(path, FileKind::Scene)?;
        if self.length(path).is_ok_and(|length| length > LARGEST) {
            return Err(wrong(
                path,
                "this is too large for a scene (limit: 1 MiB)".into(),
            ));
        }
        String::from_utf8(self.bytes(path)?.into_owned())
            .map_err(|_| wrong(path, "this is not TOML: it is not UTF-8 text".into()))
    }

    /// The triangles of a mesh file, in its own unit and axes.
    pub(crate) fn mesh(&self, path: &Path) -> Result<InputMesh, SceneError> {
        let mesh = match self {
            Self::Disk => read_mesh(path),
            Self::Given(_) => parse_mesh_named(path, &self.bytes(path)?, None),
        };
        mesh.map_err(|error| wrong(path, error.to_string()))
    }

    /// The tetrahedra of a file, in its own unit and axes.
    pub(crate) fn tets(&self, path: &Path) -> Result<TetInput, SceneError> {
        let tets = match (self, TetFormat::from_extension(path)) {
            (Self::Disk, _) => read_tets(path),
            (_, Some(TetFormat::TetGen)) => {
                let [node, ele, face] = ["node", "ele", "face"].map(|e| path.with_extension(e));
                let face = self.has(&face).then(|| self.bytes(&face)).transpose()?;
                parse_tetgen(&self.bytes(&node)?, &self.bytes(&ele)?, face.as_deref())
            }
            (_, Some(format)) => parse_tets(format, &self.bytes(path)?),
            (_, None) => Err(ReadError::UnknownTetFormat {
                name: path.display().to_string(),
            }),
        };
        tets.map_err(|error| wrong(path, error.to_string()))
    }

    /// A baked body.
    pub(crate) fn asset(&self, path: &Path) -> Result<Asset, SceneError> {
        Ok(match self {
            Self::Disk => Asset::load(path)?,
            Self::Given(_) => Asset::from_bytes(&self.bytes(path)?)?,
        })
    }
}

fn wrong(path: &Path, problem: String) -> SceneError {
    SceneError::File {
        path: path.to_path_buf(),
        problem,
    }
}
