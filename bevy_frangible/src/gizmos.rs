//! Gizmos for debugging breaks: weak points, the contacts of the last blow, and the point of highest stress.

use bevy::prelude::*;
use frangible::ImpactReport;
use frangible::internals::outcome::ContactReport;

use crate::meshes::out;
use crate::{BreakableBody, Broke, Held};

/// Plugin that draws [`FrangibleGizmos`] over all breakable bodies. Requires Bevy's `GizmoPlugin`, which is part of `DefaultPlugins`.
#[derive(Default)]
pub struct FrangibleGizmosPlugin;

/// Settings of the gizmos. Change or disable them in Bevy's `GizmoConfigStore`.
#[derive(Clone, Reflect, GizmoConfigGroup)]
#[reflect(Default)]
pub struct FrangibleGizmos {
    /// Draw a cross at each weak point, red for the weakest and paler for stronger ones. Default on.
    pub weak_points: bool,
    /// Draw an arrow for each contact of the last blow, and a ball at its highest stress. Default on.
    pub blows: bool,
    /// Half the length of a cross, and radius of the ball, m. Default 2e-3.
    pub size: f32,
    /// Length of an arrow per impulse, m/(N·s). Default 0.1.
    pub scale: f32,
}

impl Default for FrangibleGizmos {
    fn default() -> Self {
        Self {
            weak_points: true,
            blows: true,
            size: 2e-3,
            scale: 0.1,
        }
    }
}

/// The last blow on a body, which may have broken it.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct LastBlow {
    /// Position of each contact, m, body frame, and its impulse, N·s.
    pub contacts: Vec<(Vec3, Vec3)>,
    /// Point of highest stress, m, body frame; `None` if no weak point had to be evaluated.
    pub peak: Option<Vec3>,
    /// That stress over the strength.
    pub share: f32,
}

impl LastBlow {
    fn new(report: &ImpactReport) -> Self {
        let contacts = report.contacts.iter();
        let impulse = |c: &ContactReport| out(c.normal) * c.impulse as f32;
        Self {
            contacts: contacts.map(|c| (out(c.point), impulse(c))).collect(),
            peak: report.peak_point.map(out),
            share: (report.peak_stress / report.strength) as f32,
        }
    }
}

impl Plugin for FrangibleGizmosPlugin {
    fn build(&self, app: &mut App) {
        app.init_gizmo_group::<FrangibleGizmos>()
            .add_observer(|held: On<Held>, mut commands: Commands| {
                let blow = LastBlow::new(&held.report);
                commands.entity(held.entity).try_insert(blow);
            })
            .add_observer(|broke: On<Broke>, mut commands: Commands| {
                let blow = LastBlow::new(&broke.fracture.report);
                commands.entity(broke.entity).try_insert(blow);
            })
            .add_systems(PostUpdate, draw.after(TransformSystems::Propagate));
        // Weak points are inside: nothing hides them.
        let mut store = app.world_mut().resource_mut::<GizmoConfigStore>();
        store.config_mut::<FrangibleGizmos>().0.depth_bias = -1.0;
    }
}

/// Colour of a share, from pale yellow to red.
fn heat(share: f32) -> Color {
    let cold = 1.0 - share.clamp(0.0, 1.0);
    Color::srgb(1.0, 0.9 * cold, 0.6 * cold * cold)
}

fn draw(
    mut gizmos: Gizmos<FrangibleGizmos>,
    bodies: Query<(&BreakableBody, &GlobalTransform)>,
    blows: Query<(&LastBlow, &GlobalTransform)>,
) {
    let what = gizmos.config_ext;
    if what.weak_points {
        for (body, place) in &bodies {
            let (body, place) = (&body.0, place.to_isometry());
            let mesh = body.asset().fracture();
            for &tet in body.weak_tets() {
                let corners = mesh.tets[tet as usize].map(|v| out(mesh.positions[v as usize]));
                let centre = corners.into_iter().sum::<Vec3>() / 4.0;
                // Half as strong again as the weakest is as good as any.
                let over = f64::from(body.strength(tet)) / body.weakest() - 1.0;
                let colour = heat(1.0 - 2.0 * over as f32);
                gizmos.cross(place * centre, what.size, colour);
            }
        }
    }
    if what.blows {
        for (blow, place) in &blows {
            let place = place.to_isometry();
            for &(at, impulse) in &blow.contacts {
                let push = place.rotation * impulse * what.scale;
                let end = place * at;
                gizmos.arrow(end - push, end, Color::WHITE);
            }
            if let Some(peak) = blow.peak {
                gizmos.sphere(place * peak, what.size, heat(blow.share));
            }
        }
    }
}
