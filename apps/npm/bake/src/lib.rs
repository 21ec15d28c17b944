//! Meshes made breakable, and pieces that break again, in JavaScript.
//!
//! [`Wish`], [`bake`] and [`piece`] are plain; in a browser or in Node the module's functions of the same names hand numbers to them. The
//! module also has all that the package's first module has, so that pieces break in the memory that they lie in.

use frangible::glam::{Vec2, Vec3};
use frangible::internals::asset::SaveOptions;
use frangible::{Asset, Body, Fracture, Material};
use frangible_bake::frangible_mesh::{InputMesh, Similarity};
use frangible_bake::pieces::{Method, PieceError, Pieces};
use frangible_bake::{BakeError, BakeSpec, ImportOptions, Progress, import_mesh};

/// Settings for baking a mesh.
#[derive(Clone, Debug)]
pub struct Wish {
    /// Name of the body.
    pub name: String,
    /// Material of the body.
    pub material: Material,
    /// Longest side, m; 0: the mesh's unit is the metre.
    pub size: f64,
    /// Thickness of a wall along the mesh's surface, m; 0: the body is what the mesh encloses.
    pub wall: f64,
    /// Wanted tetrahedra.
    pub tetrahedra: usize,
    /// Vibration modes to keep.
    pub modes: usize,
}

/// A mesh as flat lists of numbers: three per vertex, three per triangle; normals and texture coordinates may be empty.
#[must_use]
pub fn mesh(positions: &[f32], indices: &[u32], normals: &[f32], uvs: &[f32]) -> InputMesh {
    InputMesh {
        positions: positions
            .as_chunks()
            .0
            .iter()
            .map(|&p| Vec3::from_array(p).as_dvec3())
            .collect(),
        triangles: indices.as_chunks().0.to_vec(),
        normals: normals
            .as_chunks()
            .0
            .iter()
            .map(|&n| Vec3::from_array(n))
            .collect(),
        uvs: uvs
            .as_chunks()
            .0
            .iter()
            .map(|&uv| Vec2::from_array(uv))
            .collect(),
        ..InputMesh::default()
    }
}

/// Bakes a mesh. Returns the body, and the transform from the mesh's positions to the body's frame.
///
/// # Errors
/// A mesh that cannot be meant as a solid, walls too thin for the tetrahedra wanted, an invalid number.
pub fn bake(
    mesh: &InputMesh,
    wish: &Wish,
    tell: &mut dyn FnMut(Progress),
) -> Result<(Asset, Similarity), BakeError> {
    let mut options = ImportOptions::default();
    options.size = (wish.size != 0.0).then_some(wish.size);
    options.wall = (wish.wall != 0.0).then_some(wish.wall);
    options.tets = wish.tetrahedra;
    let imported = import_mesh(mesh, &options)?;
    let spec = BakeSpec {
        modes: wish.modes,
        groups: imported.groups,
        render: imported.render,
        ..BakeSpec::new(wish.name.clone(), imported.shape, wish.material.clone())
    };
    let (asset, report) = frangible_bake::bake(&spec, tell)?;
    let Similarity { scale, shift } = imported.similarity;
    let shift = shift - report.centre;
    Ok((asset, Similarity { scale, shift }))
}

/// A body as a file.
#[must_use]
pub fn file(asset: &Asset) -> Vec<u8> {
    asset.to_bytes_with(&SaveOptions::default())
}

/// A fragment as a body that breaks again, with its share of the weak points, strengths and cracks, and vibration modes of its own; none
/// where there is no such fragment. `body`: the one that broke.
///
/// # Errors
/// A fragment that is a crumb: too small for elements of its own.
pub fn piece(body: &Body, fracture: &Fracture, number: usize) -> Result<Option<Body>, PieceError> {
    let portions = fracture.portions(body, |k, _| k == number);
    let Some(portion) = portions.into_iter().nth(number).flatten() else {
        return Ok(None);
    };
    let elastic = Pieces::default().elastic(Method::Auto, &portion, body)?;
    Ok(Some(body.piece(&portion, elastic)?))
}

/// Functions that the package exports to JavaScript.
#[cfg(target_arch = "wasm32")]
pub mod bindings {
    use frangible::Material;
    use frangible_js::bindings::{Break, WasmBody};
    use js_sys::Function;
    use wasm_bindgen::prelude::*;

    use super::{Wish, file, mesh};

    /// A baked body.
    #[wasm_bindgen]
    pub struct Baked {
        bytes: Vec<u8>,
        scale: f64,
        offset: Vec<f64>,
    }

    #[wasm_bindgen]
    impl Baked {
        /// Its file.
        pub fn bytes(&mut self) -> Vec<u8> {
            std::mem::take(&mut self.bytes)
        }

        /// Factor of the mesh's lengths.
        pub fn scale(&self) -> f64 {
            self.scale
        }

        /// Offset to add to the scaled positions, m.
        pub fn offset(&self) -> Vec<f64> {
            self.offset.clone()
        }
    }

    /// Bakes a mesh; `numbers`: size, wall, tetrahedra, modes; `tell(stage, share)` meanwhile.
    ///
    /// # Errors
    /// Errors of [`bake`](super::bake), and a name that no material has.
    #[wasm_bindgen]
    pub fn bake(
        positions: &[f32],
        normals: &[f32],
        uvs: &[f32],
        indices: &[u32],
        numbers: &[f64],
        material: &str,
        name: &str,
        tell: &Function,
    ) -> Result<Baked, JsError> {
        let wish = Wish {
            name: name.to_owned(),
            material: Material::preset(material)?,
            size: numbers[0],
            wall: numbers[1],
            tetrahedra: numbers[2] as usize,
            modes: numbers[3] as usize,
        };
        let mut progress = |p: frangible_bake::Progress| {
            let stage = p.stage.to_string();
            // A listener that throws does not stop the bake.
            let _ = tell.call2(&JsValue::NULL, &stage.into(), &p.fraction.into());
        };
        let mesh = mesh(positions, indices, normals, uvs);
        let (asset, placed) = super::bake(&mesh, &wish, &mut progress)?;
        Ok(Baked {
            bytes: file(&asset),
            scale: placed.scale,
            offset: placed.shift.to_array().to_vec(),
        })
    }

    /// A fragment of a break as a body that breaks again; none of a crumb.
    #[wasm_bindgen]
    pub fn piece(found: &Break, number: usize) -> Option<WasmBody> {
        let piece = super::piece(found.body(), found.fracture(), number);
        piece.ok().flatten().map(WasmBody::from)
    }
}
