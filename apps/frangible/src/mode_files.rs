//! Files that `frangible modes` writes: a picture of the shapes, and the meshes with their fields.

use std::error::Error;

use frangible::Asset;
use frangible::glam::{Quat, Vec3};
use frangible::internals::stress::{Symmetric3, largest_eigenvalue};
use frangible_bake::mode_field::{
    ModeField, mode_on_analysis_mesh, mode_on_fracture_mesh, von_mises,
};
use frangible_export::{ExportError, VtuCells, VtuField, VtuMesh, VtuValues, write_vtu};

/// Largest displacement as drawn, as a share of the body's diagonal.
#[cfg(feature = "view")]
const EXAGGERATION: f32 = 0.08;

/// The first shapes on one sheet, coloured by von Mises stress, PNG.
#[cfg(feature = "view")]
pub(crate) fn picture(
    asset: &Asset,
    count: usize,
    rotation: Quat,
    look_from: Vec3,
) -> Result<Vec<u8>, Box<dyn Error>> {
    use frangible_draw::{ModeSheetOptions, mode_sheet};
    use frangible_photo::encode_png;

    let cells: Vec<_> = (0..count.min(asset.modes().count()))
        .map(|mode| cell(asset, mode, rotation))
        .collect();
    // Three rows for twelve, as wide as a page.
    let columns = (1.34 * cells.len() as f64).sqrt().round().max(1.0) as u32;
    let options = ModeSheetOptions {
        columns,
        look_from,
        legend: vec![
            "Von Mises stress over its 99th percentile at the surface nodes".into(),
            format!(
                "Largest displacement drawn as {:.0} % of the body's diagonal",
                100.0 * EXAGGERATION
            ),
        ],
        ..ModeSheetOptions::default()
    };
    Ok(encode_png(&mode_sheet(&cells, &options)?)?)
}

/// Without the feature there are none.
#[cfg(not(feature = "view"))]
pub(crate) fn picture(_: &Asset, _: usize, _: Quat, _: Vec3) -> Result<Vec<u8>, Box<dyn Error>> {
    Err("drawing mode shapes requires a build with `--features view`; --vtu writes them for ParaView".into())
}

/// A mode on the outer surface, turned as its scene turns it.
#[cfg(feature = "view")]
fn cell(asset: &Asset, mode: usize, rotation: Quat) -> frangible_draw::ModeCell {
    let field = mode_on_fracture_mesh(asset, mode);
    let nodes = &asset.fracture().positions;
    let low = nodes.iter().fold(Vec3::INFINITY, |low, &p| low.min(p));
    let high = nodes
        .iter()
        .fold(Vec3::NEG_INFINITY, |high, &p| high.max(p));
    let largest = field.largest_displacement().max(f32::MIN_POSITIVE);
    let scale = EXAGGERATION * low.distance(high) / largest;

    // Only nodes of the surface: those inside would count for the scale of the colours.
    let mut place = vec![u32::MAX; nodes.len()];
    let (mut positions, mut stresses) = (Vec::new(), Vec::new());
    let mut triangles = Vec::with_capacity(asset.surface().triangles.len());
    for triangle in &asset.surface().triangles {
        triangles.push(triangle.map(|node| {
            let node = node as usize;
            if place[node] == u32::MAX {
                place[node] = positions.len() as u32;
                positions.push(rotation * (nodes[node] + scale * field.displacements[node]));
                stresses.push(von_mises(&field.stresses[node]));
            }
            place[node]
        }));
    }
    let most = stresses.iter().copied().fold(f32::MIN_POSITIVE, f32::max);
    // A peak in one sharp corner would leave all else dark.
    let mut sorted = stresses.clone();
    sorted.sort_by(f32::total_cmp);
    let full = sorted
        .get(sorted.len() * 99 / 100)
        .map_or(most, |s| s.max(f32::MIN_POSITIVE));
    // Pa per unit amplitude over 1/√kg: Pa/m; 1e-9 of it is MPa/mm.
    let per_millimetre = 1e-9 * f64::from(most) / f64::from(largest);
    frangible_draw::ModeCell {
        positions,
        triangles,
        values: stresses.iter().map(|s| (s / full).min(1.0)).collect(),
        caption: format!("{}   {} Hz", mode + 1, hertz(asset.modes().frequency(mode))),
        note: format!("largest {} MPa per mm", three_digits(per_millimetre)),
    }
}

#[cfg(feature = "view")]
fn hertz(frequency: f64) -> String {
    if frequency < 1000.0 {
        format!("{frequency:.1}")
    } else {
        format!("{frequency:.0}")
    }
}

#[cfg(feature = "view")]
fn three_digits(value: f64) -> String {
    let decimals = (2.0 - value.abs().max(1e-6).log10().floor()).clamp(0.0, 6.0);
    format!("{value:.*}", decimals as usize)
}

/// The elements that carry the modes, with all shapes and stresses.
pub(crate) fn analysis_vtu(asset: &Asset) -> Result<Vec<u8>, ExportError> {
    let cells = VtuCells::Quadratic(&asset.analysis().elements);
    let fields = (0..asset.modes().count()).map(|i| mode_on_analysis_mesh(asset, i));
    vtu(asset, &asset.analysis().nodes, cells, fields)
}

/// The mesh that carries cracks, with the same fields.
pub(crate) fn fracture_vtu(asset: &Asset) -> Result<Vec<u8>, ExportError> {
    let cells = VtuCells::Linear(&asset.fracture().tets);
    let fields = (0..asset.modes().count()).map(|i| mode_on_fracture_mesh(asset, i));
    vtu(asset, &asset.fracture().positions, cells, fields)
}

/// Largest principal stress, in MPa meanwhile: of a light body's unit amplitude the cube of Pa overflows.
pub(crate) fn principal(stress: &Symmetric3) -> f32 {
    1e6 * largest_eigenvalue(&Symmetric3 {
        diagonal: stress.diagonal.map(|s| 1e-6 * s),
        off: stress.off.map(|s| 1e-6 * s),
    })
}

/// Shapes so scaled that their largest displacement is 1, stresses in Pa per metre of it.
fn vtu(
    asset: &Asset,
    points: &[Vec3],
    cells: VtuCells<'_>,
    fields: impl Iterator<Item = ModeField>,
) -> Result<Vec<u8>, ExportError> {
    let (mut vectors, mut scalars) = (Vec::new(), Vec::new());
    for (number, field) in (1..).zip(fields) {
        let scale = field.largest_displacement().max(f32::MIN_POSITIVE).recip();
        let shape: Vec<Vec3> = field.displacements.iter().map(|&u| scale * u).collect();
        vectors.push((format!("mode_{number:02}"), shape));
        let stresses = &field.stresses;
        let von_mises: Vec<f32> = stresses.iter().map(|s| scale * von_mises(s)).collect();
        let principal = stresses.iter().map(|s| scale * principal(s));
        scalars.push((format!("von_mises_{number:02}"), von_mises));
        scalars.push((format!("principal_{number:02}"), principal.collect()));
    }
    let vectors = vectors.iter().map(|(name, values)| VtuField {
        name,
        values: VtuValues::Vectors(values),
    });
    let scalars = scalars.iter().map(|(name, values)| VtuField {
        name,
        values: VtuValues::Scalars(values),
    });
    let point_data: Vec<VtuField<'_>> = vectors.chain(scalars).collect();
    let frequencies: Vec<f64> = (0..asset.modes().count())
        .map(|i| asset.modes().frequency(i))
        .collect();
    write_vtu(&VtuMesh {
        points,
        cells,
        point_data: &point_data,
        field_data: &[("frequencies_hz", &frequencies)],
    })
}
