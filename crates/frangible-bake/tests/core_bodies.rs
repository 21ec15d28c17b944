//! The small bodies that the tests of `frangible` break are what their recipes here give. With `FRANGIBLE_WRITE_SEEDS=1` they are
//! written anew; `cargo xtask rebake` does that.

use std::fs;
use std::path::Path;

use frangible::glam::{DVec3, Vec3};
use frangible::internals::asset::{
    Blending, Image, ImageKind, RenderMaterial, RenderSurface, SaveOptions, Texture, TextureSlot,
    Wrap,
};
use frangible::{Asset, Material};
use frangible_bake::{BakeSpec, Region, Shape, Support, bake};

/// Most bytes of a body: they are part of the repository and of the published package.
const MOST_BYTES: usize = 150_000;

/// A pane that is a wall everywhere, a block that is none, a shelf that is held at one end, and a tile with everything that an author can give to a
/// surface.
fn recipes() -> [BakeSpec; 4] {
    let recipe = |name: &str, shape: Shape, material: &str, [elements, tets]: [f64; 2]| BakeSpec {
        modes: 24,
        analysis: Some(shape.size_for(elements).unwrap()),
        fracture: Some(shape.size_for(tets).unwrap()),
        ..BakeSpec::new(name, shape, Material::preset(material).unwrap())
    };
    let held = Region::Box {
        low: DVec3::splat(-1.0),
        high: DVec3::new(0.02, 1.0, 1.0),
    };
    [
        recipe(
            "pane",
            Shape::plate(0.2, 0.2, 0.004),
            "glass",
            [100.0, 600.0],
        ),
        recipe(
            "block",
            Shape::block([0.21, 0.1, 0.05]),
            "brick",
            [60.0, 700.0],
        ),
        BakeSpec {
            supports: vec![Support::clamped(held)],
            ..recipe(
                "shelf",
                Shape::block([0.3, 0.04, 0.01]),
                "glass",
                [60.0, 600.0],
            )
        },
        BakeSpec {
            render: Some(painted(TILE)),
            ..recipe(
                "tile",
                Shape::plate(TILE[0], TILE[1], TILE[2]),
                "porcelain",
                [60.0, 400.0],
            )
        },
    ]
}

/// Sides of the tile, m.
const TILE: [f64; 3] = [0.1, 0.1, 0.006];

/// The smallest PNG: one white pixel.
const PIXEL: &[u8] = b"\x89PNG\x0d\x0a\x1a\x0a\x00\x00\x00\x0dIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x00\x00\x00\x00:~\x9bU\x00\x00\x00\x0aIDATx\xdac\xf8\x0f\x00\x01\x01\x01\x00\x1c\xb0\x8c\x99\x00\x00\x00\x00IEND\xaeB`\x82";

/// A box from the origin on whose colours and texture coordinates are linear in the place: colours are (x, y, z) over the sides, from 0 to 1, the first
/// set of coordinates (x, y), the second (2 y, z). Its front has a glaze with a texture, the rest is clay.
fn painted(sides: [f64; 3]) -> RenderSurface {
    let mut surface = RenderSurface {
        name: "painted tile".into(),
        more_uvs: vec![Vec::new()],
        materials: vec![
            RenderMaterial {
                name: "glaze".into(),
                base_color: [0.2, 0.4, 0.6, 1.0],
                metallic: 0.25,
                roughness: 0.5,
                emission: [0.5, 0.25, 0.0],
                double_sided: true,
                blending: Blending::Mask(0.75),
                textures: vec![Texture {
                    uv_set: 1,
                    wrap: [Wrap::Clamp, Wrap::Mirror],
                    ..Texture::of(TextureSlot::BaseColor, 0)
                }],
            },
            RenderMaterial {
                name: "clay".into(),
                ..RenderMaterial::default()
            },
        ],
        images: vec![Image {
            name: "glaze.png".into(),
            kind: ImageKind::Png,
            bytes: PIXEL.into(),
        }],
        ..RenderSurface::default()
    };
    for axis in 0..3 {
        for high in [0.0, 1.0] {
            let first = surface.positions.len() as u32;
            for [u, v] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                let mut share = [0.0_f32; 3];
                (share[axis], share[(axis + 1) % 3], share[(axis + 2) % 3]) = (high, u, v);
                let mut normal = Vec3::ZERO;
                normal[axis] = 2.0 * high - 1.0;
                let place = [0, 1, 2].map(|k| share[k] * sides[k] as f32);
                let [x, y, z] = share;
                surface.positions.push(place.into());
                surface.normals.push(normal);
                surface.uvs.push([x, y]);
                surface.more_uvs[0].push([2.0 * y, z]);
                surface.colors.push([x, y, z, 1.0]);
            }
            let order = match high > 0.0 {
                true => [[0, 1, 2], [0, 2, 3]],
                false => [[0, 2, 1], [0, 3, 2]],
            };
            let is_front = axis == 2 && high > 0.0;
            for corners in order {
                surface.triangles.push(corners.map(|k| first + k));
                surface.material_of_triangle.push(u32::from(!is_front));
            }
        }
    }
    surface
}

#[test]
fn the_bodies_that_the_core_breaks_are_what_their_recipes_give() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../frangible/tests/bodies");
    if !folder.is_dir() {
        println!("skipped: {} is not here", folder.display());
        return;
    }
    for recipe in recipes() {
        let name = recipe.name.clone();
        let path = folder.join(format!("{name}.frangible"));
        let asset = bake(&recipe).unwrap();
        let bytes = asset.to_bytes_with(&SaveOptions::compact());
        println!(
            "{name}: {} tetrahedra, {} elements, {} analysis nodes, {} bytes",
            asset.fracture().tets.len(),
            asset.analysis().elements.len(),
            asset.analysis().nodes.len(),
            bytes.len()
        );
        assert!(bytes.len() <= MOST_BYTES, "{name}: {} bytes", bytes.len());
        if std::env::var_os("FRANGIBLE_WRITE_SEEDS").is_some() {
            fs::write(&path, &bytes).unwrap();
        }
        let stored = Asset::load(&path)
            .unwrap_or_else(|e| panic!("{e}: set FRANGIBLE_WRITE_SEEDS=1 to write {name} anew"));
        // Another processor rounds the modes otherwise, so the bytes need not be the same.
        assert_eq!(stored.fracture().tets, asset.fracture().tets, "{name}");
        assert_eq!(stored.supported(), asset.supported(), "{name}");
        assert_eq!(stored.render(), asset.render(), "{name}");
        assert_eq!(stored.modes().count(), asset.modes().count(), "{name}");
        for mode in 0..asset.modes().count() {
            let ratio = stored.modes().frequency(mode) / asset.modes().frequency(mode);
            assert!((ratio - 1.0).abs() < 1e-6, "{name}, mode {mode}: {ratio}");
        }
    }
}
