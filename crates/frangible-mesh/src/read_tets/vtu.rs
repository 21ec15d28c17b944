//! VTK's XML format of unstructured grids: text, base64 and raw data, uncompressed or with zlib.

use glam::DVec3;

use super::builder::Builder;
use super::data_array::{Arrays, Layout, Settings};
use super::vtk::unsigned;
use super::vtk_cells::{Cells, rank};
use super::xml::{Tag, Tags};
use crate::read::ReadError;
use crate::tet_input::TetInput;

pub(super) fn parse(bytes: &[u8]) -> Result<TetInput, ReadError> {
    let mut file = File::default();
    let mut tags = Tags::new(bytes);
    let mut section = String::new();
    let mut piece: Option<Piece<'_>> = None;
    let mut pieces = Vec::new();
    let mut arrays = Arrays::default();
    while let Some(tag) = tags.next_tag()? {
        match (tag.name.as_str(), tag.closes) {
            ("VTKFile", false) => file.open(&tag)?,
            ("Piece", false) => {
                // The arrays tell how many points and cells there are: the counts of the tag are not needed.
                piece = Some(Piece::default());
            }
            ("Piece", true) => pieces.extend(piece.take()),
            ("Points" | "Cells" | "CellData" | "PointData", closes) => {
                section = if closes {
                    String::new()
                } else {
                    tag.name.clone()
                };
            }
            ("DataArray", false) => {
                if let Some(piece) = &mut piece {
                    piece.array(&section, tag);
                }
            }
            ("AppendedData", false) => {
                arrays = Arrays::appended(&tag, tags.rest())?;
                break;
            }
            _ => {}
        }
    }
    let settings = file.settings.ok_or_else(|| {
        ReadError::malformed("line 1", "a VTU file must have a <VTKFile> element")
    })?;
    let mut builder = Builder::default();
    let (mut nodes, mut done) = (0, 0);
    for piece in &pieces {
        let (points, cells) = piece.read(&arrays, &settings)?;
        for (tag, &point) in (nodes..).zip(&points) {
            builder.node(tag, point)?;
        }
        cells.add_to(&mut builder, nodes, points.len() as u64, done)?;
        nodes += points.len() as u64;
        done += cells.kinds.len() as u64;
    }
    builder.finish()
}

#[derive(Default)]
struct File {
    settings: Option<Settings>,
}

impl File {
    fn open(&mut self, tag: &Tag<'_>) -> Result<(), ReadError> {
        let kind = tag.get("type").unwrap_or_default();
        if kind != "UnstructuredGrid" {
            let problem = format!("the type is “{kind}”; it must be UnstructuredGrid");
            return Err(ReadError::malformed(tag.place(), problem));
        }
        self.settings = Some(Settings::of(tag)?);
        Ok(())
    }
}

/// The arrays of a piece that are needed.
#[derive(Default)]
struct Piece<'a> {
    points: Option<Tag<'a>>,
    connectivity: Option<Tag<'a>>,
    offsets: Option<Tag<'a>>,
    kinds: Option<Tag<'a>>,
    groups: Option<(usize, Tag<'a>)>,
}

impl<'a> Piece<'a> {
    fn array(&mut self, section: &str, tag: Tag<'a>) {
        let name = tag.get("Name").unwrap_or_default().to_string();
        match (section, name.as_str()) {
            ("Points", _) => self.points = Some(tag),
            ("Cells", "connectivity") => self.connectivity = Some(tag),
            ("Cells", "offsets") => self.offsets = Some(tag),
            ("Cells", "types") => self.kinds = Some(tag),
            ("CellData", name) => {
                let single = tag.get("NumberOfComponents").is_none_or(|n| n == "1");
                let better = self.groups.as_ref().map_or(0, |g| g.0);
                if let (true, Some(rank)) = (single, rank(name))
                    && rank > better
                {
                    self.groups = Some((rank, tag));
                }
            }
            _ => {}
        }
    }

    fn read(
        &self,
        arrays: &Arrays<'_>,
        settings: &Settings,
    ) -> Result<(Vec<DVec3>, Cells), ReadError> {
        let layout = |tag: &Option<Tag<'a>>, name: &str| match tag {
            Some(tag) => Layout::read(tag, arrays, settings),
            None => {
                let problem = format!("it has no array {name}");
                Err(ReadError::malformed("a <Piece>", problem))
            }
        };
        let points = layout(&self.points, "points")?.reals()?;
        let points = points.chunks_exact(3).map(DVec3::from_slice).collect();
        let cells = Cells {
            connectivity: unsigned(layout(&self.connectivity, "connectivity")?.integers()?)?,
            ends: unsigned(layout(&self.offsets, "offsets")?.integers()?)?,
            kinds: layout(&self.kinds, "types")?.integers()?,
            groups: match &self.groups {
                Some((_, tag)) => Layout::read(tag, arrays, settings)?.integers()?,
                None => Vec::new(),
            },
        };
        Ok((points, cells))
    }
}
