//! Stanford PLY: text, little and big endian.

mod faces;
mod header;
mod values;

use std::path::Path;

use glam::{DVec3, Vec2, Vec3};

use self::faces::{Faces, is_corner_list};
use self::header::{Element, Header, Kind, Property};
use self::values::Values;
use super::finish::WHITE;
use super::images::read_image;
use super::text::shown;
use super::{ReadError, check_vertices};
use crate::{InputMaterial, InputMesh, Texture, TextureSlot};

pub(crate) fn parse(bytes: &[u8], folder: Option<&Path>) -> Result<InputMesh, ReadError> {
    let (header, body) = Header::parse(bytes)?;
    let mut values = Values::new(header.encoding, body);
    let mut mesh = InputMesh::default();
    let mut faces = Faces::default();
    for element in &header.elements {
        match element.name.as_slice() {
            b"vertex" => read_vertices(element, &mut values, &mut mesh)?,
            b"face" | b"faces" => {
                let properties = element.properties.iter();
                for property in properties.filter(|p| !is_corner_list(element, p)) {
                    mesh.leave_out(format!("{} of faces", shown(&property.name)));
                }
                faces.read(element, &mut values)?;
            }
            b"tristrips" | b"tristrip" => {
                faces.read_strips(element, header.vertices(), &mut values)?;
            }
            name => {
                mesh.leave_out(format!("the elements {}", shown(name)));
                skip(element, &mut values)?;
            }
        }
    }
    mesh.srgb_colors = true;
    faces.triangulate(&mut mesh)?;
    texture(&header.textures, folder, &mut mesh);
    Ok(mesh)
}

/// The look of a mesh with one image, which scanners name in a remark. Several images go with numbers that are not read.
fn texture(names: &[String], folder: Option<&Path>, mesh: &mut InputMesh) {
    let (name, folder) = match (names, folder) {
        ([name], Some(folder)) if !mesh.uvs.is_empty() => (name, folder),
        _ => {
            for name in names {
                mesh.leave_out(format!("image {name}"));
            }
            return;
        }
    };
    match read_image(name, folder) {
        Ok(image) => {
            mesh.images = vec![image];
            mesh.materials = vec![InputMaterial {
                base_color: WHITE,
                textures: vec![Texture::of(TextureSlot::BaseColor, 0)],
                ..InputMaterial::default()
            }];
            mesh.material_of_triangle = vec![0; mesh.triangles.len()];
        }
        Err(problem) => mesh.leave_out(problem),
    }
}

/// Part of the mesh that a vertex property fills.
#[derive(Clone, Copy)]
enum Slot {
    Position(usize),
    Normal(usize),
    Uv(usize),
    /// Channel, and the value of full intensity.
    Color(usize, f64),
    Nowhere,
}

fn slot(property: &Property) -> Slot {
    let full = match property.value {
        Kind::F32 | Kind::F64 => 1.0,
        Kind::U16 => f64::from(u16::MAX),
        // Other whole numbers stand for bytes, whatever they are kept in.
        _ => f64::from(u8::MAX),
    };
    match property.name.as_slice() {
        b"x" => Slot::Position(0),
        b"y" => Slot::Position(1),
        b"z" => Slot::Position(2),
        b"nx" => Slot::Normal(0),
        b"ny" => Slot::Normal(1),
        b"nz" => Slot::Normal(2),
        b"s" | b"u" | b"texture_u" => Slot::Uv(0),
        b"t" | b"v" | b"texture_v" => Slot::Uv(1),
        b"red" | b"diffuse_red" => Slot::Color(0, full),
        b"green" | b"diffuse_green" => Slot::Color(1, full),
        b"blue" | b"diffuse_blue" => Slot::Color(2, full),
        b"alpha" | b"diffuse_alpha" => Slot::Color(3, full),
        _ => Slot::Nowhere,
    }
}

fn read_vertices(
    element: &Element,
    values: &mut Values,
    mesh: &mut InputMesh,
) -> Result<(), ReadError> {
    check_vertices(element.count.saturating_add(mesh.positions.len() as u64))?;
    let slots: Vec<Slot> = element.properties.iter().map(slot).collect();
    for (property, slot) in element.properties.iter().zip(&slots) {
        if matches!(slot, Slot::Nowhere) || property.count.is_some() {
            mesh.leave_out(format!("{} of vertices", shown(&property.name)));
        }
    }
    for k in 0..3 {
        if !slots
            .iter()
            .any(|slot| matches!(slot, Slot::Position(at) if *at == k))
        {
            let problem = format!("vertices have no {}", ["x", "y", "z"][k]);
            return Err(ReadError::malformed("the header", problem));
        }
    }
    let has_normals = slots.iter().any(|slot| matches!(slot, Slot::Normal(_)));
    let has_uvs = slots.iter().any(|slot| matches!(slot, Slot::Uv(_)));
    let has_colors = slots.iter().any(|slot| matches!(slot, Slot::Color(..)));
    // A file may have vertices in several runs, with other properties each.
    complete(mesh, [has_normals, has_uvs, has_colors]);
    for row in 0..element.count {
        let place = || format!("vertex {}", row + 1);
        let (mut position, mut normal, mut uv) = ([0.0; 3], [0.0_f32; 3], [0.0_f32; 2]);
        let mut color = WHITE;
        for (property, slot) in element.properties.iter().zip(&slots) {
            if property.count.is_some() {
                values.skip(property, place)?;
                continue;
            }
            let value = values.next(property.value, place)?;
            match *slot {
                Slot::Position(k) => position[k] = value,
                Slot::Normal(k) => normal[k] = value as f32,
                Slot::Uv(k) => uv[k] = value as f32,
                Slot::Color(k, full) => color[k] = (value / full) as f32,
                Slot::Nowhere => {}
            }
        }
        mesh.positions.push(DVec3::from(position));
        if has_normals {
            mesh.normals.push(Vec3::from(normal));
        }
        if has_uvs {
            // The file's origin is the lower left corner of the picture.
            mesh.uvs.push(Vec2::new(uv[0], 1.0 - uv[1]));
        }
        if has_colors {
            mesh.colors.push(color);
        }
    }
    let has = [
        !mesh.normals.is_empty(),
        !mesh.uvs.is_empty(),
        !mesh.colors.is_empty(),
    ];
    complete(mesh, has);
    Ok(())
}

/// Fills the wanted attributes of every vertex so far that lacks them.
fn complete(mesh: &mut InputMesh, [normals, uvs, colors]: [bool; 3]) {
    let count = mesh.positions.len();
    if normals {
        mesh.normals.resize(count, Vec3::ZERO);
    }
    if uvs {
        mesh.uvs.resize(count, Vec2::ZERO);
    }
    if colors {
        mesh.colors.resize(count, WHITE);
    }
}

fn skip(element: &Element, values: &mut Values) -> Result<(), ReadError> {
    if element.properties.is_empty() {
        return Ok(());
    }
    let name = String::from_utf8_lossy(&element.name);
    for row in 0..element.count {
        for property in &element.properties {
            values.skip(property, || format!("{name} {}", row + 1))?;
        }
    }
    Ok(())
}
