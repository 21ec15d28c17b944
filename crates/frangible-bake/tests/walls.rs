//! Walls behind the outer surface, against closed forms: boxes, tubes, spheres, shapes meshed by a rule and meshes.

use std::sync::Arc;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::asset::SurfaceWall;
use frangible::{Asset, Material};
use frangible_bake::frangible_mesh::DistanceSolid;
use frangible_bake::{
    BakeSpec, Baked, MeshSize, Region, Shape, SolidShape, Station, Support, bake_with,
};

fn baked(shape: Shape, supports: Vec<Support>, edge: Option<f64>) -> Asset {
    let mut spec = BakeSpec::new("body", shape, Material::preset("glass").unwrap());
    spec.modes = 1;
    spec.analysis = match &spec.shape {
        Shape::Solid(_) => None,
        shape => Some(shape.size_for(200.0).unwrap()),
    };
    spec.fracture = edge.map(|edge| MeshSize { edge, layers: 0 });
    spec.supports = supports;
    let Baked { asset, report } = bake_with(&spec, |_| {}).unwrap();
    for (stage, seconds) in report.seconds {
        println!("{stage}: {seconds:.3} s");
    }
    println!("{} triangles", asset.surface().triangles.len());
    asset
}

/// Every triangle's centroid and wall.
fn walls(asset: &Asset) -> Vec<(Vec3, Option<SurfaceWall>)> {
    let centroid = |t: &[u32; 3]| {
        t.iter()
            .map(|&v| asset.fracture().positions[v as usize])
            .sum::<Vec3>()
            / 3.0
    };
    let triangles = asset.surface().triangles.iter().enumerate();
    triangles
        .map(|(t, corners)| (centroid(corners), asset.surface().walls.at(t as u32)))
        .collect()
}

fn close(found: f64, exact: f64, share: f64) -> bool {
    (found - exact).abs() <= share * exact
}

/// Largest and mean error, as shares.
fn errors(numbers: impl Iterator<Item = (f64, f64)>) -> (f64, f64, usize) {
    let (mut worst, mut sum, mut count) = (0.0_f64, 0.0, 0);
    for (found, exact) in numbers {
        let error = (found / exact - 1.0).abs();
        worst = worst.max(error);
        sum += error;
        count += 1;
    }
    (worst, sum / f64::from(count).max(1.0), count as usize)
}

#[test]
fn a_pane_is_a_flat_wall_whose_edges_are_its_rim() {
    let asset = baked(Shape::plate(0.4, 0.4, 0.004), Vec::new(), Some(0.008));
    let mut faces = 0;
    for (p, wall) in walls(&asset) {
        let [to_x, to_y] = [p.x, p.y].map(|x| 0.2 - f64::from(x.abs()));
        let to_rim = to_x.min(to_y);
        if p.z.abs() < 0.00199 {
            assert_eq!(wall, None, "the rim at {p}");
            continue;
        }
        faces += 1;
        let wall = wall.unwrap();
        assert!(close(wall.thickness, 0.004, 1e-4), "{wall:?} at {p}");
        assert!(wall.stiffening < 1e-3, "{wall:?} at {p}");
        // A third of an edge of the mesh: the mean of corners of which all may be on the rim.
        assert!(
            (wall.margin - to_rim).abs() < 0.03 * to_rim + 0.0025,
            "{wall:?}, {to_rim} at {p}"
        );
    }
    assert!(faces > 1000);
}

#[test]
fn what_holds_a_pane_is_an_edge_of_its_wall_on_both_faces() {
    let strip = Support::clamped(Region::below(0, 0.05));
    let asset = baked(Shape::plate(0.4, 0.4, 0.004), vec![strip], Some(0.008));
    let start = asset
        .supported()
        .iter()
        .map(|&v| asset.fracture().positions[v as usize].x)
        .fold(-1.0, f32::max);
    for (p, wall) in walls(&asset) {
        let Some(wall) = wall else { continue };
        let to_support = f64::from((p.x - start).max(0.0));
        let to_rim = [0.2 - p.x, 0.2 - p.y.abs()].map(f64::from);
        let exact = to_rim[0].min(to_rim[1]).min(to_support);
        assert!(
            (wall.margin - exact).abs() < 0.03 * exact + 0.008,
            "{wall:?}, {exact} at {p}"
        );
    }
}

#[test]
fn solids_have_no_walls() {
    let solid = |solid: DistanceSolid| {
        Shape::Solid(SolidShape {
            tets: 4000,
            ..SolidShape::new(Arc::new(solid))
        })
    };
    let ball = solid(DistanceSolid::sphere(DVec3::ZERO, 0.05));
    for shape in [
        Shape::block([0.1, 0.1, 0.1]),
        Shape::block([0.215, 0.1025, 0.065]),
        Shape::rod(0.3, 0.02),
        ball,
    ] {
        let asset = baked(shape.clone(), Vec::new(), None);
        assert!(asset.surface().walls.is_empty(), "{shape:?}");
    }
}

/// A cup with a straight side, as a body of revolution.
fn tube(radius: f64, thickness: f64, height: f64) -> Shape {
    let (inner, outer) = (radius - 0.5 * thickness, radius + 0.5 * thickness);
    Shape::Revolution {
        profile: vec![
            Station::smooth([0.0, 0.0], [0.0, 3.0 * thickness]),
            Station::sharp([outer, 0.0], [inner, 3.0 * thickness]),
            Station::smooth([outer, height], [inner, height]),
        ],
    }
}

#[test]
fn the_side_of_a_cup_is_a_tube() {
    let (radius, thickness, height) = (0.035, 0.002, 0.1);
    let asset = baked(tube(radius, thickness, height), Vec::new(), None);
    let (low, high) = bounds(&asset);
    let side: Vec<(Vec3, SurfaceWall)> = walls(&asset)
        .into_iter()
        .filter(|(p, _)| p.z > low + 0.02 && p.z < high - 0.01)
        .map(|(p, wall)| (p, wall.unwrap()))
        .collect();
    let thick = errors(side.iter().map(|(_, w)| (w.thickness, thickness)));
    let stiff = errors(
        side.iter()
            .map(|(_, w)| (w.stiffening, 0.375 / (radius * radius))),
    );
    let margin = errors(side.iter().map(|(p, w)| {
        let to_rim = high - p.z;
        let to_base = p.z - low - 3.0 * thickness as f32;
        (w.margin, f64::from(to_rim.min(to_base)))
    }));
    println!("thickness {thick:?}, stiffening {stiff:?}, margin {margin:?}");
    assert!(thick.0 < 0.02 && stiff.0 < 0.10 && margin.1 < 0.10);
}

fn bounds(asset: &Asset) -> (f32, f32) {
    let z = asset.fracture().positions.iter().map(|p| p.z);
    (
        z.clone().fold(f32::INFINITY, f32::min),
        z.fold(f32::NEG_INFINITY, f32::max),
    )
}

#[test]
fn a_hollow_ball_of_a_lattice_mesh_is_a_dome_without_edges() {
    let (radius, thickness) = (0.05, 0.005);
    let outer = DistanceSolid::sphere(DVec3::ZERO, radius + 0.5 * thickness);
    let inner = DistanceSolid::sphere(DVec3::ZERO, radius - 0.5 * thickness);
    let shape = Shape::Solid(SolidShape {
        tets: 30_000,
        ..SolidShape::new(Arc::new(outer.subtract(inner)))
    });
    let asset = baked(shape, Vec::new(), None);
    let all: Vec<Option<SurfaceWall>> = walls(&asset).into_iter().map(|w| w.1).collect();
    let found: Vec<SurfaceWall> = all.iter().flatten().copied().collect();
    let thick = errors(found.iter().map(|w| (w.thickness, thickness)));
    let stiff = errors(
        found
            .iter()
            .map(|w| (w.stiffening, 1.0 / (radius * radius))),
    );
    println!(
        "{} of {}; thickness {thick:?}, stiffening {stiff:?}",
        found.len(),
        all.len()
    );
    assert_eq!(found.len(), all.len());
    assert!(thick.0 < 0.02 && stiff.0 < 0.10);
    assert!(found.iter().all(|w| w.margin == f64::INFINITY));
}
