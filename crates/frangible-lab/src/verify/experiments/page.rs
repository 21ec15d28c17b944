//! The page of the experiments. Every sentence that depends on the outcome is made from the numbers.

use super::{Experiments, masses_page, rear_star, star_page};
use crate::page::Page;
use crate::plot::Chart;
use crate::verify::{VerifyError, png};

/// Size of a chart, and side of a drawing, pixels.
const CHART: (u32, u32) = (800, 600);
const PANEL: u32 = 240;

/// A number that came out of an experiment.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Name of the number.
    pub name: String,
    /// Its value.
    pub value: f64,
    /// Its standard error.
    pub error: f64,
    /// Published value, if there is one.
    pub published: Option<f64>,
}

impl Experiments {
    /// The numbers to remember.
    #[must_use]
    pub fn figures(&self) -> Vec<Figure> {
        let mut figures = star_page::figures(&self.stars);
        figures.extend(rear_star::figures(&self.rear_stars));
        figures.extend(masses_page::figures(&self.masses));
        figures
    }

    /// The page; its pictures are `FOLDER/NAME.png`. Without timings, so that the same build writes the same page.
    ///
    /// # Errors
    /// A picture that could not be encoded.
    pub fn page(&self, folder: &str) -> Result<Page, VerifyError> {
        let text = format!(
            "# Experiments\n\nWritten by `frangible-lab experiments --write docs`, which computes it anew. Here nothing passes \
             or fails: there is no exact answer, only what was measured on other bodies. All sentences about outcomes are made \
             from the computed numbers. Errors are standard errors.\n\n{}\n{}\n{}",
            star_page::text(&self.stars, folder),
            rear_star::text(&self.rear_stars),
            masses_page::text(&self.masses, folder)
        );
        let drawn = |chart: Chart| chart.draw(CHART.0, CHART.1);
        let mut pictures = Vec::new();
        for (name, picture) in [
            ("star-law", drawn(star_page::chart(&self.stars))),
            ("masses", drawn(masses_page::chart(&self.masses))),
            (
                "star-patterns",
                star_page::patterns(&self.stars).draw(PANEL),
            ),
        ] {
            pictures.push((name.into(), png(name, &picture)?));
        }
        Ok(Page { text, pictures })
    }
}

/// Distance of a value from a reference, in words: "2.1 standard errors above", "within one standard error of".
pub(crate) fn apart(value: f64, error: f64, reference: f64) -> String {
    let side = if value > reference { "above" } else { "below" };
    if error <= 0.0 {
        return side.into();
    }
    let errors = (value - reference).abs() / error;
    if errors <= 1.0 {
        "within one standard error of".into()
    } else {
        format!("{errors:.1} standard errors {side}")
    }
}

/// "0.52 ± 0.03".
pub(crate) fn with_error(value: f64, error: f64) -> String {
    format!("{value:.2} ± {error:.2}")
}

/// Per cent without decimals.
pub(crate) fn per_cent(share: Option<f64>) -> String {
    share.map_or_else(|| "–".into(), |s| format!("{:.0} %", 100.0 * s))
}
