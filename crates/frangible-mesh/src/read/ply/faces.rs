//! Faces and strips of triangles of a PLY file.

use super::header::{Element, Kind, Property};
use super::values::Values;
use crate::InputMesh;
use crate::read::polygon::triangulate;
use crate::read::{ReadError, check_triangles};

/// Names of the list of a face's or a strip's vertices.
const LISTS: [&[u8]; 2] = [b"vertex_indices", b"vertex_index"];

/// Ends a strip, so that another begins.
const RESTART: i64 = -1;

/// Faces as the file has them: vertices may come after them.
#[derive(Default)]
pub(super) struct Faces {
    corners: Vec<i64>,
    ends: Vec<u32>,
    triangles: u64,
}

impl Faces {
    pub(super) fn read(&mut self, element: &Element, values: &mut Values) -> Result<(), ReadError> {
        check_triangles(element.count)?;
        read_lists(element, values, |row, property, count, values| {
            self.triangles += count.saturating_sub(2);
            check_triangles(self.triangles)?;
            for _ in 0..count {
                let corner = values.next(property.value, || place(element, row))?;
                self.corners.push(corner as i64);
            }
            self.ends.push(self.corners.len() as u32);
            Ok(())
        })
    }

    /// Reads strips, in which each vertex makes a triangle with the two before it, as the faces that they stand for.
    /// `vertices`: number of vertices of the file.
    pub(super) fn read_strips(
        &mut self,
        element: &Element,
        vertices: u64,
        values: &mut Values,
    ) -> Result<(), ReadError> {
        read_lists(element, values, |row, property, count, values| {
            let restart = restart(property.value, vertices);
            let mut strip = Vec::new();
            for _ in 0..count {
                let vertex = values.next(property.value, || place(element, row))? as i64;
                if vertex == RESTART || Some(vertex) == restart {
                    strip.clear();
                    continue;
                }
                strip.push(vertex);
                let &[.., a, b, c] = strip.as_slice() else {
                    continue;
                };
                // Strips are joined by triangles that have a vertex twice.
                if a != b && b != c && c != a {
                    let is_turned = strip.len() % 2 == 0;
                    let face = if is_turned { [b, a, c] } else { [a, b, c] };
                    self.corners.extend(face);
                    self.ends.push(self.corners.len() as u32);
                    self.triangles += 1;
                    check_triangles(self.triangles)?;
                }
            }
            Ok(())
        })
    }

    pub(super) fn triangulate(&self, mesh: &mut InputMesh) -> Result<(), ReadError> {
        let vertices = mesh.positions.len();
        let mut points = Vec::new();
        let mut local = Vec::new();
        let mut first = 0;
        for (face, &end) in self.ends.iter().enumerate() {
            let corners = self.corners.get(first..end as usize).unwrap_or_default();
            first = end as usize;
            mesh.skipped_faces += usize::from(corners.len() < 3);
            points.clear();
            for &index in corners {
                let position = usize::try_from(index)
                    .ok()
                    .and_then(|v| mesh.positions.get(v));
                let face = face + 1;
                points.push(*position.ok_or(ReadError::IndexOutOfRange {
                    face,
                    index,
                    vertices,
                })?);
            }
            triangulate(&points, &mut local);
            let triangles = local.iter().map(|t| t.map(|k| corners[k as usize] as u32));
            mesh.triangles.extend(triangles);
        }
        Ok(())
    }
}

/// The number that stands for −1 in a kind without a sign, unless it is a vertex.
fn restart(kind: Kind, vertices: u64) -> Option<i64> {
    kind.all_bits().filter(|&all| all as u64 >= vertices)
}

/// Returns true for the lists of vertices of an element: those of the usual names, or else its only list of whole numbers.
pub(super) fn is_corner_list(element: &Element, property: &Property) -> bool {
    let is_named = |p: &Property| p.count.is_some() && LISTS.contains(&&p.name[..]);
    let is_list = |p: &Property| p.count.is_some() && p.value.is_whole();
    if element.properties.iter().any(is_named) {
        return is_named(property);
    }
    is_list(property) && element.properties.iter().filter(|p| is_list(p)).count() == 1
}

fn place(element: &Element, row: u64) -> String {
    format!("{} {}", String::from_utf8_lossy(&element.name), row + 1)
}

/// Gives the lists of vertices of an element to `take`, with their row and length, and passes over all else.
fn read_lists(
    element: &Element,
    values: &mut Values,
    mut take: impl FnMut(u64, &Property, u64, &mut Values) -> Result<(), ReadError>,
) -> Result<(), ReadError> {
    if element.count == 0 {
        return Ok(());
    }
    let properties = element.properties.iter();
    let lists: Vec<bool> = properties.map(|p| is_corner_list(element, p)).collect();
    if !lists.contains(&true) {
        let name = String::from_utf8_lossy(&element.name);
        let problem = format!(
            "{name}: there is no list property vertex_indices; give the list of vertex indices that name"
        );
        return Err(ReadError::malformed("the header", problem));
    }
    for row in 0..element.count {
        for (property, is_list) in element.properties.iter().zip(&lists) {
            let place = || place(element, row);
            let Some(count) = property.count.filter(|_| *is_list) else {
                values.skip(property, place)?;
                continue;
            };
            let count = values.list_length(count, place)?;
            take(row, property, count, values)?;
        }
    }
    Ok(())
}
