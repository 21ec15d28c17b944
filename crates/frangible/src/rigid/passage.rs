//! The way of a striker through the pieces that its blow has left.
//!
//! A blow ends when its contacts part, or when what was under them is gone. The pieces around the hole are still in the striker's way, and what it
//! loses to them is part of what the blow does: an engine would find it from its colliders, its tolerance and its step, which is long against
//! the passage. So the passage is followed here. The striker is the ball that its contact says, the pieces have their own surfaces, all move
//! freely, and where the ball touches a piece and approaches it, the two get the impulse of an inelastic blow, along the line between them. What
//! this takes goes into the pieces' vibration. The pieces do not touch each other, and those that are held are not in the way: an engine finds what
//! these do.
//!
//! Thereafter an engine only moves the striker and the pieces on: it leaves their contacts out for [`APART`], as long as neither touches anything else.

use glam::{DMat3, DQuat, DVec3};

use super::Rigid;
use super::meet::meet;
use crate::mesh::{TriMesh, closest_on_triangle};
use crate::outcome::Fracture;

/// Length of a step relative to the ball against the pieces, in radii of the ball.
const STEP: f64 = 0.05;

/// Longest way that is followed, in radii.
const LONGEST: f64 = 6.0;

/// Triangles no farther than this from the line on which the ball flies may be met, in radii.
const ASIDE: f64 = 1.3;

/// Most steps: a ball that comes to rest among the pieces stays with them.
const MOST_STEPS: usize = 400;

/// Most rounds over the pieces that the ball touches in a step.
const MOST_ROUNDS: usize = 8;

/// The striker is through, or has come to rest, when its speed against the pieces is this share of what it was.
const RESTS: f64 = 0.02;

/// A striker is a ball if its centre of mass is no farther than this from the centre of its curvature at the contact, in radii.
const CENTRED: f64 = 0.05;

/// A ball on its way: where it touched the body, the direction from its centre to that place, and its radius, m.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// Point of contact, m.
    pub point: DVec3,
    /// Unit direction of the push on the body.
    pub normal: DVec3,
    /// Radius, m.
    pub radius: f64,
}

/// Time after a blow for which a striker and the pieces that it made leave each other alone, s. Measured (a ball on a pane in Rapier, 20 seeds): shorter,
/// it meets pieces again that other pieces have slowed, and loses 15 % more at 30 m/s with 0.05 s, 5 % with 0.1 s.
pub const APART: f64 = 0.25;

/// The triangles of a piece that the ball may meet, and its motion.
struct Obstacle {
    /// Number of the piece.
    piece: usize,
    /// Corners from the centre of mass, in world axes at the beginning, m.
    triangles: Vec<[DVec3; 3]>,
    /// Ball about all of them: its centre, and its radius, m.
    middle: DVec3,
    reach: f64,
    turn: DQuat,
    centre: DVec3,
}

impl Obstacle {
    /// None where the ball meets nothing of the piece on its way.
    fn new(piece: usize, mesh: &TriMesh, axes: DMat3, centre: DVec3, way: &Way) -> Option<Self> {
        let corner = |&v: &u32| axes * mesh.positions[v as usize].as_dvec3();
        let triangles: Vec<[DVec3; 3]> = (mesh.triangles.iter())
            .map(|[a, b, c]| [corner(a), corner(b), corner(c)])
            .filter(|corners| way.may_meet(corners.map(|c| centre + c)))
            .collect();
        let count = 3.0 * triangles.len() as f64;
        let middle = triangles.iter().flatten().sum::<DVec3>() / count;
        let away = triangles.iter().flatten().map(|c| c.distance(middle));
        let reach = away.fold(0.0, f64::max);
        (!triangles.is_empty()).then_some(Self {
            piece,
            triangles,
            middle,
            reach,
            turn: DQuat::IDENTITY,
            centre,
        })
    }

    /// The point of the piece nearest to the centre of a ball, if the ball touches it.
    fn touch(&self, at: DVec3, radius: f64) -> Option<DVec3> {
        let local = self.turn.inverse() * (at - self.centre);
        if local.distance(self.middle) > radius + self.reach {
            return None;
        }
        let mut nearest = (radius * radius, None);
        for corners in &self.triangles {
            let weights = closest_on_triangle(*corners, local);
            let point: DVec3 = corners.iter().zip(weights).map(|(c, w)| *c * w).sum();
            let gap = point.distance_squared(local);
            if gap <= nearest.0 {
                nearest = (gap, Some(point));
            }
        }
        nearest.1.map(|point| self.centre + self.turn * point)
    }

    fn fly(&mut self, body: &Rigid, time: f64) {
        self.centre += body.linear * time;
        self.turn = (DQuat::from_scaled_axis(body.angular * time) * self.turn).normalize();
    }
}

/// The line on which the ball flies against the pieces.
struct Way {
    from: DVec3,
    along: DVec3,
    length: f64,
    aside: f64,
}

impl Way {
    fn may_meet(&self, corners: [DVec3; 3]) -> bool {
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        let reach = corners.map(|c| c.distance(middle));
        let reach = reach
            .into_iter()
            .fold(self.aside, |a, b| a.max(self.aside + b));
        let on = (middle - self.from).dot(self.along).clamp(0.0, self.length);
        middle.distance(self.from + self.along * on) <= reach
    }
}

/// Lets a ball, whose blow has acted, fly through the pieces of the body that it broke. `meshes` are the surfaces of the pieces in this order, about
/// their centres of mass, in axes that `axes` turns to the world's. Momentum and angular momentum are kept. Returns the energy that the motion loses, J.
pub fn pass(
    pieces: &mut [Rigid],
    (meshes, axes): (&[&TriMesh], DMat3),
    striker: &mut Rigid,
    ball: Ball,
) -> f64 {
    let against = |pieces: &[Rigid], striker: &Rigid| striker.linear - common(pieces);
    let first = against(pieces, striker);
    let (mut at, speed) = (ball.point - ball.normal * ball.radius, first.length());
    let comes = first.dot(ball.normal) > 0.0 && striker.gives_way();
    if !(comes && ball.radius > 0.0 && ball.radius.is_finite() && speed.is_finite()) {
        return 0.0;
    }
    let way = Way {
        from: at,
        along: first / speed,
        length: LONGEST * ball.radius,
        aside: ASIDE * ball.radius,
    };
    let all = pieces.iter().zip(meshes).enumerate();
    let loose = all.filter(|(_, (piece, _))| piece.gives_way());
    let mut obstacles: Vec<Obstacle> = loose
        .filter_map(|(i, (piece, mesh))| Obstacle::new(i, mesh, axes, piece.centre, &way))
        .collect();
    let ahead = obstacles.iter().flat_map(|o| {
        let corners = o.triangles.iter().flatten();
        corners.map(|c| (o.centre + *c - at).dot(way.along))
    });
    let end = ahead.fold(0.0, f64::max).min(way.length) + ball.radius;
    let step = STEP * ball.radius / speed;
    let (mut lost, mut gone) = (0.0, 0.0);
    for _ in 0..MOST_STEPS {
        let touched: Vec<(usize, DVec3)> = (obstacles.iter())
            .filter_map(|o| Some((o.piece, o.touch(at, ball.radius)?)))
            .collect();
        for _ in 0..MOST_ROUNDS {
            let mut met = false;
            for &(piece, point) in &touched {
                let Some(normal) = (point - at).try_normalize() else {
                    continue;
                };
                let body = &mut pieces[piece];
                let arms = [point - body.centre, point - at];
                let less = meet(body, striker, normal, arms);
                met |= less > 0.0;
                lost += less;
            }
            if !met {
                break;
            }
        }
        let now = against(pieces, striker).dot(way.along);
        if gone > end || now < RESTS * speed {
            break;
        }
        at += striker.linear * step;
        for obstacle in &mut obstacles {
            obstacle.fly(&pieces[obstacle.piece], step);
        }
        gone += now * step;
    }
    lost
}

/// Velocity of what is hit as a whole: of its mass, or of what holds it.
fn common(pieces: &[Rigid]) -> DVec3 {
    if pieces.iter().any(|p| !p.gives_way()) {
        return DVec3::ZERO;
    }
    let mass: f64 = pieces.iter().map(|p| p.mass).sum();
    pieces.iter().map(|p| p.linear * p.mass).sum::<DVec3>() / mass
}

/// Lets the striker of a blow fly on through the fragments that it has made, by [`pass`]: a ball that struck alone and at one place. Any other striker
/// stays as it is. `pieces` are the fragments in this order, with the blow's impulses on them; `axes` and `at` place the body's frame in the world. Returns
/// the energy that the motion loses, J.
pub fn fly_through(
    fracture: &Fracture,
    (order, axes, at): (&[usize], DMat3, DVec3),
    pieces: &mut [Rigid],
    striker: &mut [Rigid],
) -> f64 {
    let ([contact], [striker]) = (&fracture.report.contacts[..], striker) else {
        return 0.0;
    };
    let ball = Ball {
        point: at + axes * contact.point.as_dvec3(),
        normal: (axes * contact.normal.as_dvec3()).normalize_or_zero(),
        radius: contact.striker_radius,
    };
    let off = striker
        .centre
        .distance(ball.point - ball.normal * ball.radius);
    if off.is_nan() || off > CENTRED * ball.radius {
        return 0.0;
    }
    let meshes: Vec<&TriMesh> = order.iter().map(|&i| &fracture.fragments[i].mesh).collect();
    pass(pieces, (&meshes, axes), striker, ball)
}
