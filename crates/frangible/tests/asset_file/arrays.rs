//! Assets whose arrays do not fit together.

use super::*;

#[test]
fn arrays_that_do_not_fit_are_refused() {
    let nan = f32::NAN;
    type Change = fn(&mut Asset);
    let cases: [(Change, &str); 50] = [
        (
            |a| a.parts_mut().supported[1] = 8,
            "supported node 1 lies beyond the 8 nodes",
        ),
        (
            |a| a.parts_mut().supported[1] = 1,
            "supported nodes are not in ascending order",
        ),
        (
            |a| a.parts_mut().supported.reverse(),
            "supported nodes are not in ascending order",
        ),
        (|a| a.parts_mut().material.density = f64::NAN, "density"),
        (|a| a.parts_mut().mass.mass = 0.0, "its mass is 0"),
        (
            |a| a.parts_mut().mass.volume = f64::INFINITY,
            "its volume is inf",
        ),
        (|a| a.parts_mut().mass.centre.y = f64::NAN, "centre of mass"),
        (|a| a.parts_mut().mass.inertia.y_axis.y = -1.0, "inertia"),
        (|a| mesh(a).tets.clear(), "no tetrahedra"),
        (
            |a| mesh(a).tets[2][1] = 8,
            "tetrahedron 2 refers to a node beyond the 8",
        ),
        (|a| mesh(a).tets[3].swap(0, 1), "volume of tetrahedron 3"),
        (
            |a| mesh(a).tets[3][0] = mesh(a).tets[3][1],
            "volume of tetrahedron 3",
        ),
        (
            |a| mesh(a).positions[4].z = f32::NEG_INFINITY,
            "node 4 is not finite",
        ),
        (|a| mesh(a).neighbours.truncate(5), "neighbour row"),
        (
            |a| mesh(a).neighbours.swap(0, 1),
            "are not neighbours of each other",
        ),
        (
            |a| mesh(a).neighbours[0] = [0; 4],
            "tetrahedra 0 and 0 are not neighbours of each other",
        ),
        (
            |a| *outside(a, 1) = 6,
            "tetrahedron 1 refers to neighbour 6, but there are only 6",
        ),
        (
            |a| a.parts_mut().surface.triangles[1] = [0, 1, 99],
            "surface triangle 1 is not an outer face",
        ),
        (
            |a| a.parts_mut().surface.tets[1] = 6,
            "surface triangle 1 refers to tetrahedron 6",
        ),
        (
            |a| a.parts_mut().surface.triangles.truncate(11),
            "surface triangle per outer face",
        ),
        (
            |a| a.parts_mut().surface.triangles[1] = [0, 0, 0],
            "surface triangle 1 is not an outer face",
        ),
        (
            |a| a.parts_mut().surface.normals.clear(),
            "normal row per surface triangle",
        ),
        (
            |a| a.parts_mut().surface.curvature_radius[2] = 0.0,
            "curvature radius of surface triangle 2",
        ),
        (
            |a| a.parts_mut().surface.walls.margin.clear(),
            "one wall margin per surface triangle: 12, not 0; give every list",
        ),
        (
            |a| a.parts_mut().surface.walls.thickness[2] = 0.0,
            "wall thickness of surface triangle 2 is 0",
        ),
        (
            |a| a.parts_mut().surface.walls.thickness[3] = f32::NAN,
            "wall thickness of surface triangle 3 is NaN, not above zero; give metres",
        ),
        (
            |a| a.parts_mut().surface.walls.stiffening[4] = -1.0,
            "wall stiffening of surface triangle 4 is -1",
        ),
        (
            |a| a.parts_mut().surface.walls.margin[5] = f32::NAN,
            "wall margin of surface triangle 5 is NaN",
        ),
        (
            |a| a.parts_mut().surface.walls.margin[6] = -0.5,
            "wall margin of surface triangle 6 is -0.5",
        ),
        (
            |a| a.parts_mut().modes.residual_modes = 3,
            "3 of its 3 modes respond statically",
        ),
        (
            |a| a.parts_mut().analysis.elements[1][9] = 10,
            "analysis element 1 refers to a node beyond",
        ),
        (
            |a| a.parts_mut().analysis.barycentric_gradients.truncate(1),
            "gradient row",
        ),
        (
            |a| a.parts_mut().embedding.tets[5].element = 2,
            "embedded centroid 5 refers",
        ),
        (
            |a| a.parts_mut().embedding.nodes[7].offset.x = f32::NAN,
            "embedded node 7 is not finite",
        ),
        (
            |a| a.parts_mut().embedding.nodes.truncate(3),
            "embedded point per node",
        ),
        (
            |a| a.parts_mut().modes.eigenvalues[0] = 0.0,
            "eigenvalue of mode 0",
        ),
        (
            |a| a.parts_mut().modes.eigenvalues.reverse(),
            "rising frequency",
        ),
        (
            |a| a.parts_mut().modes.shapes[4] = f32::NAN,
            "row 1 of the mode shapes",
        ),
        (
            |a| a.parts_mut().modes.peak_stress.clear(),
            "peak stress per mode",
        ),
        (
            |a| a.parts_mut().cells[0].points[1].x = f32::INFINITY,
            "point of convex cell 0",
        ),
        (
            |a| a.parts_mut().cell_of_tet[1] = 1,
            "cell number of tetrahedron 1",
        ),
        (
            |a| drawn(a).triangles[1][0] = 4,
            "render triangle 1 refers to a vertex",
        ),
        (
            |a| drawn(a).material_of_triangle[0] = 2,
            "material number of render triangle 0",
        ),
        (|a| drawn(a).colors[2][3] = 1.5, "colour of render vertex 2"),
        (
            |a| {
                drawn(a).colors.pop();
            },
            "one colour per render vertex",
        ),
        (
            |a| drawn(a).materials[1].metallic = 1.5,
            "render material 1",
        ),
        (
            |a| drawn(a).materials[0].emission[2] = f32::NAN,
            "emission or the opacity that render material 0",
        ),
        (
            |a| drawn(a).materials[0].textures[0].image = 1,
            "texture of render material 0",
        ),
        (
            |a| drawn(a).materials[0].textures[0].uv_set = 2,
            "texture of render material 0",
        ),
        (
            |a| drawn(a).more_uvs[0][1][0] = f32::NAN,
            "further texture coordinates of render vertex 1",
        ),
    ];
    fn drawn(asset: &mut Asset) -> &mut RenderSurface {
        asset.parts_mut().render.as_mut().unwrap()
    }
    fn mesh(asset: &mut Asset) -> &mut frangible::internals::TetMesh {
        std::sync::Arc::make_mut(asset.parts_mut().fracture)
    }
    fn outside(asset: &mut Asset, tet: usize) -> &mut u32 {
        let mut row = mesh(asset).neighbours[tet].iter_mut();
        row.find(|n| **n == frangible::internals::mesh::NO_NEIGHBOUR)
            .unwrap()
    }
    assert!(tiny().validate().is_ok());
    for (change, words) in cases {
        let mut asset = tiny();
        change(&mut asset);
        let error = Asset::from_bytes(&asset.to_bytes()).unwrap_err();
        assert!(matches!(error, AssetFileError::Input(_)), "{error}");
        assert!(
            error.to_string().contains(words),
            "{error}; expected: {words}"
        );
    }
    let mut asset = tiny();
    drawn(&mut asset).normals.pop();
    drawn(&mut asset).uvs[0][1] = nan;
    let error = asset.validate().unwrap_err();
    assert!(matches!(&error, InputError::Asset { problem, .. } if problem.contains("texture")));
}
