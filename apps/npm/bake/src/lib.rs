//! Baking of meshes, and pieces that break again, for JavaScript.
//!
//! [`Wish`], [`bake`] and [`piece`] are plain Rust; in a browser or in Node the exported functions of the same names call them. The module also
//! contains the first module of the package, so that pieces stay in the same memory.

use frangible::glam::{Vec2, Vec3};
use frangible::internals::asset::SaveOptions;
use frangible::{Asset, Body, Fracture, Material};
use frangible_bake::frangible_mesh::{InputMaterial, InputMesh, PartChoice, Similarity};
use frangible_bake::pieces::{Method, PieceError, Pieces};
use frangible_bake::{BakeError, BakeSpec, Baked, ImportOptions, Progress, import_mesh};

/// Settings for baking a mesh.
#[derive(Clone, Debug)]
pub struct Wish {
    /// Name of the body.
    pub name: String,
    /// Material of the body.
    pub material: Material,
    /// Length of the longest side, m; 0: the mesh is in metres.
    pub size: f64,
    /// Thickness of a wall along the surface, m; 0: a solid body.
    pub wall: f64,
    /// Requested number of tetrahedra.
    pub tetrahedra: usize,
    /// Number of vibration modes to keep.
    pub modes: usize,
    /// Choice of one body from a mesh of several parts; [`PartChoice::Auto`] refuses such a mesh.
    pub parts: PartChoice,
}

/// A mesh as flat lists of numbers. All but positions and indices may be empty.
#[derive(Clone, Copy, Debug, Default)]
pub struct Flat<'a> {
    /// Three numbers per vertex.
    pub positions: &'a [f32],
    /// Three per triangle.
    pub indices: &'a [u32],
    /// Three numbers per vertex.
    pub normals: &'a [f32],
    /// Texture coordinates, two per vertex.
    pub uvs: &'a [f32],
    /// Further sets of them, one after the other.
    pub more_uvs: &'a [f32],
    /// Linear red, green, blue and opacity of each vertex.
    pub colors: &'a [f32],
    /// Number of the material of each triangle.
    pub materials: &'a [u32],
}

/// Makes a mesh from flat lists of numbers.
#[must_use]
pub fn mesh(flat: &Flat<'_>) -> InputMesh {
    let vertices = flat.positions.len() / 3;
    let coordinates = |uvs: &[f32]| -> Vec<Vec2> {
        let uvs = uvs.as_chunks().0.iter();
        uvs.map(|&uv| Vec2::from_array(uv)).collect()
    };
    let vectors = |list: &[f32]| -> Vec<Vec3> {
        let list = list.as_chunks().0.iter();
        list.map(|&v| Vec3::from_array(v)).collect()
    };
    let materials = flat.materials.iter().max().map_or(0, |&most| most + 1);
    InputMesh {
        positions: (vectors(flat.positions).iter())
            .map(|p| p.as_dvec3())
            .collect(),
        triangles: flat.indices.as_chunks().0.to_vec(),
        normals: vectors(flat.normals),
        uvs: coordinates(flat.uvs),
        more_uvs: (flat.more_uvs.chunks_exact((2 * vertices).max(1)))
            .map(coordinates)
            .collect(),
        colors: (flat.colors.as_chunks().0.iter())
            .map(|color: &[f32; 4]| color.map(|part| part.clamp(0.0, 1.0)))
            .collect(),
        material_of_triangle: flat.materials.to_vec(),
        materials: vec![InputMaterial::default(); materials as usize],
        ..InputMesh::default()
    }
}

/// Bakes a mesh. Returns the body, and the transform from the mesh's positions to the body's frame.
///
/// # Errors
/// A mesh that does not describe a solid, walls too thin for the requested number of tetrahedra, an invalid number.
pub fn bake(
    mesh: &InputMesh,
    wish: &Wish,
    tell: &mut dyn FnMut(Progress),
) -> Result<(Asset, Similarity), BakeError> {
    let mut options = ImportOptions::default();
    options.size = (wish.size != 0.0).then_some(wish.size);
    options.wall = (wish.wall != 0.0).then_some(wish.wall);
    options.tets = wish.tetrahedra;
    options.parts = wish.parts.clone();
    let imported = import_mesh(mesh, &options)?;
    let spec = BakeSpec {
        modes: wish.modes,
        groups: imported.groups,
        render: imported.render,
        ..BakeSpec::new(wish.name.clone(), imported.shape, wish.material.clone())
    };
    let Baked { asset, report } = frangible_bake::bake_with(&spec, tell)?;
    let Similarity { scale, shift } = imported.similarity;
    let shift = shift - report.centre;
    Ok((asset, Similarity { scale, shift }))
}

/// Returns the contents of a `.frangible` file.
#[must_use]
pub fn file(asset: &Asset) -> Vec<u8> {
    asset.to_bytes_with(&SaveOptions::default())
}

/// Returns a fragment as a body that can break again, with its share of the weak points, strengths and cracks, and its own vibration modes;
/// `None` for an unknown fragment. `body`: the body that broke.
///
/// # Errors
/// A fragment that is too small for a finite-element mesh.
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
    use frangible_bake::frangible_mesh::PartChoice;
    use frangible_js::bindings::{Break, WasmBody};
    use js_sys::{Float32Array, Function};
    use wasm_bindgen::prelude::*;

    use super::{Flat, Wish, file, mesh};

    /// A baked body.
    #[wasm_bindgen]
    pub struct Baked {
        bytes: Vec<u8>,
        scale: f64,
        offset: Vec<f64>,
    }

    #[wasm_bindgen]
    impl Baked {
        /// Contents of its `.frangible` file.
        pub fn bytes(&mut self) -> Vec<u8> {
            std::mem::take(&mut self.bytes)
        }

        /// Scale factor from the mesh to the body.
        pub fn scale(&self) -> f64 {
            self.scale
        }

        /// Offset to add to the scaled positions, m.
        pub fn offset(&self) -> Vec<f64> {
            self.offset.clone()
        }
    }

    /// Bakes a mesh. `more`: further texture coordinates and colours. `numbers`: size, wall, tetrahedra, modes, gap (NaN for none). `words`: material,
    /// name, and `largest`, `weld` or empty for the choice of parts. Calls `tell(stage, share)` to report progress.
    ///
    /// # Errors
    /// Errors of [`bake`](super::bake), and a name that no material has.
    #[wasm_bindgen]
    pub fn bake(
        positions: &[f32],
        normals: &[f32],
        uvs: &[f32],
        more: Vec<Float32Array>,
        indices: &[u32],
        materials: &[u32],
        numbers: &[f64],
        words: Vec<String>,
        tell: &Function,
    ) -> Result<Baked, JsError> {
        let [more_uvs, colors] = [0, 1].map(|k| more.get(k).map(Float32Array::to_vec));
        let [material, name, parts] = [0, 1, 2].map(|k| words.get(k).map_or("", |word| word));
        let parts = match parts {
            "largest" => PartChoice::Largest,
            "weld" => PartChoice::Weld {
                gap: Some(numbers[4]).filter(|gap| !gap.is_nan()),
            },
            _ => PartChoice::Auto,
        };
        let wish = Wish {
            name: name.to_owned(),
            material: Material::preset(material)?,
            size: numbers[0],
            wall: numbers[1],
            tetrahedra: numbers[2] as usize,
            modes: numbers[3] as usize,
            parts,
        };
        let mut progress = |p: frangible_bake::Progress| {
            let stage = p.stage.to_string();
            // A listener that throws does not stop the bake.
            let _ = tell.call2(&JsValue::NULL, &stage.into(), &p.fraction.into());
        };
        let mesh = mesh(&Flat {
            positions,
            indices,
            normals,
            uvs,
            more_uvs: &more_uvs.unwrap_or_default(),
            colors: &colors.unwrap_or_default(),
            materials,
        });
        let (asset, placed) = super::bake(&mesh, &wish, &mut progress)?;
        Ok(Baked {
            bytes: file(&asset),
            scale: placed.scale,
            offset: placed.shift.to_array().to_vec(),
        })
    }

    /// Returns a fragment of a break as a body that can break again; `None` if it is too small.
    #[wasm_bindgen]
    pub fn piece(found: &Break, number: usize) -> Option<WasmBody> {
        let piece = super::piece(found.body(), found.fracture(), number);
        piece.ok().flatten().map(WasmBody::from)
    }
}
