//! Import of tetrahedra as shapes to bake.

use std::sync::Arc;

use frangible_mesh::{Similarity, TetInput, TetMend, mend_tets};

use crate::error::{BakeError, positive};
use crate::shapes::{AnalysisChoice, Shape, TetShape};

/// Imported tetrahedra.
#[derive(Clone, Debug)]
pub struct ImportedTets {
    /// The body, including its groups.
    pub shape: Shape,
    /// Repairs that were made.
    pub mend: TetMend,
    /// Names of the groups of tetrahedra, if there are several. They do not get different materials, because a body has only one.
    pub volumes: Vec<String>,
    /// Transform from the file's coordinates to those of the shape.
    pub similarity: Similarity,
}

/// Repairs and checks tetrahedra. `size` is the length of the longest side, m; with `None` the file is in metres.
///
/// # Errors
/// The tetrahedra do not form a body, or the size is invalid.
pub fn import_tets(
    input: &TetInput,
    size: Option<f64>,
    analysis: AnalysisChoice,
) -> Result<ImportedTets, BakeError> {
    let mut mended = mend_tets(input)?;
    let similarity = match size {
        Some(size) => {
            positive("the size, in m,", size)?;
            Similarity::resizing(input.bounds(), size)
        }
        None => Similarity::IDENTITY,
    };
    for p in &mut mended.body.positions {
        *p = similarity.apply(*p);
    }
    let volumes: Vec<String> = mended
        .groups
        .iter()
        .filter(|g| g.dimension == 3)
        .map(|g| g.name.clone())
        .collect();
    Ok(ImportedTets {
        shape: Shape::Tets(TetShape {
            body: Arc::new(mended.body),
            quadratic: mended.quadratic,
            analysis,
            groups: Arc::new(mended.groups),
        }),
        mend: mended.mend,
        volumes: if volumes.len() > 1 {
            volumes
        } else {
            Vec::new()
        },
        similarity,
    })
}
