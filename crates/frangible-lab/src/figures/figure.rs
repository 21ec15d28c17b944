//! The figures, in the order of the paper.

use frangible_bake::frangible_mesh::did_you_mean;
use image::RgbImage;

use crate::figures::FigureError;
use crate::figures::each;
use crate::figures::workshop::Workshop;

/// One of the paper's figures.
#[derive(Clone, Copy, Debug)]
pub struct Figure {
    /// Short name, also of its picture: `fig3`.
    pub name: &'static str,
    /// Heading: the paper's number and the subject.
    pub title: &'static str,
    /// Content of the paper's figure, Markdown.
    pub shows: &'static str,
    pub(crate) compute: Compute,
}

pub(crate) type Compute = fn(&mut Workshop<'_>) -> Result<Findings, FigureError>;

/// Results of a figure.
#[derive(Clone, Debug)]
pub struct Findings {
    /// The picture.
    pub picture: Picture,
    /// Description of the computation and of the picture, Markdown.
    pub text: String,
    /// Claims of the paper, against measurements.
    pub claims: Vec<Claim>,
    /// The measured numbers.
    pub tables: Vec<Table>,
}

/// A drawn figure.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Its pixels.
    pub image: RgbImage,
    /// Text that stands in for the picture where it is not shown.
    pub caption: String,
}

/// Something the paper says of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// The claim, and the way that it is judged, Markdown.
    pub says: String,
    /// The measurement, Markdown.
    pub measured: String,
    /// True if the measurement supports the claim.
    pub holds: bool,
}

impl Claim {
    pub(crate) fn new(says: impl Into<String>, measured: impl Into<String>, holds: bool) -> Self {
        Self {
            says: says.into(),
            measured: measured.into(),
            holds,
        }
    }
}

/// Rows of cells below a heading, Markdown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// One per column.
    pub heading: Vec<String>,
    /// Rows; each has one cell for each column.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub(crate) fn new<const N: usize>(heading: [&str; N]) -> Self {
        Self {
            heading: heading.map(String::from).into(),
            rows: Vec::new(),
        }
    }

    pub(crate) fn row<const N: usize>(&mut self, cells: [String; N]) {
        self.rows.push(cells.into());
    }
}

/// All figures.
pub const FIGURES: &[Figure] = &[
    each::scenes::FIGURE,
    each::rod::FIGURE,
    each::stiffness::FIGURE,
    each::wave::FIGURE,
    each::propagation::FIGURE,
    each::toughness::FIGURE,
    each::labels::FIGURE,
    each::surface::FIGURE,
    each::damping::FIGURE,
    each::chocolate::FIGURE,
];

/// The figures of these names, all without one, in the order of the paper.
///
/// # Errors
/// A name that no figure has, with those that there are.
pub fn figures_named(names: &[String]) -> Result<Vec<&'static Figure>, FigureError> {
    let known = || FIGURES.iter().map(|f| f.name);
    for name in names {
        if !known().any(|k| k == name) {
            return Err(FigureError::UnknownFigure {
                hint: did_you_mean(name, known()),
                name: name.clone(),
                known: known().collect::<Vec<_>>().join(", "),
            });
        }
    }
    let wanted = |f: &&Figure| names.is_empty() || names.iter().any(|n| n == f.name);
    Ok(FIGURES.iter().filter(wanted).collect())
}

/// Computes these figures one after the other; bodies that several need are baked once. `progress` receives the current step and the share of all
/// that is done, 0..=1; `done` gets each figure as it is finished.
///
/// # Errors
/// The first error, or one that `done` returned.
pub fn compute<E: From<FigureError>>(
    figures: &[&'static Figure],
    progress: &mut dyn FnMut(&str, f64),
    done: &mut dyn FnMut(&'static Figure, Findings) -> Result<(), E>,
) -> Result<(), E> {
    let mut workshop = Workshop::new(progress, figures.len());
    for figure in figures {
        workshop.begin(figure.name);
        let findings = (figure.compute)(&mut workshop)?;
        workshop.end();
        done(figure, findings)?;
    }
    Ok(())
}
