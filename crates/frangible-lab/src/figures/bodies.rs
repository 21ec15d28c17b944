//! Bodies and blows of the figures.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::{Asset, Contact, Material, Striker};
use frangible_bake::{BakeSpec, Shape, bake};

use crate::Result;

/// Modes of a body, as in the paper (its Table 1).
pub(crate) const MODES: usize = 100;

/// Length of the slab's sides and its thickness, m. The paper gives none.
pub(crate) const SLAB: [f64; 3] = [0.3, 0.3, 0.006];

/// Mass, kg, radius, m, and speed, m/s, of the steel ball that hits the slab: R_c of the paper's slab is 1 GPa.
const SLAB_BALL: [f64; 3] = [0.13, 0.0158, 80.0];

/// Weak points of the slab, 1/m³. The paper gives no number; that of real glass, 4e7, makes every other tetrahedron weak, and
/// in its model, where no crack relieves another, each of them cracks.
const SLAB_WEAK_POINTS: f64 = 3e5;
/// Fracture energy G_c of the slab of Figs. 7 and 12 that γ belongs to, J/m².
const SLAB_TOUGHNESS: f64 = 90.0;

/// The paper's slab, between its "moderate" and its "high" in fineness; elements of the modes are about 16 mm
/// long, the hundredth mode's half waves 27 mm.
pub(crate) fn slab() -> Result<Arc<Asset>> {
    let [width, depth, thickness] = SLAB;
    let shape = Shape::plate(width, depth, thickness);
    let spec = BakeSpec {
        modes: MODES,
        analysis: Some(shape.size_for(2000.0)?),
        fracture: Some(shape.size_for(20_000.0)?),
        ..BakeSpec::new("slab", shape, Material::preset("paper-slab-high")?)
    };
    let slab = Arc::new(bake(&spec)?);
    Ok(changed(&slab, |m| {
        m.weak_point_density = SLAB_WEAK_POINTS;
        m.energy_depth = slab_energy_depth(m);
    }))
}

/// The slab's blow: a steel ball in the middle of its upper face.
pub(crate) fn slab_blow(slab: &Asset) -> Result<Contact> {
    let [mass, radius, speed] = SLAB_BALL;
    let steel = Material::preset("steel")?;
    let point = Vec3::Z * (0.5 * SLAB[2] as f32);
    let ball = Striker::ball(&steel, mass, radius);
    Ok(Contact::collision(slab, point, Vec3::NEG_Z, speed, ball))
}

/// A body of about so many fracture tetrahedra and so many modes.
pub(crate) fn baked(
    name: &str,
    shape: Shape,
    material: &str,
    tets: f64,
    modes: usize,
) -> Result<Arc<Asset>> {
    let spec = BakeSpec {
        modes,
        fracture: Some(shape.size_for(tets)?),
        ..BakeSpec::new(name, shape, Material::preset(material)?)
    };
    Ok(Arc::new(bake(&spec)?))
}

/// Energy depth γ of the slab of Figs. 7 and 12, m, which the paper does not give. With this one the strain energy at R_c just pays for
/// a crack of 90 J/m²; with much more no crack ever lacks energy, whatever its toughness.
fn slab_energy_depth(material: &Material) -> f64 {
    2.0 * material.youngs_modulus * SLAB_TOUGHNESS / material.strength.powi(2)
}

/// The body with other numbers of its material. Not for those that are in the modes: E, ν, ρ.
pub(crate) fn changed(asset: &Arc<Asset>, change: impl FnOnce(&mut Material)) -> Arc<Asset> {
    let mut asset = Asset::clone(asset);
    change(asset.parts_mut().material);
    Arc::new(asset)
}
