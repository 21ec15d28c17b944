//! A triangle through which no crack runs is the one polygon that dividing it would find.

use glam::{DVec2, DVec3, Vec3};

use super::RenderSurface;
use super::overlay::{Ground, Overlay};
use super::parts::{Part, Parts};
use super::polygon::{Polygon, split};
use super::under::{Boundary, Lie, Under};
use crate::TriangleTree;

/// Triangles of a square of this side about the middle, turned by an angle, with `cells` cells a side and slightly uneven.
fn sheet(side: f64, cells: u32, turn: f64, uneven: f64) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let at = |i: u32| side * (f64::from(i) / f64::from(cells) - 0.5);
    let mut positions = Vec::new();
    for i in 0..=cells {
        for j in 0..=cells {
            let place = DVec2::from_angle(turn).rotate(DVec2::new(at(i), at(j)));
            let height = uneven * f64::from((7 * i + 13 * j) % 5);
            positions.push(place.extend(height).as_vec3());
        }
    }
    let corner = |i: u32, j: u32| i * (cells + 1) + j;
    let cell = |n: u32| {
        let (i, j) = (n / cells, n % cells);
        let [a, b, c, d] = [
            corner(i, j),
            corner(i + 1, j),
            corner(i + 1, j + 1),
            corner(i, j + 1),
        ];
        [[a, b, c], [a, c, d]]
    };
    (positions, (0..cells * cells).flat_map(cell).collect())
}

/// The triangles divided along lines that do not cross on the sheet, one label for each strip.
fn strips(positions: &[Vec3], triangles: &[[u32; 3]], lines: &[[DVec2; 2]]) -> Parts {
    let mut parts = Parts::default();
    for triangle in triangles {
        parts.begin();
        let mut rest: Polygon = triangle
            .map(|v| positions[v as usize].as_dvec3().truncate())
            .into();
        for label in 0..=lines.len() {
            let strip = match lines.get(label) {
                Some(&[from, along]) => {
                    let [left, right] = split(&rest, from, along);
                    rest = left;
                    right
                }
                None => std::mem::take(&mut rest),
            };
            for k in 2..strip.len() {
                let corners = [strip[0], strip[k - 1], strip[k]].map(|p| p.extend(0.0));
                let label = label as u32;
                parts.push(Part { corners, label });
            }
        }
    }
    parts
}

#[test]
fn what_the_cracks_tell_whole_is_one_polygon() {
    let (positions, triangles) = sheet(2.0, 9, 0.0, 0.0);
    let tree = TriangleTree::new(&positions, &triangles);
    let boundary = Boundary {
        tree: &tree,
        positions: &positions,
        triangles: &triangles,
    };
    let lines = [(-0.52, 0.13), (-0.08, -0.05), (0.41, 0.02)]
        .map(|(x, tilt)| [DVec2::new(x, 0.0), DVec2::new(tilt, 1.0)]);
    let parts = strips(&positions, &triangles, &lines);
    let (labels, cracks) = (parts.labels(), parts.cracks());
    let reach = 0.2;
    let (mut whole, mut divided) = (0, 0);
    for (cells, turn) in [(3, 0.3), (9, 0.0), (9, 0.2), (30, 0.7), (70, 0.1)] {
        let (positions, triangles) = sheet(1.2, cells, turn, 0.01);
        let surface = RenderSurface {
            positions,
            triangles,
            ..RenderSurface::default()
        };
        let under = Under::new(&surface, &boundary, reach);
        for (t, triangle) in surface.triangles.iter().enumerate() {
            assert_eq!(under.lie(t), Lie::Over);
            let corners: [DVec3; 3] = triangle.map(|v| surface.positions[v as usize].as_dvec3());
            let overlay = Overlay {
                ground: Ground::new(corners, false).unwrap(),
                reach: f64::from(reach),
                parts: &parts,
                labels: &labels,
                cracks: &cracks,
                boundary: &tree,
            };
            let found = overlay.divide(under.of(t));
            match overlay.only_label(under.of(t)) {
                Some(label) => {
                    assert_eq!(found.len(), 1, "{cells} {t}: {found:?}");
                    assert_eq!(found[0].1, label, "{cells} {t}");
                    whole += 1;
                }
                None => divided += usize::from(found.len() > 1),
            }
        }
    }
    assert!(whole > 10_000 && divided > 400, "{whole} {divided}");
}
