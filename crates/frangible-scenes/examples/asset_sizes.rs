//! Prints what the built-in scenes' baked bodies weigh on disk, and what mode shapes in half precision save and change:
//! the tables of `docs/asset-format.md`. Takes names of scenes, or all.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;
use std::sync::Arc;

use frangible::internals::asset::SaveOptions;
use frangible::{Asset, Body, Contact, FractureConfig, InputError, Striker, impact};
use frangible_scenes::{SCENE_NAMES, bake, compacted, scene};

/// Groups of section numbers.
const GROUPS: [(&str, RangeInclusive<u32>); 6] = [
    ("fracture mesh", 16..=18),
    ("surface", 32..=35),
    ("analysis mesh", 48..=50),
    ("embedding", 64..=69),
    ("modes", 80..=84),
    ("collider", 96..=98),
];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &&&str| asked.is_empty() || asked.iter().any(|a| a == **name);
    print!("| scene, body |");
    GROUPS.iter().for_each(|(name, _)| print!(" {name} |"));
    println!(" whole | compact | mode's peak stress | impact's peak stress |");
    println!("|---|{}", "---|".repeat(GROUPS.len() + 4));
    let mut seen = BTreeSet::new();
    for name in SCENE_NAMES.iter().filter(wanted) {
        for baked in bake(&scene(name)?)? {
            let asset = &*baked.asset;
            let bytes = asset.to_bytes();
            if !seen.insert((name, asset.name().to_owned(), bytes.len())) {
                continue;
            }
            let (compact, change) = compacted(asset);
            print!("| {name}, {} |", asset.name());
            for (_, numbers) in &GROUPS {
                print!(" {:.2} |", megabytes(group(&bytes, numbers)));
            }
            print!(" {:.2} |", megabytes(bytes.len()));
            let small = compact.to_bytes_with(&SaveOptions::compact()).len();
            print!(" {:.2} |", megabytes(small));
            let of_impacts = change_of_impacts(asset, &compact)?;
            println!(" {:.2} % | {:.3} % |", 100.0 * change, 100.0 * of_impacts);
        }
    }
    Ok(())
}

fn megabytes(bytes: usize) -> f64 {
    bytes as f64 / 1e6
}

/// Bytes of the sections of these numbers, from the table at byte 32.
fn group(bytes: &[u8], numbers: &RangeInclusive<u32>) -> usize {
    let word = |row: &[u8], at: usize| u32::from_le_bytes([0, 1, 2, 3].map(|i| row[at + i]));
    let table = bytes[32..].chunks_exact(24).take(word(bytes, 20) as usize);
    let lengths = table.filter(|row| numbers.contains(&word(row, 0)));
    lengths.map(|row| word(row, 16) as usize).sum()
}

/// Largest relative change of the peak stress over eight impacts spread over the surface, by a steel ball at 3 m/s that brings a
/// tenth of the body's momentum, on a body too strong to crack.
fn change_of_impacts(exact: &Asset, compact: &Asset) -> Result<f64, InputError> {
    let [exact, compact] = [exact, compact].map(|asset| {
        let mut asset = asset.clone();
        asset.parts_mut().material.strength *= 1e6;
        Body::new(Arc::new(asset), 1)
    });
    let (exact, compact) = (exact?, compact?);
    let mut largest = 0.0_f64;
    for k in 0..8 {
        let (mesh, triangles) = (exact.asset().fracture(), &exact.asset().surface().triangles);
        let corners = triangles[k * triangles.len() / 8].map(|v| mesh.positions[v as usize]);
        let [a, b, c] = corners;
        let striker = Striker::rigid()
            .with_contact_modulus(2.3e11)
            .with_effective_mass(1.0)
            .with_curvature_radius(0.01)
            .with_restitution(0.5);
        let normal = -(b - a).cross(c - a).normalize();
        let impulse = (0.3 * exact.asset().mass().mass) as f32;
        let contact = Contact {
            impulse,
            ..Contact::strike((a + b + c) / 3.0, normal, 3.0, striker)
        };
        let mut config = FractureConfig::default();
        config.culling = false;
        let peak = |body: &Body| -> Result<f64, InputError> {
            let outcome = impact(body, std::slice::from_ref(&contact), &config)?;
            Ok(outcome.report().peak_stress)
        };
        largest = largest.max((peak(&compact)? / peak(&exact)? - 1.0).abs());
    }
    Ok(largest)
}
