//! Checks of the fracture's switches and numbers.

use frangible::FractureConfig;
use frangible::internals::DurationModel;

use super::Fault;
use super::quantity::{quantity, range};

pub(super) fn check_fracture(config: &FractureConfig) -> Result<(), Fault> {
    range(
        "fracture.samples_per_period",
        "the number of samples per period",
        config.samples_per_period,
        0.1,
        1000.0,
        "above 0.1 and at most 1000",
    )?;
    if !(0.0..1.0).contains(&config.crumb_share) {
        return Err(quantity(
            "fracture.crumb_share",
            "the crumbs' share",
            config.crumb_share,
            "0 or more and below 1",
        ));
    }
    let duration = config.load_duration;
    if !(duration.is_finite() && duration >= 0.0) {
        return Err(quantity(
            "fracture.load_duration",
            "how long loads rest",
            duration,
            "a finite time, 0 s or more",
        ));
    }
    if let DurationModel::AsPrinted { c } = config.duration {
        let must = "above 0 and at most 1000";
        range("fracture.duration", "the constant c", c, 0.0, 1000.0, must)?;
    }
    Ok(())
}
