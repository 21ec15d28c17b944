//! Surfaces that enclose nothing, or are no surfaces.

use frangible_mesh::Surface;
use frangible_mesh::glam::DVec3;

use super::shapes::{cuboid, sphere};
use super::{Expect, HardCase};

pub(crate) fn all() -> Vec<HardCase> {
    vec![
        empty(),
        one_triangle(),
        flat_square(),
        two_sided_sheet(),
        nan_vertex(),
        index_out_of_range(),
        triangles_without_area(),
        sides_that_cancel(),
        too_large(),
    ]
}

fn refused(name: &'static str, surface: Surface) -> HardCase {
    let expect = Expect::Refused;
    HardCase {
        name,
        surface,
        expect,
    }
}

fn square() -> Surface {
    Surface {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
    }
}

pub(crate) fn empty() -> HardCase {
    refused("empty", Surface::default())
}

pub(crate) fn one_triangle() -> HardCase {
    let mut surface = square();
    surface.triangles.truncate(1);
    refused("one triangle", surface)
}

pub(crate) fn flat_square() -> HardCase {
    refused("flat square", square())
}

pub(crate) fn two_sided_sheet() -> HardCase {
    let mut surface = square();
    surface.triangles.extend([[0, 2, 1], [0, 3, 2]]);
    refused("two-sided sheet", surface)
}

pub(crate) fn nan_vertex() -> HardCase {
    let mut surface = cuboid(DVec3::ZERO, DVec3::ONE);
    surface.positions[3].y = f64::NAN;
    refused("nan vertex", surface)
}

pub(crate) fn index_out_of_range() -> HardCase {
    let mut surface = cuboid(DVec3::ZERO, DVec3::ONE);
    surface.triangles[5][1] = 8;
    refused("index out of range", surface)
}

pub(crate) fn triangles_without_area() -> HardCase {
    let positions = (0..9).map(|i| f64::from(i) * DVec3::ONE).collect();
    let triangles = (0..7).map(|i| [i, i + 1, i + 2]).collect();
    let surface = Surface {
        positions,
        triangles,
    };
    refused("triangles without area", surface)
}

/// Every face of a ball once each way round.
pub(crate) fn sides_that_cancel() -> HardCase {
    let mut surface = sphere(DVec3::ZERO, 1.0, 12);
    let back: Vec<[u32; 3]> = surface
        .triangles
        .iter()
        .map(|&[a, b, c]| [a, c, b])
        .collect();
    surface.triangles.extend(back);
    refused("sides that cancel", surface)
}

pub(crate) fn too_large() -> HardCase {
    refused("too large", cuboid(DVec3::ZERO, DVec3::splat(1e200)))
}
