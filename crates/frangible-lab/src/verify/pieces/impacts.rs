//! Place and speed of the blows on a piece.

use frangible::glam::Vec3;
use frangible::{Body, Contact, FractureConfig, InputError, Material, Outcome, Striker, impact};

/// Factor of the strength for the body on which stresses are measured before any crack.
pub(crate) const STRONGER: f32 = 1e3;

/// Largest stresses to aim for, in strengths: far below, just above, well above.
pub(crate) const LEVELS: [f64; 3] = [0.5, 1.2, 3.0];

/// Speed of the first trial, and the range of speeds, m/s.
const TRIAL: f64 = 3.0;
const SPEEDS: [f64; 2] = [0.02, 100.0];

/// Ball that hits a piece that something still holds: mass as that of the piece, radius, m.
const BALL: f64 = 0.015;

/// Random numbers of 0 to 1, from the numbers of piece, blow and draw.
fn random(piece: usize, blow: usize, draw: u64) -> f64 {
    // Splitmix64.
    let mut x = (((piece as u64) << 8) | blow as u64)
        .wrapping_mul(0x9e37_79b9_7f4a_7c15)
        .wrapping_add((draw + 1).wrapping_mul(0xbf58_476d_1ce4_e5b9));
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((x ^ (x >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// A place on the surface of a piece, evenly spread over its area, and the direction inwards.
pub(crate) fn place(body: &Body, piece: usize, blow: usize) -> (Vec3, Vec3) {
    let asset = body.asset();
    let at = asset.surface_positions();
    let corners = |t: &[u32; 3]| t.map(|v| at[v as usize].as_dvec3());
    let area = |t: &[u32; 3]| {
        let [a, b, c] = corners(t);
        (b - a).cross(c - a)
    };
    let triangles = &asset.surface().triangles;
    let whole: f64 = triangles.iter().map(|t| area(t).length()).sum();
    let mut left = random(piece, blow, 0) * whole;
    let mut hit = triangles.len().saturating_sub(1);
    for (i, triangle) in triangles.iter().enumerate() {
        left -= area(triangle).length();
        if left <= 0.0 {
            hit = i;
            break;
        }
    }
    let [a, b, c] = corners(&triangles[hit]);
    let (mut y, mut z) = (random(piece, blow, 1), random(piece, blow, 2));
    if y + z > 1.0 {
        (y, z) = (1.0 - y, 1.0 - z);
    }
    let point = a + (b - a) * y + (c - a) * z;
    let inwards = -area(&triangles[hit]).normalize_or_zero();
    (point.as_vec3(), inwards.as_vec3())
}

/// A collision there at a speed, m/s: a free piece lands on stone, one that is held is hit by a steel ball of its mass.
pub(crate) fn contact(
    body: &Body,
    (point, inwards): (Vec3, Vec3),
    speed: f64,
    [stone, steel]: &[Material; 2],
) -> Contact {
    let asset = body.asset();
    let striker = if asset.is_supported() {
        Striker::ball(steel, asset.mass().mass, BALL)
    } else {
        Striker::fixed(stone)
    };
    Contact::collision(asset, point, inwards, speed, striker)
}

/// The largest tension before any crack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stress {
    /// Largest tension of all weak points, Pa.
    pub(crate) peak: f64,
    /// Place of that weak point, m, in the frame of the piece.
    pub(crate) place: Vec3,
    /// The largest share of a weak point's strength.
    pub(crate) level: f64,
}

/// The stress of a blow on a piece too strong to crack; none where it has no weak point in tension.
pub(crate) fn stress(strong: &Body, contact: &Contact) -> Result<Option<Stress>, InputError> {
    let mut config = FractureConfig::default();
    // Every weak point at every step.
    config.culling = false;
    let outcome = impact(strong, std::slice::from_ref(contact), &config)?;
    let report = outcome.report();
    let level = match &outcome {
        Outcome::Held { margin, .. } => f64::from(STRONGER) / margin,
        _ => f64::from(STRONGER),
    };
    Ok(report.peak_point.map(|place| Stress {
        peak: report.peak_stress,
        place,
        level,
    }))
}

/// Speed at which a blow at a place brings a piece to about a level.
pub(crate) fn speed_for(
    strong: &Body,
    at: (Vec3, Vec3),
    level: f64,
    materials: &[Material; 2],
) -> Result<f64, InputError> {
    let found = stress(strong, &contact(strong, at, TRIAL, materials))?;
    let trial = found.map_or(0.0, |s| s.level);
    // Nearly linear: the duration falls with the fifth root of the speed.
    let speed = if trial > 0.0 {
        TRIAL * level / trial
    } else {
        SPEEDS[1]
    };
    Ok(speed.clamp(SPEEDS[0], SPEEDS[1]))
}
