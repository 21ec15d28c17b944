//! Weakness painted with vertex colours.
//!
//! Colours are read from the rendered surface, since welding its vertices would mix colours at seams.

use frangible::internals::{Factors, Fields};
use frangible::{Asset, InputError};

/// A channel of a colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Red, the first channel.
    Red,
    /// Green, the second channel.
    Green,
    /// Blue, the third channel.
    Blue,
    /// Alpha, the opacity.
    Alpha,
}

impl Channel {
    /// All channels, in the order of a colour's components.
    pub const ALL: [Self; 4] = [Self::Red, Self::Green, Self::Blue, Self::Alpha];

    /// Returns the name of the channel in lower case.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Red => "red",
            Self::Green => "green",
            Self::Blue => "blue",
            Self::Alpha => "alpha",
        }
    }

    /// Returns the channel with this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|channel| channel.name() == name)
    }
}

/// Mapping of a vertex-colour channel to factors on the values of the material: factors at 0 and at 1, linear in between.
#[derive(Clone, Debug, PartialEq)]
pub struct Paint {
    /// The channel.
    pub channel: Channel,
    /// Factors on the tensile strength, if it differs; above 0.
    pub strength: Option<[f32; 2]>,
    /// Factors on the fracture energy, if it differs; above 0. Default: the square of the strength factor, as in [`Factors::of_strength`].
    pub toughness: Option<[f32; 2]>,
    /// Factors on the density of weak points, if it differs; 0 or above.
    pub weak_points: Option<[f32; 2]>,
    /// Depths of a groove in the surface, m, if there is one; 0 or above ([`Factors::groove`]).
    pub groove: Option<[f32; 2]>,
}

impl Paint {
    /// Makes a mapping to the strength, with the toughness that keeps the flaw size.
    #[must_use]
    pub const fn of_strength(channel: Channel, strength: [f32; 2]) -> Self {
        Self {
            channel,
            strength: Some(strength),
            toughness: None,
            weak_points: None,
            groove: None,
        }
    }

    /// Checks the factors.
    ///
    /// # Errors
    /// A factor is not finite or not positive, or the factor of weak points is negative.
    pub fn check(&self) -> Result<(), InputError> {
        for (what, factors, least) in [
            ("strength", self.strength, f32::MIN_POSITIVE),
            ("toughness", self.toughness, f32::MIN_POSITIVE),
            ("weak points", self.weak_points, 0.0),
            ("groove", self.groove, 0.0),
        ] {
            let sound = |f: &f32| f.is_finite() && *f >= least;
            if let Some(bad) = factors.iter().flatten().find(|f| !sound(f)) {
                let channel = self.channel.name();
                let must = if least > 0.0 { "above 0" } else { "0 or above" };
                return Err(InputError::Field(format!(
                    "the value of the {what} painted in {channel} is {bad}; it must be finite and {must}"
                )));
            }
        }
        Ok(())
    }

    fn lay(&self, color: [f32; 4], factors: &mut Factors) {
        let share = color[self.channel as usize];
        let at = |[none, all]: [f32; 2]| none * (1.0 - share) + all * share;
        if let Some(strength) = self.strength {
            *factors = Factors {
                weak_points: factors.weak_points,
                groove: factors.groove,
                ..Factors::of_strength(at(strength))
            };
        }
        if let Some(toughness) = self.toughness {
            factors.toughness = at(toughness);
        }
        if let Some(weak_points) = self.weak_points {
            factors.weak_points = at(weak_points);
        }
        if let Some(groove) = self.groove {
            factors.groove = at(groove);
        }
    }
}

/// Makes fields from the [vertex colours](frangible::internals::asset::RenderSurface::colors) of the asset's authored surface: each tetrahedron
/// gets the colour of the nearest surface point. Factors of later entries replace those of earlier ones.
///
/// Colours reach halfway through a wall; to weaken a wall through its whole thickness, paint both sides.
///
/// # Errors
/// The asset has no vertex colours, or a factor is invalid.
pub fn from_paint(asset: &Asset, paint: &[Paint]) -> Result<Fields, InputError> {
    paint.iter().try_for_each(Paint::check)?;
    if paint.is_empty() {
        return Ok(Fields::of_material(asset.material()));
    }
    let drawn = asset.render();
    let Some(drawn) = drawn.filter(|r| !r.triangles.is_empty() && !r.colors.is_empty()) else {
        let name = asset.name();
        return Err(InputError::Field(format!(
            "`{name}` has no vertex colours to take the weakness from; export its mesh with vertex colours and bake it again"
        )));
    };
    Fields::from_surface(asset, &drawn.positions, &drawn.triangles, |at| {
        let mut color = [0.0; 4];
        for (v, weight) in at {
            for (sum, x) in color.iter_mut().zip(drawn.colors[v]) {
                *sum += weight * x;
            }
        }
        let mut factors = Factors::ONE;
        paint.iter().for_each(|p| p.lay(color, &mut factors));
        factors
    })
}
