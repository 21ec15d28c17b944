//! Crockery of the shop: five kinds of cups, plates, bowls, vases and bottles, baked for a game: coarse and quick.

use std::sync::Arc;

use frangible::{Breakable, Material};
use frangible_bake::{BakeSpec, Shape, Station, bake};

use frangible_lab::Result;

/// Tetrahedra of a fracture mesh, at least, and quadratic ones of the analysis mesh.
const TETS: [f64; 2] = [1500.0, 1500.0];
const MODES: usize = 40;

/// A kind of object, and the height of its centre of mass above its foot, m.
pub(crate) struct Kind {
    pub(crate) breakable: Breakable,
    pub(crate) foot: f32,
}

/// Bakes all kinds; some seconds each.
pub(crate) fn bake_all() -> Result<Vec<Kind>> {
    let shapes = [
        ("cup", cup(), "porcelain"),
        ("plate", scaled(&Shape::dinner_plate(), 0.6), "porcelain"),
        ("bowl", scaled(&Shape::bowl(), 0.9), "porcelain"),
        ("vase", Shape::vase(), "porcelain"),
        ("bottle", bottle(), "glass"),
    ];
    let bake_one = |(name, shape, material): (&str, Shape, &str)| {
        let spec = BakeSpec {
            modes: MODES,
            fracture: Some(shape.size_for(TETS[0])?),
            analysis: Some(shape.size_for(TETS[1])?),
            ..BakeSpec::new(name, shape, Material::preset(material)?)
        };
        let asset = bake(&spec)?;
        let lowest = asset.fracture().positions.iter().map(|p| p.z);
        let foot = -lowest.fold(f32::INFINITY, f32::min);
        Ok(Kind {
            breakable: Breakable::uniform(Arc::new(asset))?,
            foot,
        })
    };
    shapes.into_iter().map(bake_one).collect()
}

/// A cup without a handle: Ø 84 mm, 70 mm high, wall 3 mm.
fn cup() -> Shape {
    let wall = |r: f64, z: f64| Station::smooth([r, z], [r - 0.003, z]);
    Shape::Revolution {
        profile: vec![
            Station::smooth([0.0, 0.0], [0.0, 0.005]),
            Station::smooth([0.015, 0.0], [0.015, 0.005]),
            Station::smooth([0.024, 0.0015], [0.0225, 0.006]),
            Station::smooth([0.031, 0.008], [0.0285, 0.0103]),
            wall(0.036, 0.02),
            wall(0.040, 0.045),
            wall(0.042, 0.07),
        ],
    }
}

/// A bottle: Ø 76 mm, 260 mm high, neck 28 mm, wall 3 mm.
fn bottle() -> Shape {
    let wall = |r: f64, z: f64| Station::smooth([r, z], [r - 0.003, z]);
    Shape::Revolution {
        profile: vec![
            Station::smooth([0.0, 0.0], [0.0, 0.006]),
            Station::smooth([0.025, 0.0], [0.025, 0.006]),
            Station::smooth([0.033, 0.0012], [0.0315, 0.007]),
            Station::smooth([0.0375, 0.006], [0.0348, 0.01]),
            wall(0.038, 0.03),
            wall(0.038, 0.14),
            wall(0.034, 0.17),
            wall(0.020, 0.2),
            wall(0.0145, 0.225),
            wall(0.014, 0.26),
        ],
    }
}

fn scaled(shape: &Shape, scale: f64) -> Shape {
    let Shape::Revolution { profile } = shape else {
        return shape.clone();
    };
    let station = |s: &Station| Station {
        outer: s.outer.map(|x| x * scale),
        inner: s.inner.map(|x| x * scale),
        corner: s.corner,
    };
    Shape::Revolution {
        profile: profile.iter().map(station).collect(),
    }
}
