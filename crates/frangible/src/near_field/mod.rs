//! The near field: the stress in a wall close to the contact, which no practical number of modes resolves (an extension of the paper).
//!
//! # Idea
//!
//! A struck wall (of a pane, plate, bowl or drinking glass) bends most within a few thicknesses of the contact. A hundred modes of a plate
//! 100 mm wide resolve wavelengths down to 17 mm, and only a tenth of the tension under a ball. The rest is local: its waves are short and
//! decay before they return from an edge. The modal sum is therefore *continued in wave number on an infinite wall*: above the
//! angular frequency ω_c, where the body's modes end, waves of an infinite wall of the same thickness and curvature are added around the
//! contact.
//!
//! # Equations
//!
//! A wall of thickness h, D = E h³ / 12(1−ν²), mass per area μ = ρ h, is loaded by a force F(t), distributed over a disc of
//! radius a with the Hertz pressure, whose transform is p̂ = 3 (sin ka − ka cos ka)/(ka)³. Every wave number k is an oscillator,
//! `q̈ + d q̇ + ω(k)² q = F(t)`. Its contribution to the curvature of the wall at distance r is
//!
//! `κ_r + κ_θ = (1/2π) ∫ k H(k) ω² q J₀(kr) dk`, `κ_θ − κ_r = (1/2π) ∫ k H(k) ω² q J₂(kr) dk`, H = p̂ k² C / (D k⁴ + E h s),
//!
//! and as stress `σ = E z/(1−ν²) (κ_r + ν κ_θ, κ_θ + ν κ_r)`, with z measured from the mid-surface, positive away from the load. H ω² q is the
//! response H F to a static force, times the dynamic amplification of the oscillator.
//! - C = x³ sinh x / 3(sinh²x − x²), x = kh: tension at the far face of an elastic layer relative to a Kirchhoff plate.
//! - ω(k): Mindlin's first branch (shear coefficient π²/12), with the stiffness E h s of a curved wall, s the mean of
//!   (κ₁ sin²θ + κ₂ cos²θ)² over all directions ([`SurfaceWalls`](crate::asset::SurfaceWalls)).
//!
//! The integral is divided into bands (`Bands`). The oscillators of a band share one frequency, so that a band is an additional mode of the body,
//! localized at the contact: a *wall oscillator*. Its load shape ξ is chosen so that a static force displaces the contact by
//! `ξ²/ω² = p̂² Δ(k²)/4π · Γ/(D k⁴ + E h s)`, which for a thin plate is ξ² = p̂² Δ(k²)/(4πμ). Γ is the compliance of the elastic layer
//! minus that of a half-space, relative to a Kirchhoff plate: the half-space is already the Hertz contact stiffness, which Mindlin's shear
//! would count twice. Together, the wall oscillators give both the radiation of the contact,
//! the dashpot 8 √(Dμ) of an infinite plate (Zener 1941), and the stress of the near field. Within a band J is integrated in closed form,
//! ∫ k J₀ dk = k J₁/r and ∫ k J₂ dk = −(kr J₁ + 2 J₀)/r², so bands may be wide without artefacts at a distance. Bands
//! too high to be excited dynamically follow the force statically, as one table. The transition from modes to bands follows from the mobility of
//! the modes at the contact, `Σ ξ² = k²/4πμ`; the first bands are narrow, to avoid artificial ringing at the transition (`blow/plan.rs`, `bands.rs`).
//!
//! # Changes and limits
//!
//! - It is valid for a force normal to a wall, at distances from the wall's edges of at least a quarter of the shortest modal wavelength
//!   (errors: `docs/near-field.md`). Closer to an edge, its reflection is missing, and the stress between contact and edge is only of the right
//!   order.
//! - If curvature stiffens the wall more than bending (E h s > D k⁴ / 3), there are no plane waves, and only modes are used.
//! - For kh > 1, the true stress on the loaded face and inside the wall is not linear in z, unlike that of the near field. Cracks start at the
//!   far face.
//! - For contacts wider than the wall thickness, the Kirchhoff plate and the elastic layer agree; for point contacts, the layer keeps the
//!   stress finite.
//!
//! J₀ and J₁ come from a table made with libm.

mod bands;
mod bessel;
mod field;
mod wall;

pub use crate::config::PlateTheory;
pub(crate) use bands::{Bands, Spacing};
pub(crate) use field::{Located, NearField, NearFields, NearPlace, NearShapes};
pub(crate) use wall::WallMaterial;
