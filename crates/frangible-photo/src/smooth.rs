//! Takes the noise out of the light on matt faces.
//!
//! Light on a matt face changes slowly, but for the edges of things: each pixel
//! takes the mean of its neighbours that lie on the same face, in three rounds
//! of ever wider steps (à trous, Dammertz and others 2010). Colour, gloss and
//! glass stay as sharp as they are.

use frangible_recording::glam::Vec3A;
use rayon::prelude::*;

use crate::path::Seen;

/// Steps between the neighbours, pixels.
const STEPS: [isize; 3] = [1, 2, 4];

/// Weights of a B-spline.
const WEIGHTS: [f32; 5] = [1.0 / 16.0, 0.25, 0.375, 0.25, 1.0 / 16.0];

/// Neighbours whose normals make a smaller cosine count ever less.
const NORMAL_POWER: i32 = 24;

/// Neighbours farther behind or before by this share of the distance do not count.
const DEPTH: f32 = 0.02;

/// Shadows keep their edges: light that differs by more than this counts less.
const EDGE: f32 = 0.45;

/// The light of each pixel.
pub(crate) fn smoothed(seen: &[Seen], width: usize) -> Vec<Vec3A> {
    // Across an edge between a matt face and something else the product of means is not the mean of products.
    let whole: Vec<bool> = seen.iter().map(|pixel| pixel.matt > 0.99).collect();
    let mut light: Vec<Vec3A> = seen.iter().map(|pixel| pixel.diffuse).collect();
    for step in STEPS {
        light = round(seen, &whole, &light, width, step);
    }
    let pixels = seen.iter().zip(&whole).zip(&light);
    pixels
        .map(|((pixel, &whole), &light)| {
            let lit = if whole {
                light * pixel.albedo
            } else {
                pixel.lit
            };
            pixel.light + lit
        })
        .collect()
}

fn round(seen: &[Seen], whole: &[bool], light: &[Vec3A], width: usize, step: isize) -> Vec<Vec3A> {
    let height = (seen.len() / width) as isize;
    let one = |at: usize| {
        if !whole[at] {
            return light[at];
        }
        let (x, y) = ((at % width) as isize, (at / width) as isize);
        let here = &seen[at];
        let (mut sum, mut weights) = (Vec3A::ZERO, 0.0);
        for (row, dy) in (-2..=2).enumerate() {
            for (column, dx) in (-2..=2).enumerate() {
                let (nx, ny) = (x + dx * step, y + dy * step);
                if nx < 0 || ny < 0 || nx >= width as isize || ny >= height {
                    continue;
                }
                let near = ny as usize * width + nx as usize;
                let other = &seen[near];
                let apart = (other.distance - here.distance).abs();
                if !whole[near] || apart > DEPTH * here.distance * step as f32 {
                    continue;
                }
                let cosine = here
                    .normal
                    .normalize_or_zero()
                    .dot(other.normal.normalize_or_zero());
                let difference = (light[near] - light[at]).length() / EDGE;
                let weight = WEIGHTS[row]
                    * WEIGHTS[column]
                    * cosine.max(0.0).powi(NORMAL_POWER)
                    * (-difference * difference).exp();
                sum += weight * light[near];
                weights += weight;
            }
        }
        if weights > 0.0 {
            sum / weights
        } else {
            light[at]
        }
    };
    (0..seen.len()).into_par_iter().map(one).collect()
}
