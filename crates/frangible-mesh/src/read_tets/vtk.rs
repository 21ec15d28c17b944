//! VTK's legacy format, text and binary, before and since version 5.

use glam::DVec3;

use super::builder::Builder;
use super::cursor::{Coding, Cursor};
use super::vtk_cells::{Cells, rank};
use crate::read::ReadError;
use crate::read::text::shown;
use crate::tet_input::TetInput;

pub(super) fn parse(bytes: &[u8]) -> Result<TetInput, ReadError> {
    let mut cursor = Cursor::new(bytes);
    let first = cursor.rest_of_line().unwrap_or_default();
    if !first.starts_with(b"# vtk DataFile") {
        return Err(ReadError::malformed(
            "line 1",
            "a VTK file begins with “# vtk DataFile”",
        ));
    }
    cursor.rest_of_line();
    let coding = match cursor.word() {
        Some(b"ASCII") => Coding::Text,
        Some(b"BINARY") => Coding::Big,
        _ => return Err(cursor.malformed("expected ASCII or BINARY")),
    };
    let mut grid = Grid {
        coding,
        cells: Cells::default(),
        builder: Builder::default(),
        points: 0,
        rank: 0,
    };
    grid.read(&mut cursor)?;
    let Grid {
        cells,
        mut builder,
        points,
        ..
    } = grid;
    cells.add_to(&mut builder, 0, points, 0)?;
    builder.finish()
}

struct Grid {
    coding: Coding,
    cells: Cells,
    builder: Builder,
    points: u64,
    /// Rank of the cell data that gave the groups: higher ranks are preferred.
    rank: usize,
}

impl Grid {
    fn read(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        // Attributes of cells, or of points.
        let (mut of_cells, mut tuples) = (false, 0);
        while let Some(keyword) = cursor.word() {
            match keyword {
                b"DATASET" => {
                    let kind = cursor.word().unwrap_or_default();
                    if kind != b"UNSTRUCTURED_GRID" {
                        let needs = format!(
                            "the dataset is “{}”; it must be UNSTRUCTURED_GRID",
                            shown(kind)
                        );
                        return Err(cursor.malformed(needs));
                    }
                }
                b"POINTS" => self.positions(cursor)?,
                b"CELLS" => self.connectivity(cursor)?,
                b"CELL_TYPES" => {
                    let count = cursor.count(8, "CELL_TYPES")?;
                    self.cells.kinds = self.integers(cursor, count, 4, "CELL_TYPES")?;
                }
                b"CELL_DATA" => {
                    of_cells = true;
                    tuples = cursor.count(8, "CELL_DATA")?;
                }
                b"POINT_DATA" => {
                    of_cells = false;
                    tuples = cursor.count(8, "POINT_DATA")?;
                }
                b"METADATA" => while cursor.rest_of_line().is_some_and(|line| !line.is_empty()) {},
                // After the last group nothing is needed, and these are many.
                _ if tuples > 0 => {
                    if !self.attribute(cursor, keyword, tuples, of_cells)? {
                        log::warn!("VTK attributes from “{}” on are ignored", shown(keyword));
                        return Ok(());
                    }
                }
                b"FIELD" => {
                    if !self.attribute(cursor, keyword, 0, false)? {
                        return Err(cursor.malformed("a FIELD has an unknown type"));
                    }
                }
                _ => {
                    let problem = format!("the keyword “{}” is unknown", shown(keyword));
                    return Err(cursor.malformed(problem));
                }
            }
        }
        Ok(())
    }

    fn positions(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let inside = "POINTS";
        let count = cursor.count(8, inside)?;
        let kind = cursor.word().unwrap_or_default();
        let width = match kind {
            b"float" => 4,
            b"double" => 8,
            _ => return Err(cursor.malformed("points must be float or double")),
        };
        self.start(cursor);
        for tag in 0..count {
            let mut next = || cursor.real(width, inside);
            let position = DVec3::new(next()?, next()?, next()?);
            self.builder.node(tag, position)?;
        }
        self.points = count;
        cursor.coding = Coding::Text;
        Ok(())
    }

    fn connectivity(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ReadError> {
        let inside = "CELLS";
        let (first, second) = (cursor.count(8, inside)?, cursor.count(8, inside)?);
        if cursor.peek() == Some(b"OFFSETS") {
            // Version 5: one offset more than cells, then all nodes.
            for (count, offsets) in [(first, true), (second, false)] {
                cursor.word();
                let kind = cursor.word().unwrap_or_default();
                let width = width_of(kind).ok_or_else(|| cursor.malformed("a type is missing"))?;
                let values = self.integers(cursor, count, width, inside)?;
                let values = unsigned(values)?;
                if offsets {
                    self.cells.ends = values.get(1..).unwrap_or_default().to_vec();
                } else {
                    self.cells.connectivity = values;
                }
            }
            return Ok(());
        }
        self.start(cursor);
        for _ in 0..first {
            for _ in 0..cursor.count(4, inside)? {
                self.cells.connectivity.push(cursor.count(4, inside)?);
            }
            self.cells.ends.push(self.cells.connectivity.len() as u64);
        }
        cursor.coding = Coding::Text;
        Ok(())
    }

    /// One attribute; false if its size is not known.
    fn attribute(
        &mut self,
        cursor: &mut Cursor<'_>,
        keyword: &[u8],
        tuples: u64,
        of_cells: bool,
    ) -> Result<bool, ReadError> {
        let inside = "an attribute";
        let name = String::from_utf8_lossy(cursor.word().unwrap_or_default()).into_owned();
        if keyword == b"FIELD" {
            for _ in 0..cursor.count(4, inside)? {
                if cursor.peek() == Some(b"METADATA") {
                    while cursor.rest_of_line().is_some_and(|line| !line.is_empty()) {}
                }
                let name = String::from_utf8_lossy(cursor.word().unwrap_or_default()).into_owned();
                let components = cursor.count(4, inside)?;
                let count = components.saturating_mul(cursor.count(8, inside)?);
                let kind = cursor.word().unwrap_or_default();
                let groups = of_cells && components == 1;
                if !self.values(cursor, &name, kind, count, groups)? {
                    return Ok(false);
                }
            }
            return Ok(true);
        }
        let (components, kind) = match keyword {
            b"SCALARS" => {
                let kind = cursor.word().unwrap_or_default();
                let rest = cursor.rest_of_line().unwrap_or_default();
                let components = String::from_utf8_lossy(rest).parse().unwrap_or(1);
                if cursor.peek() == Some(b"LOOKUP_TABLE") {
                    cursor.word();
                    cursor.word();
                }
                (components, kind)
            }
            b"VECTORS" | b"NORMALS" => (3, cursor.word().unwrap_or_default()),
            b"TENSORS" => (9, cursor.word().unwrap_or_default()),
            b"GLOBAL_IDS" | b"PEDIGREE_IDS" => (1, cursor.word().unwrap_or_default()),
            b"TEXTURE_COORDINATES" => {
                let components = cursor.count(4, inside)?;
                (components, cursor.word().unwrap_or_default())
            }
            _ => return Ok(false),
        };
        let groups = of_cells && components == 1;
        let count = tuples.saturating_mul(components);
        self.values(cursor, &name, kind, count, groups)
    }

    /// Values of an attribute, kept if they are groups; false if their type is not known.
    fn values(
        &mut self,
        cursor: &mut Cursor<'_>,
        name: &str,
        kind: &[u8],
        count: u64,
        groups: bool,
    ) -> Result<bool, ReadError> {
        let Some(width) = width_of(kind) else {
            return Ok(false);
        };
        // Spaces of names are written so.
        let rank = rank(&name.replace("%3A", ":").replace("%20", " "));
        let wanted = groups && rank > Some(self.rank);
        self.start(cursor);
        let real = kind == b"float" || kind == b"double";
        let mut values = Vec::new();
        for _ in 0..count {
            let value = if real || cursor.coding == Coding::Text {
                cursor.real(width, name)? as i64
            } else {
                cursor.integer(width, name)?
            };
            if wanted {
                values.push(value);
            }
        }
        cursor.coding = Coding::Text;
        if let (true, Some(rank)) = (wanted, rank) {
            (self.cells.groups, self.rank) = (values, rank);
        }
        Ok(true)
    }

    fn integers(
        &self,
        cursor: &mut Cursor<'_>,
        count: u64,
        width: usize,
        inside: &str,
    ) -> Result<Vec<i64>, ReadError> {
        self.start(cursor);
        let mut values = Vec::new();
        for _ in 0..count {
            values.push(cursor.integer(width, inside)?);
        }
        cursor.coding = Coding::Text;
        Ok(values)
    }

    /// Numbers begin on the next line.
    fn start(&self, cursor: &mut Cursor<'_>) {
        if self.coding != Coding::Text {
            cursor.rest_of_line();
        }
        cursor.coding = self.coding;
    }
}

/// Bytes of a number of this type.
fn width_of(kind: &[u8]) -> Option<usize> {
    Some(match kind.to_ascii_lowercase().as_slice() {
        b"char" | b"unsigned_char" | b"signed_char" => 1,
        b"short" | b"unsigned_short" => 2,
        b"int" | b"unsigned_int" | b"float" | b"vtkidtype" => 4,
        b"long" | b"unsigned_long" | b"double" | b"vtktypeint64" | b"vtktypeuint64" => 8,
        _ => return None,
    })
}

pub(super) fn unsigned(values: Vec<i64>) -> Result<Vec<u64>, ReadError> {
    let unsigned = |value: i64| {
        u64::try_from(value)
            .map_err(|_| ReadError::malformed("the cells", format!("{value} is negative")))
    };
    values.into_iter().map(unsigned).collect()
}
