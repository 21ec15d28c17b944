//! Bodies of revolution: rings of vertices along the profile, with a number of vertices proportional to the circumference.

use std::f64::consts::{PI, TAU};

use frangible::glam::DVec3;

use crate::error::BakeError;
use crate::extrude::extrude;
use crate::mesh::BodyMesh;
use crate::random;
use crate::shapes::MeshSize;
use crate::shapes::profile::{Profile, distance};
use crate::sheet::{FREE, Sheet};

/// Sectors of the convex cells around the axis: 15° of a wall are nearly flat.
const CELL_SECTORS: u32 = 24;

/// Estimated tetrahedra of a body of revolution meshed with `size`.
pub(crate) fn estimate(profile: &Profile, size: MeshSize) -> f64 {
    let (area, _) = profile.area_and_volume();
    // An equilateral triangle of edge h covers √3/4 h².
    area / (0.433 * size.edge * size.edge) * 3.0 * layers(profile, size) as f64
}

fn layers(profile: &Profile, size: MeshSize) -> usize {
    let (area, volume) = profile.area_and_volume();
    if size.layers > 0 {
        size.layers
    } else {
        ((volume / area / size.edge).round() as usize).max(1)
    }
}

/// Meshes the body; with a seed the mesh is made irregular.
pub(crate) fn mesh(
    profile: &Profile,
    size: MeshSize,
    seed: Option<u64>,
) -> Result<BodyMesh, BakeError> {
    let mut sheet = rings(profile, size.edge, seed);
    let lift = |c: [f64; 2]| {
        let [r, z] = profile.middle(c[1]);
        DVec3::new(r * c[0].cos(), r * c[0].sin(), z)
    };
    sheet.flip(&lift);
    if let Some(seed) = seed {
        sheet.disorder(size.edge, seed, &lift);
    }
    sheet.relax(2, &lift);
    sheet.flip(&lift);
    let layers = layers(profile, size);
    let position = |v: usize, layer: usize| {
        let [angle, s] = sheet.coords[v];
        let [r0, z0, r1, z1] = profile.at(s);
        let t = layer as f64 / layers as f64;
        let (r, z) = (r0 + t * (r1 - r0), z0 + t * (z1 - z0));
        let r = r * girth_correction(size.edge, r);
        DVec3::new(r * angle.cos(), r * angle.sin(), z)
    };
    let bands = bands(profile);
    let cell = |triangle: usize, centroid: DVec3| {
        let s = sheet.triangles[triangle]
            .iter()
            .map(|&v| sheet.coords[v as usize][1])
            .sum::<f64>()
            / 3.0;
        let band = bands.partition_point(|&end| end < s) as u32;
        let turn = (centroid.y.atan2(centroid.x) / TAU).rem_euclid(1.0);
        // The bottom is one disc, all else is cut into sectors.
        let sector = if band == 0 {
            0
        } else {
            ((turn * f64::from(CELL_SECTORS)) as u32).min(CELL_SECTORS - 1)
        };
        band * CELL_SECTORS + sector
    };
    extrude(&sheet, layers, seed, &position, &cell)
}

/// Chords cut the circle short: vertices move out a little, so that the polygon keeps its area.
fn girth_correction(edge: f64, r: f64) -> f64 {
    let angle = edge / r.max(4.0 * edge);
    (angle / angle.sin()).sqrt()
}

/// Rings from the axis to the rim, joined by triangles.
fn rings(profile: &Profile, edge: f64, seed: Option<u64>) -> Sheet {
    let mut sheet = Sheet::default();
    let centre = sheet.push([0.0, 0.0], [false; 2], FREE);
    let mut previous: Vec<(u32, f64)> = Vec::new();
    let heights = ring_positions(profile, edge);
    let last = heights.len() - 1;
    for (k, &(s, corner)) in heights.iter().enumerate() {
        let girth = TAU * profile.middle(s)[0];
        let count = ((girth / edge).round() as usize).max(6);
        let offset = match seed {
            Some(seed) => 0.5 + 0.5 * random::symmetric(seed ^ 0x0ff5e7, k as u64),
            None => 0.5 * (k % 2) as f64,
        };
        let free = !corner && k != last;
        let line = if free { FREE } else { k as u32 };
        let ring: Vec<(u32, f64)> = (0..count)
            .map(|i| {
                let angle = TAU * (i as f64 + offset) / count as f64;
                (sheet.push([angle, s], [true, free], line), angle)
            })
            .collect();
        if previous.is_empty() {
            for i in 0..count {
                sheet
                    .triangles
                    .push([centre, ring[i].0, ring[(i + 1) % count].0]);
            }
        } else {
            zip_rings(&mut sheet, &previous, &ring);
        }
        previous = ring;
    }
    sheet
}

/// Opens two rings where they are closest to each other and fills the strip between them.
fn zip_rings(sheet: &mut Sheet, lower: &[(u32, f64)], upper: &[(u32, f64)]) {
    let start = lower[0].1;
    let gap = |angle: f64| (angle - start + PI).rem_euclid(TAU) - PI;
    let first = (0..upper.len())
        .min_by(|&i, &j| gap(upper[i].1).abs().total_cmp(&gap(upper[j].1).abs()))
        .unwrap_or(0);
    let origin = gap(upper[first].1);
    let mut open_upper: Vec<(u32, f64)> = (0..upper.len())
        .map(|i| {
            let (v, angle) = upper[(first + i) % upper.len()];
            (v, start + origin + (angle - upper[first].1).rem_euclid(TAU))
        })
        .collect();
    open_upper.push((open_upper[0].0, open_upper[0].1 + TAU));
    let mut open_lower = lower.to_vec();
    open_lower.push((lower[0].0, start + TAU));
    sheet.zip(&open_lower, &open_upper);
}

/// Arc lengths of the rings and whether each lies on a corner: √3/2 edges apart, closer in tight bends.
fn ring_positions(profile: &Profile, edge: f64) -> Vec<(f64, bool)> {
    let mut rings = Vec::new();
    for span in profile.corners.windows(2) {
        let steps = 400;
        let at = |i: usize| span[0] + (span[1] - span[0]) * i as f64 / steps as f64;
        // Number of rings up to each step: the integral of one over the local spacing.
        let mut count = vec![0.0];
        for i in 0..steps {
            let spacing =
                (0.866 * edge).min(0.9 * bend_radius(profile, 0.5 * (at(i) + at(i + 1)), span));
            count.push(count[i] + (at(i + 1) - at(i)) / spacing);
        }
        let total = (count[steps].round() as usize).max(1);
        for ring in 1..total {
            let wanted = count[steps] * ring as f64 / total as f64;
            let i = count.partition_point(|&c| c <= wanted).clamp(1, steps) - 1;
            let t = (wanted - count[i]) / (count[i + 1] - count[i]);
            rings.push((at(i) + t * (at(i + 1) - at(i)), false));
        }
        rings.push((span[1], true));
    }
    rings
}

/// Radius of curvature of the mid-line at `s`, m, from three points a short way apart within the span.
fn bend_radius(profile: &Profile, s: f64, span: &[f64]) -> f64 {
    let reach = 0.01 * profile.length();
    let (a, b, c) = (
        profile.middle((s - reach).max(span[0])),
        profile.middle(s),
        profile.middle((s + reach).min(span[1])),
    );
    let double_area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
    // Circumscribed circle: R = abc / (4 area).
    distance(a, b) * distance(b, c) * distance(c, a) / (2.0 * double_area).max(1e-30)
}

/// Arc lengths where the convex cells end: each stays within three quarters of the wall of its chord.
fn bands(profile: &Profile) -> Vec<f64> {
    let length = profile.length();
    let (area, volume) = profile.area_and_volume();
    let allowed = 0.75 * volume / area;
    let samples: Vec<f64> = (0..=400).map(|i| length * f64::from(i) / 400.0).collect();
    let mut ends = Vec::new();
    let mut start = 0;
    for i in 1..samples.len() {
        let (p, q) = (profile.middle(samples[start]), profile.middle(samples[i]));
        let bulge = if start == 0 {
            // The bottom cell turns about the axis: its bulge is its deviation from level.
            (start..=i)
                .map(|k| (profile.middle(samples[k])[1] - p[1]).abs())
                .fold(0.0, f64::max)
        } else {
            let chord = distance(p, q).max(1e-12);
            let off = |k: usize| {
                let m = profile.middle(samples[k]);
                ((q[0] - p[0]) * (m[1] - p[1]) - (q[1] - p[1]) * (m[0] - p[0])).abs() / chord
            };
            (start..=i).map(off).fold(0.0, f64::max)
        };
        let too_long = start > 0 && samples[i] - samples[start] > length / 5.0;
        if bulge > allowed || too_long {
            ends.push(samples[i - 1]);
            start = i - 1;
        }
    }
    ends
}
