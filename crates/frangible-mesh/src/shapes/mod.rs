//! Ready shapes by signed distance, at their real size: metres, z up, standing on z = 0 around x = y = 0. Those with a
//! face look along -y.

mod brick;
mod candelabrum;
mod candle;
mod chandelier;
mod coral;
mod cup;
mod curve;
mod hammer;
mod pig;
mod rabbit;
mod statuette;
mod wine_glass;

pub use brick::brick_solid;
pub use candelabrum::candelabrum;
pub use chandelier::chandelier;
pub use coral::coral;
pub use cup::coffee_cup;
pub use hammer::hammer_head;
pub use pig::piggy_bank;
pub use rabbit::rabbit;
pub use statuette::statuette;
pub use wine_glass::wine_glass;

use crate::DistanceSolid;

/// Names that [`ready_shape`] knows.
pub const READY_SHAPES: [&str; 10] = [
    "piggy_bank",
    "rabbit",
    "statuette",
    "coffee_cup",
    "brick_solid",
    "hammer_head",
    "wine_glass",
    "chandelier",
    "candelabrum",
    "coral",
];

/// The shape of that name, if it is one of [`READY_SHAPES`].
pub fn ready_shape(name: &str) -> Option<DistanceSolid> {
    match name {
        "piggy_bank" => Some(piggy_bank()),
        "rabbit" => Some(rabbit()),
        "statuette" => Some(statuette()),
        "coffee_cup" => Some(coffee_cup()),
        "brick_solid" => Some(brick_solid()),
        "hammer_head" => Some(hammer_head()),
        "wine_glass" => Some(wine_glass()),
        "chandelier" => Some(chandelier()),
        "candelabrum" => Some(candelabrum()),
        "coral" => Some(coral()),
        _ => None,
    }
}

/// The shapes are drawn in millimetres.
const MILLIMETRE: f64 = 1e-3;
