//! Cracks along element boundaries: tetrahedra stay whole, faces between them open (Müller et al. 2001; Smith, Witkin, Baraff,
//! *Fast and controllable simulation of the shattering of brittle objects*, 2001; `[G12 §2.2]`).
//!
//! 1. The moment of our vibration at which the tension of a weak point is the largest multiple of its strength.
//! 2. Weak points above their strength start cracks, the largest multiple first: a plane through the tetrahedron's middle across
//!    the largest tension.
//! 3. A crack runs through the tetrahedra that its plane crosses, and stops at faces that are open. Where the middles of two
//!    neighbours lie on different sides of the plane, their face opens. The energy that this asks for is G_c times the area of
//!    the faces, which zigzag; what it gets is as in ours, γ η A at that moment, and from the ledger.
//! 4. A crack takes part of the tension across it from the weak points beside it, as our release waves do in the end; of a wall's stress all
//!    counts as bending. With instant cracks, as in ours, none does.
//!
//! So weak points, strength, toughness and energy are ours; the path is the mesh's, and nothing happens in time. Left out: Smith
//! et al.'s constraint solver and their weakening of what lies beside an open face, Müller et al.'s fixed radius of a crack.

use frangible::Fragment;
use frangible::internals::stress::{STRETCHED, Skin, bent, largest_eigenvalue, principal_axes};

use super::error::CompareError;
use super::face_pieces::face_pieces;
use super::hit::Hit;
use super::moment::{Moment, Wave};
use super::plane_crack::{Faces, PlaneCrack};

/// Pieces along element boundaries, and their cost.
pub(crate) struct Separated {
    /// Largest first; one where it held.
    pub(crate) fragments: Vec<Fragment>,
    /// Area of the open faces, one side, m².
    pub(crate) crack_area: f64,
    /// Energy that opening them took, J.
    pub(crate) energy: f64,
    /// Largest strain energy of the vibration, J.
    pub(crate) available: f64,
}

/// Breaks the body along faces of its mesh.
pub(crate) fn separate(hit: Hit<'_>) -> Result<Separated, CompareError> {
    let wave = Wave::new(hit)?;
    let mut moment = wave.at(wave.most_stressed());
    let available = wave.strain_energy();
    let budget = match hit.config.is_paper() {
        true => f64::INFINITY,
        false => available,
    };
    let mut faces = Faces::new(hit.body, budget);
    open(hit, &mut moment, &mut faces);
    Ok(Separated {
        crack_area: faces.area,
        energy: faces.spent,
        available,
        fragments: face_pieces(hit.body, &faces, hit.config.crumb_share),
    })
}

/// Opens the faces.
fn open(hit: Hit<'_>, moment: &mut Moment<'_>, faces: &mut Faces<'_>) {
    let asset = hit.body.asset();
    let skin = Skin::of(asset);
    let in_wall = bent(asset.material().poisson_ratio);
    let instant = hit.config.is_paper();
    let mut starts: Vec<(f32, u32)> = Vec::new();
    for &tet in hit.body.weak_tets() {
        let tension = largest_eigenvalue(&moment.at_weak_point(tet).stress);
        let multiple = tension / hit.body.strength(tet);
        if multiple > 1.0 {
            starts.push((multiple, tet));
        }
    }
    starts.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut cracks: Vec<PlaneCrack> = Vec::new();
    for (_, tet) in starts {
        if faces.is_touched(tet) {
            continue;
        }
        let middle = asset.fracture().centroid(tet as usize);
        let mut stress = moment.at_weak_point(tet).stress;
        if !instant {
            let wall = skin.wall(asset, tet as usize);
            let beta = wall.map_or(STRETCHED, |_| in_wall);
            for crack in &cracks {
                stress = stress.released(crack.normal, crack.share_left(middle, beta));
            }
        }
        if largest_eigenvalue(&stress) > hit.body.strength(tet) {
            let normal = principal_axes(&stress).1[0].as_vec3();
            cracks.extend(faces.run(tet, normal, moment));
        }
    }
}
