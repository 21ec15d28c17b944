//! Draws every ready shape from three sides into one PNG each.
//!
//! `cargo run --release -p frangible-mesh --example preview_shapes -- FOLDER [HEIGHT in pixels] [SHAPE …]`

use frangible_mesh::distance::first_hit;
use frangible_mesh::glam::{DVec2, DVec3};
use frangible_mesh::{READY_SHAPES, Solid, ready_shape};
use rayon::prelude::*;
use std::error::Error;
use std::path::{Path, PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("name the folder for the pictures")?);
    let height: u32 = arguments.next().map_or(Ok(720), |text| text.parse())?;
    let asked: Vec<String> = arguments.collect();
    std::fs::create_dir_all(&folder)?;
    for name in READY_SHAPES {
        if !asked.is_empty() && !asked.iter().any(|other| other == name) {
            continue;
        }
        let shape = ready_shape(name).ok_or("a listed shape is unknown")?;
        let path = folder.join(format!("{name}.png"));
        write_png(&path, 3 * height, height, &draw(&shape, name, height))?;
        println!("{}", path.display());
    }
    Ok(())
}

/// Degrees around z from the front and above the ground, of the three views.
const VIEWS: [[f64; 2]; 3] = [[-32.0, 16.0], [-90.0, 8.0], [140.0, 38.0]];

fn colour(name: &str) -> DVec3 {
    match name {
        "piggy_bank" => DVec3::new(0.80, 0.27, 0.30),
        "rabbit" => DVec3::new(0.58, 0.40, 0.26),
        "statuette" => DVec3::new(0.76, 0.74, 0.70),
        "coffee_cup" => DVec3::new(0.06, 0.25, 0.36),
        "brick_solid" => DVec3::new(0.46, 0.12, 0.06),
        _ => DVec3::new(0.20, 0.21, 0.23),
    }
}

fn draw(shape: &dyn Solid, name: &str, height: u32) -> Vec<u8> {
    let colour = colour(name);
    let width = 3 * height;
    let pixel = |column: u32, row: u32, right: f64, down: f64| {
        let view = VIEWS[(column / height) as usize % VIEWS.len()];
        let at = DVec2::new(f64::from(column % height) + right, f64::from(row) + down);
        see(shape, colour, view, at / f64::from(height) * 2.0 - 1.0)
    };
    let rough: Vec<Vec<DVec3>> = (0..height)
        .into_par_iter()
        .map(|row| {
            (0..width)
                .map(|column| pixel(column, row, 0.5, 0.5))
                .collect()
        })
        .collect();
    // Where neighbours differ, four more rays, turned against the grid, smooth the edge.
    let fine = |column: usize, row: usize| {
        let here = rough[row][column];
        let neighbours = [(1, 0), (1, 2), (0, 1), (2, 1)];
        let edge = neighbours.iter().any(|&(right, down)| {
            let line = rough.get((row + down).wrapping_sub(1));
            let other = line.and_then(|line| line.get((column + right).wrapping_sub(1)));
            other.is_some_and(|&other| (other - here).abs().max_element() > 0.04)
        });
        if !edge {
            return here;
        }
        let rays = [
            (0.125, 0.375),
            (0.625, 0.125),
            (0.875, 0.625),
            (0.375, 0.875),
        ];
        let sum: DVec3 = rays
            .iter()
            .map(|&(right, down)| pixel(column as u32, row as u32, right, down))
            .sum();
        sum / 4.0
    };
    let rows: Vec<Vec<DVec3>> = (0..height as usize)
        .into_par_iter()
        .map(|row| {
            (0..width as usize)
                .map(|column| fine(column, row))
                .collect()
        })
        .collect();
    let byte = |light: f64| (255.0 * light.clamp(0.0, 1.0).powf(1.0 / 2.2)).round() as u8;
    rows.iter()
        .flatten()
        .flat_map(|light| light.to_array().map(byte))
        .collect()
}

/// Light along one ray; `at` from -1 to 1, right and down.
fn see(shape: &dyn Solid, colour: DVec3, view: [f64; 2], at: DVec2) -> DVec3 {
    let [low, high] = shape.bounds();
    let size = 0.5 * (high - low).length();
    let (turn, rise) = (view[0].to_radians(), view[1].to_radians());
    let forward = -DVec3::new(
        turn.sin() * rise.cos(),
        -turn.cos() * rise.cos(),
        rise.sin(),
    );
    let right = forward.cross(DVec3::Z).normalize();
    let down = forward.cross(right);
    let eye = 0.5 * (low + high) - 4.2 * size * forward;
    let ray = (forward + 0.235 * (at.x * right + at.y * down)).normalize();
    let hit = first_hit(shape, eye, ray, 6.0 * size, 2e-4 * size);
    let ground = (ray.z < 0.0).then(|| eye - eye.z / ray.z * ray);
    let sky = DVec3::new(0.80, 0.83, 0.86);
    match (hit, ground) {
        (Some(p), _) => {
            let normal = slope(shape, p, 1e-3 * size);
            shade(shape, p, normal, -ray, colour, right, size)
        }
        (None, Some(p)) => {
            let lit = shade(shape, p, DVec3::Z, -ray, DVec3::splat(0.62), right, size);
            let far = ((p - eye).length() / (9.0 * size)).min(1.0);
            lit.lerp(sky, far * far)
        }
        _ => sky,
    }
}

fn slope(shape: &dyn Solid, p: DVec3, h: f64) -> DVec3 {
    DVec3::AXES
        .iter()
        .map(|&axis| {
            axis * (shape.signed_distance(p + h * axis) - shape.signed_distance(p - h * axis))
        })
        .sum::<DVec3>()
        .normalize_or(DVec3::Z)
}

/// A key light from the upper left with its shadow, a sky darkened where the distance says that it is hidden, a sheen.
fn shade(
    shape: &dyn Solid,
    p: DVec3,
    normal: DVec3,
    to_eye: DVec3,
    colour: DVec3,
    right: DVec3,
    size: f64,
) -> DVec3 {
    let towards = DVec3::new(to_eye.x, to_eye.y, 0.0).normalize();
    let light = (0.9 * towards - 0.8 * right + 1.25 * DVec3::Z).normalize();
    let above = |q: DVec3| shape.signed_distance(q).min(q.z.max(0.0));
    let open: f64 = (1..=5)
        .map(|i| {
            let way = 0.03 * size * f64::from(i * i) / 2.5;
            (way - above(p + way * normal)).max(0.0) / way * 0.5_f64.powi(i)
        })
        .sum();
    let open = (1.0 - 0.95 * open).clamp(0.0, 1.0);
    let key = normal.dot(light).max(0.0) * shadow(shape, p + 2e-3 * size * normal, light, size);
    let half = (light + to_eye).normalize();
    let sheen =
        key * normal.dot(half).max(0.0).powi(60) * if normal == DVec3::Z { 0.0 } else { 0.35 };
    let ambient = 0.20 + 0.22 * (0.5 + 0.5 * normal.z);
    let warm = DVec3::new(1.0, 0.96, 0.9);
    let cool = DVec3::new(0.92, 0.97, 1.05);
    colour * (0.95 * key * warm + ambient * open * cool) + sheen * warm
}

/// How much of a broad light arrives: the narrowest gap on the way, by its angle.
fn shadow(shape: &dyn Solid, from: DVec3, light: DVec3, size: f64) -> f64 {
    let mut share: f64 = 1.0;
    let mut way = 4e-3 * size;
    for _ in 0..96 {
        let gap = shape.signed_distance(from + way * light);
        share = share.min(0.5 + 7.0 * gap / way);
        if share <= 0.0 {
            return 0.0;
        }
        way += gap.clamp(4e-3 * size, 0.2 * size);
        if way > 3.0 * size {
            break;
        }
    }
    share * share * (3.0 - 2.0 * share)
}

fn write_png(path: &Path, width: u32, height: u32, pixels: &[u8]) -> Result<(), Box<dyn Error>> {
    let file = std::io::BufWriter::new(std::fs::File::create(path)?);
    let mut encoder = png::Encoder::new(file, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(pixels)?;
    Ok(())
}
