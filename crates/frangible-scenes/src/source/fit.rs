//! Conversion of a file's unit and axes to metres, y up.

use std::path::Path;

use frangible_mesh::InputMesh;
use frangible_mesh::glam::{DVec3, Vec3};

use super::Axis;
use crate::check::SIZES;
use crate::error::SceneError;

/// Largest longest side of a body, m.
const LARGEST: f64 = SIZES[1];

/// Smallest longest side that is believed where no size is given, m.
const SMALLEST: f64 = 0.005;

/// Smaller bodies are proposed to no one, m: a few metres are no millimetres meant.
const LIKELY: f64 = 0.02;

/// Turns and scales a mesh: `up` becomes y, and the longest side `size` metres if that is given.
pub(super) fn fit(
    mesh: &mut InputMesh,
    path: &Path,
    size: Option<f64>,
    up: Axis,
) -> Result<(), SceneError> {
    let mut low = DVec3::INFINITY;
    let mut high = DVec3::NEG_INFINITY;
    for &v in mesh.triangles.iter().flatten() {
        if let Some(&p) = mesh.positions.get(v as usize) {
            low = low.min(p);
            high = high.max(p);
        }
    }
    let scale = scale([low, high], path, size)?;
    for p in &mut mesh.positions {
        let [x, y, z] = turned(p.to_array(), up);
        *p = scale * DVec3::new(x, y, z);
    }
    for n in &mut mesh.normals {
        *n = Vec3::from_array(turned(n.to_array(), up));
    }
    Ok(())
}

/// Factor that makes metres of a file's unit.
pub(super) fn scale(
    [low, high]: [DVec3; 2],
    path: &Path,
    size: Option<f64>,
) -> Result<f64, SceneError> {
    let longest = (high - low).max_element();
    if !(longest.is_finite() && longest > 0.0) {
        return Err(SceneError::File {
            path: path.to_path_buf(),
            problem: "this mesh has no extent; it needs elements with finite corners".into(),
        });
    }
    Ok(match size {
        Some(size) => size / longest,
        None if (SMALLEST..=LARGEST).contains(&longest) => 1.0,
        None => {
            // Most files that are not in metres are in millimetres.
            let millimetres = longest / 1e3;
            let likely = (LIKELY..=LARGEST).contains(&millimetres);
            return Err(SceneError::Size {
                path: path.to_path_buf(),
                longest: rounded(longest),
                example: if likely { rounded(millimetres) } else { 0.1 },
            });
        }
    })
}

/// Even permutations keep the body from being mirrored; z up turns about x, x up about z, as modellers do.
pub(super) fn turned<T: std::ops::Neg<Output = T>>([x, y, z]: [T; 3], up: Axis) -> [T; 3] {
    match up {
        Axis::X => [-y, x, z],
        Axis::Y => [x, y, z],
        Axis::Z => [x, z, -y],
    }
}

/// Rounds to three digits, for messages.
fn rounded(value: f64) -> f64 {
    let unit = 10_f64.powi(2 - value.log10().floor() as i32);
    if unit.is_finite() && unit > 0.0 {
        (value * unit).round() / unit
    } else {
        value
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron(longest: f64) -> InputMesh {
        let positions = [DVec3::ZERO, DVec3::X, 0.5 * DVec3::Y, 0.25 * DVec3::Z];
        InputMesh {
            positions: positions.map(|p| longest * p).to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
            ..InputMesh::default()
        }
    }

    fn signed_volume(mesh: &InputMesh) -> f64 {
        let corners = |t: &[u32; 3]| t.map(|v| mesh.positions[v as usize]);
        mesh.triangles
            .iter()
            .map(|t| {
                let [a, b, c] = corners(t);
                a.dot(b.cross(c)) / 6.0
            })
            .sum()
    }

    #[test]
    fn the_longest_side_becomes_the_size_and_nothing_is_mirrored() {
        for up in [Axis::X, Axis::Y, Axis::Z] {
            let mut mesh = tetrahedron(120.0);
            assert!(signed_volume(&mesh) > 0.0);
            fit(&mut mesh, Path::new("a.stl"), Some(0.12), up).unwrap();
            let expected = 0.12_f64.powi(3) * 0.5 * 0.25 / 6.0;
            assert!((signed_volume(&mesh) / expected - 1.0).abs() < 1e-12);
            let highest = mesh.positions.iter().map(|p| p.y).fold(f64::MIN, f64::max);
            let lowest = mesh.positions.iter().map(|p| p.y).fold(f64::MAX, f64::min);
            let along_up = match up {
                Axis::X => 1.0,
                Axis::Y => 0.5,
                Axis::Z => 0.25,
            };
            assert!((highest - 0.12 * along_up).abs() < 1e-12 && lowest.abs() < 1e-12);
        }
    }

    #[test]
    fn a_body_of_a_size_that_cannot_be_meant_is_refused_with_an_example() {
        let refused = |longest: f64| {
            fit(&mut tetrahedron(longest), Path::new("a.obj"), None, Axis::Y)
                .unwrap_err()
                .to_string()
        };
        let message = refused(120.0);
        assert!(
            message.contains("120 m") && message.contains("--size 0.12"),
            "{message}"
        );
        let message = refused(5.47);
        assert!(message.contains("--size 0.1"), "{message}");
        let message = refused(0.001);
        assert!(
            message.contains("0.001 m") && message.contains("--size 0.1"),
            "{message}"
        );
        fit(&mut tetrahedron(0.3), Path::new("a.obj"), None, Axis::Y).unwrap();
    }

    #[test]
    fn a_mesh_without_extent_is_refused() {
        for bad in [0.0, f64::NAN, f64::INFINITY] {
            let message = fit(
                &mut tetrahedron(bad),
                Path::new("a.obj"),
                Some(1.0),
                Axis::Y,
            );
            assert!(message.unwrap_err().to_string().contains("no extent"));
        }
        assert!(fit(&mut InputMesh::default(), Path::new("a.obj"), None, Axis::Y).is_err());
    }
}
