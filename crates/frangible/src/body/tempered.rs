//! Tempered and laminated walls: bodies whose material has a residual stress or plies, which have to go through one wall.
//!
//! The weak points at the faces bear that much more (`fields`), and a crack that gets below the compressed layer may end in dice (`dice`).

use std::sync::Arc;

use super::{Body, Breakable};
use crate::asset::Asset;
use crate::error::InputError;
use crate::material::Laminate;
use crate::mesh::WallFaces;

impl Asset {
    /// Checks that a body whose material has a residual stress is one wall.
    ///
    /// # Errors
    /// A body that is not.
    #[doc(hidden)]
    pub fn check_temper(&self) -> Result<(), InputError> {
        self.check_laminate()?;
        self.tempered_faces().map(|_| ())
    }

    /// Checks that a body whose material is laminated is one wall that its plies fill.
    fn check_laminate(&self) -> Result<(), InputError> {
        let Some(laminate) = &self.material.laminate else {
            return Ok(());
        };
        let wrong =
            |problem: String| InputError::laminate(&self.name, &self.material.name, &problem);
        let (positions, surface) = (&self.fracture.positions, &self.surface.triangles);
        let faces = WallFaces::of(positions, surface, &self.mass).map_err(|problem| {
            wrong(format!(
                "it is not one wall of even thickness: {problem}; give it the shape of a pane, flat or curved, or a material of one layer"
            ))
        })?;
        laminate.ply_in(faces.thickness).map(|_| ()).map_err(wrong)
    }

    /// The faces of a body, if its material has a residual stress.
    fn tempered_faces(&self) -> Result<Option<WallFaces>, InputError> {
        if self.material.residual_stress <= 0.0 {
            return Ok(None);
        }
        let (positions, surface) = (&self.fracture.positions, &self.surface.triangles);
        let faces = WallFaces::of(positions, surface, &self.mass);
        faces.map(Some).map_err(|problem| InputError::NoWall {
            asset: self.name.clone(),
            material: self.material.name.clone(),
            problem,
        })
    }
}

impl Breakable {
    /// This kind with its faces, if its material has a residual stress.
    pub(super) fn tempered(self) -> Result<Self, InputError> {
        Ok(Self {
            tempered: {
                self.asset.check_laminate()?;
                self.asset.tempered_faces()?.map(Arc::new)
            },
            ..self
        })
    }
}

impl Body {
    /// Thickness of a laminated wall, m, and its laminate.
    pub(crate) fn laminated_wall(&self) -> Option<(f64, &Laminate)> {
        let laminate = self.asset.material.laminate.as_ref()?;
        // Of a ply, with its share of the films.
        let ply = self.prepared.thickness.iter().copied().fold(0.0, f32::max);
        Some((f64::from(ply) * f64::from(laminate.plies), laminate))
    }

    /// Distance from a crack within which a film loads its ply again, m; infinite without a film.
    pub(crate) fn shear_lag(&self) -> f32 {
        let Some((wall, laminate)) = self.laminated_wall() else {
            return f32::INFINITY;
        };
        let ply = laminate.ply_in(wall).unwrap_or(wall);
        laminate.shear_lag(self.asset.material.contact_modulus(), ply) as f32
    }

    /// Its faces, if a crack that reaches the tension between them leaves dice.
    pub(crate) fn dicing_wall(&self) -> Option<&Arc<WallFaces>> {
        let wall = self.tempered.as_ref()?;
        self.asset.material.dices(wall.thickness).then_some(wall)
    }
}
