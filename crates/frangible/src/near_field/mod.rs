//! The near field: the stress that a blow makes in a wall right where it falls, which no number of modes shows (beyond the paper).
//!
//! # Idea
//!
//! A wall (pane, plate, bowl, glass) that is hit bends most within a few of its thicknesses of the contact. A hundred modes of a plate
//! 100 mm wide resolve wavelengths down to 17 mm; of the tension under a ball they show a tenth. But what they leave out is local: its
//! waves are short, and before they have run to an edge and back they are spread out. So the modal sum is *continued in
//! wave number on an infinite wall*: where the body's modes end, at angular frequency ω_c, waves of an infinite wall of the same
//! thickness and curvature go on about the contact.
//!
//! # Equations
//!
//! A wall of thickness h, D = E h³ / 12(1−ν²), mass per area μ = ρ h, is pushed by a force F(t) that is spread over a disc of
//! radius a as Hertz's pressure is, whose transform is p̂ = 3 (sin ka − ka cos ka)/(ka)³. Every wave number k is an oscillator,
//! `q̈ + d q̇ + ω(k)² q = F(t)`. Its share of the wall's bending shows at distance r as
//!
//! `κ_r + κ_θ = (1/2π) ∫ k H(k) ω² q J₀(kr) dk`, `κ_θ − κ_r = (1/2π) ∫ k H(k) ω² q J₂(kr) dk`, H = p̂ k² C / (D k⁴ + E h s),
//!
//! and as stress `σ = E z/(1−ν²) (κ_r + ν κ_θ, κ_θ + ν κ_r)`, z from the wall's middle, positive away from the load. H ω² q is what a
//! steady force bends (H F), times how far the oscillator is ahead of it or behind.
//! - C = x³ sinh x / 3(sinh²x − x²), x = kh: tension of the far face of an elastic layer over that of Kirchhoff's plate.
//! - ω(k): Mindlin's first branch (shear coefficient π²/12), with the stiffness E h s of a wall that is curved, s the mean of
//!   (κ₁ sin²θ + κ₂ cos²θ)² over all directions ([`SurfaceWalls`](crate::asset::SurfaceWalls)).
//!
//! The integral is cut into bands (`Bands`). The oscillators of a band share one frequency, so that a band is one more mode of the body,
//! which lives about the contact: a *wall oscillator*. Its load shape ξ is such that a steady force moves the contact by
//! `ξ²/ω² = p̂² Δ(k²)/4π · Γ/(D k⁴ + E h s)`, which is ξ² = p̂² Δ(k²)/(4πμ) of a thin plate. Γ is the compliance of the elastic layer
//! beyond that of a half-space, over that of Kirchhoff's plate: the half-space is Hertz's spring already, and Mindlin's shear would count it twice.
//! Together they are at once the contact's radiation,
//! Zener's dashpot 8 √(Dμ) of an infinite plate (1941), and the near field's stress. Within a band J is integrated in closed form,
//! ∫ k J₀ dk = k J₁/r and ∫ k J₂ dk = −(kr J₁ + 2 J₀)/r², so bands may be wide without ghosts at a distance. Bands
//! too high for the blow to make them ring follow the force, as one static table. Where the modes end and the bands begin is read off what
//! the modes move at the contact, `Σ ξ² = k²/4πμ`; the first bands are narrow, so that the seam does not sound (`blow/plan.rs`, `bands.rs`).
//!
//! # Changes and limits
//!
//! - It holds for a force across a wall, down to a quarter of the shortest mode's wavelength from the wall's edges (`docs/near-field.md` has
//!   the errors). Nearer it is not reflected there: between contact and edge it is of the right size only.
//! - Where curvature holds the wall more than bending does (E h s > D k⁴ / 3) there are no plane waves to continue with: modes serve.
//! - On the loaded face and inside the wall the true stress is not linear in z where kh > 1; the field's is. The far face is where
//!   cracks start.
//! - Where a contact is wider than the wall is thick, Kirchhoff's plate and the layer agree; where it is a point, the
//!   layer keeps the stress finite.
//!
//! J₀ and J₁ come from a table made with libm.

mod bands;
mod bessel;
mod field;
mod wall;

pub use crate::config::PlateTheory;
pub(crate) use bands::{Bands, Spacing};
pub(crate) use field::{Located, NearField, NearFields, NearPlace};
pub(crate) use wall::WallMaterial;
