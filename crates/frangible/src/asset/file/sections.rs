//! Numbers and names of the sections.

/// A section: its number in the file, and its name in `docs/asset-format.md` and in errors.
#[derive(Clone, Copy, Debug)]
pub(super) struct Section {
    pub(super) id: u32,
    pub(super) name: &'static str,
}

macro_rules! sections {
    ($($constant:ident = $id:literal, $name:literal;)*) => {
        $(pub(super) const $constant: Section = Section { id: $id, name: $name };)*

        /// Every section there is.
        #[cfg(test)]
        pub(super) const ALL: &[Section] = &[$($constant),*];
    };
}

sections! {
    NAME = 1, "name";
    MATERIAL_NAME = 2, "material name";
    MATERIAL = 3, "material";
    MASS = 4, "mass";
    RESIDUAL_STRESS = 5, "residual stress";
    LAMINATE = 6, "laminate";
    POSITIONS = 16, "fracture positions";
    TETS = 17, "fracture tetrahedra";
    NEIGHBOURS = 18, "fracture neighbours";
    SURFACE_TRIANGLES = 32, "surface triangles";
    SURFACE_TETS = 33, "surface tetrahedra";
    SURFACE_NORMALS = 34, "surface normals";
    SURFACE_CURVATURE = 35, "surface curvature radii";
    WALL_THICKNESS = 36, "wall thicknesses";
    WALL_STIFFENING = 37, "wall stiffenings";
    WALL_MARGIN = 38, "wall margins";
    ANALYSIS_NODES = 48, "analysis nodes";
    ANALYSIS_ELEMENTS = 49, "analysis elements";
    ANALYSIS_GRADIENTS = 50, "analysis barycentric gradients";
    TET_ELEMENTS = 64, "elements of tetrahedra";
    TET_BARYCENTRIC = 65, "barycentric coordinates of tetrahedra";
    TET_OFFSETS = 66, "offsets of tetrahedra";
    NODE_ELEMENTS = 67, "elements of nodes";
    NODE_BARYCENTRIC = 68, "barycentric coordinates of nodes";
    NODE_OFFSETS = 69, "offsets of nodes";
    EIGENVALUES = 80, "eigenvalues";
    MODE_SHAPES = 81, "mode shapes";
    PEAK_STRESS = 82, "peak stress";
    HALF_SHAPES = 83, "mode shapes of half precision";
    HALF_SCALES = 84, "scales of mode shapes";
    RESIDUAL_MODES = 85, "residual modes";
    BOUND_CLUSTERS = 88, "clusters of tetrahedra";
    STRESS_BOUNDS = 89, "stress bounds";
    GRADIENT_BOUNDS = 90, "gradient bounds";
    CELL_SIZES = 96, "points per cell";
    CELL_POINTS = 97, "cell points";
    CELL_OF_TET = 98, "cells of tetrahedra";
    SUPPORTED = 99, "supported nodes";
    RENDER_POSITIONS = 112, "render positions";
    RENDER_NORMALS = 113, "render normals";
    RENDER_UVS = 114, "render texture coordinates";
    RENDER_TRIANGLES = 115, "render triangles";
    RENDER_MATERIAL_OF_TRIANGLE = 116, "render material of triangles";
    RENDER_MATERIALS = 117, "render materials";
    RENDER_NAME_LENGTHS = 118, "render material name lengths";
    RENDER_NAMES = 119, "render material names";
    RENDER_COLORS = 120, "render colours";
    RENDER_MORE_UVS = 121, "further render texture coordinates";
    RENDER_LOOKS = 122, "render material looks";
    RENDER_TEXTURES = 123, "render textures";
    RENDER_IMAGES = 124, "render images";
    RENDER_IMAGE_NAMES = 125, "render image names";
    RENDER_IMAGE_BYTES = 126, "render image bytes";
    RENDER_SRGB_COLORS = 127, "sRGB render colours";
    RENDER_NAME = 128, "render name";
}

/// The sections of the drawn surface, which a file has all of or none; colours and those after them only where there are any.
pub(super) const RENDER: [Section; 8] = [
    RENDER_POSITIONS,
    RENDER_NORMALS,
    RENDER_UVS,
    RENDER_TRIANGLES,
    RENDER_MATERIAL_OF_TRIANGLE,
    RENDER_MATERIALS,
    RENDER_NAME_LENGTHS,
    RENDER_NAMES,
];

#[cfg(test)]
mod tests {
    use super::ALL;

    #[test]
    fn numbers_and_names_of_sections_are_unique() {
        for (i, a) in ALL.iter().enumerate() {
            assert!(ALL[..i].iter().all(|b| b.id != a.id && b.name != a.name));
        }
    }
}
