//! Fig. 12: damping of high frequencies and the number of fragments.

use std::sync::Arc;

use frangible::glam::{Quat, Vec3};
use frangible::{Asset, Breakable, Contact, FractureConfig, Outcome, impact};
use image::RgbImage;

use crate::figures::FigureError;
use crate::figures::bodies::{changed, slab_blow, slab_inputs};
use crate::figures::draw::{Look, Model, PieceColours, add_held, add_pieces, below, beside};
use crate::figures::figure::{Claim, Figure, Findings, Picture, Table};
use crate::figures::statistics::{Damage, SEEDS, falls, mean_damage, models, pieces};
use crate::figures::workshop::Workshop;

pub(crate) const FIGURE: Figure = Figure {
    name: "fig12",
    title: "Fig. 12: effect of damping on the fragments",
    shows: "two broken plates: \"the left plate has the lowest damping value α = 0, letting high frequency modes to propagate and generate many small \
            fragments. The right plate has the highest damping value α = 1e-6, generating less fragments.\"",
    compute,
};

/// Stiffness damping α, s: the paper's two values, and a further one.
const DAMPING: [f64; 3] = [0.0, 1e-6, 1e-5];

fn compute(workshop: &mut Workshop<'_>) -> Result<Findings, FigureError> {
    let slab = workshop.slab()?;
    let contact = slab_blow(&slab)?;
    let mut table = Table::new([
        "model",
        "α, s",
        "highest mode below critical damping",
        "pieces",
        "cracks",
        "crack area, cm²",
    ]);
    let (mut rows, mut claims) = (Vec::new(), Vec::new());
    for (m, (name, config)) in models().into_iter().enumerate() {
        let (mut means, mut cells) = (Vec::new(), Vec::new());
        for (i, alpha) in DAMPING.into_iter().enumerate() {
            let share = (DAMPING.len() * m + i) as f64 / (2 * DAMPING.len()) as f64;
            workshop.tell(&format!("{name}, {SEEDS} seeds, α {alpha:.0e} s"), share);
            let plate = changed(&slab, |material| material.stiffness_damping = alpha);
            let damage = mean_damage(&plate, std::slice::from_ref(&contact), &config)?;
            table.row([
                name.into(),
                shown(alpha),
                undamped(&plate),
                format!("{:.1} ± {:.1}", damage.pieces, damage.pieces_error),
                format!("{:.1}", damage.cracks),
                format!("{:.1} ± {:.1}", 1e4 * damage.area, 1e4 * damage.area_error),
            ]);
            if [0.0, 1e-6].contains(&alpha) {
                cells.push(broken(
                    &plate,
                    &contact,
                    &config,
                    &format!("{name}, alpha {} s", shown(alpha)),
                )?);
                means.push(damage);
            }
        }
        rows.push(beside(&cells));
        claims.push(claim(name, &means));
    }
    Ok(Findings {
        picture: Picture {
            image: below(&rows),
            caption: "the slab's pieces, pulled apart, at α = 0 and 1e-6 s, paper's model and ours; a slab that holds is whole, with its cracks"
                .into(),
        },
        text: format!(
            "The slab and the blow of Fig. 7 at G_c 90 J/m². {}. Pieces are pulled apart, seed 1; means over {SEEDS} seeds. α damps mode i at the rate α ω_i²: \
             of the slab's 100 modes the highest has {:.0} Hz. How much of a mode is left after the pulse depends on α ω_i² times the pulse.",
            slab_inputs(&slab),
            slab.modes().frequency(slab.modes().count() - 1)
        ),
        claims,
        tables: vec![table],
    })
}

fn shown(alpha: f64) -> String {
    if alpha == 0.0 {
        "0".into()
    } else {
        format!("{alpha:.0e}")
    }
}

/// Number of the highest mode that still swings, of all.
fn undamped(plate: &Asset) -> String {
    let modes = plate.modes();
    let swings =
        |i: &usize| modes.damping(*i, plate.material()) < 2.0 * modes.eigenvalues[*i].sqrt();
    let count = (0..modes.count()).filter(swings).count();
    format!("{count} of {}", modes.count())
}

fn claim(name: &str, means: &[Damage]) -> Claim {
    let pieces: Vec<(f64, f64)> = means.iter().map(|d| (d.pieces, d.pieces_error)).collect();
    let shown: Vec<String> = pieces
        .iter()
        .map(|(p, e)| format!("{p:.1} ± {e:.1}"))
        .collect();
    Claim::new(
        format!(
            "α = 1e-6 s gives fewer fragments than α = 0, {name} (means differ by more than the standard errors)"
        ),
        format!("{} at 0, {} at 1e-6 s", shown[0], shown[1]),
        falls(&pieces),
    )
}

fn broken(
    plate: &Arc<Asset>,
    contact: &Contact,
    config: &FractureConfig,
    label: &str,
) -> Result<RgbImage, FigureError> {
    let body = Breakable::uniform(Arc::clone(plate))?.body(1);
    let outcome = impact(&body, std::slice::from_ref(contact), config)?;
    let mut model = Model::default();
    let colours = PieceColours {
        outside: [0.55, 0.72, 0.74, 1.0],
        inside: [0.10, 0.30, 0.30, 1.0],
    };
    let turn = Quat::IDENTITY;
    match &outcome {
        Outcome::Broke(fracture) => {
            add_pieces(&mut model, &fracture.fragments, 0.25, turn, colours);
        }
        Outcome::Held { state, .. } => {
            add_held(&mut model, plate, state.as_deref(), turn, colours);
        }
        _ => {}
    }
    let look = Look {
        from: Vec3::new(0.0, -0.6, 1.0),
        up: Vec3::Z,
        width: 498,
        height: 400,
    };
    let half = 0.5 * 1.25 * crate::figures::bodies::SLAB[0] as f32;
    let corners = [[-half, -half], [half, -half], [half, half], [-half, half]];
    let points: Vec<Vec3> = corners.map(|[x, y]| Vec3::new(x, y, 0.0)).into();
    let found = match pieces(&outcome) {
        1 => "holds".into(),
        pieces => format!("{pieces} pieces"),
    };
    Ok(look.at_points(&model, &points, &format!("{label}: {found}"))?)
}
