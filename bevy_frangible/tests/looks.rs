//! Vertex colours, texture coordinates, materials and names of the file that was baked.

use crate::common::{Log, app_with, ball, bodies, body, ready};
use bevy::mesh::VertexAttributeValues;
use bevy::prelude::*;
use bevy_frangible::prelude::*;
use bevy_frangible::{Broken, CrackFaces, MaterialOfFile, OuterFaces};

/// Sides of the tile, m. Its colours are (x, y, z) over them, its second texture coordinates (2 y, z).
const SIDES: Vec3 = Vec3::new(0.1, 0.1, 0.006);

/// Stands for a material.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
struct Paint(u8);

fn looks() -> (Looks<Paint>, LooksOfFile<Paint>) {
    let looks = Looks {
        outer: Paint(8),
        crack: Paint(9),
    };
    (looks, LooksOfFile(vec![Paint(0), Paint(1)]))
}

/// An app with the plugin of these materials.
fn painted() -> (App, Log) {
    app_with(bodies(), |app| {
        app.add_plugins(LooksPlugin::<Paint>::default());
    })
}

fn floats<const N: usize>(
    mesh: &Mesh,
    attribute: bevy::mesh::MeshVertexAttribute,
    of: impl Fn(&VertexAttributeValues) -> Option<Vec<[f32; N]>>,
) -> Vec<[f32; N]> {
    let name = attribute.name;
    let values = mesh
        .attribute(attribute)
        .unwrap_or_else(|| panic!("no {name}"));
    of(values).unwrap_or_else(|| panic!("{name} has another format"))
}

/// Checks outer faces whose origin is `centre` in the frame of the tile.
fn check(mesh: &Mesh, centre: Vec3, material: &MaterialOfFile) {
    let triple = |values: &VertexAttributeValues| match values {
        VertexAttributeValues::Float32x3(rows) => Some(rows.clone()),
        _ => None,
    };
    let positions = floats(mesh, Mesh::ATTRIBUTE_POSITION, triple);
    let colors = floats(mesh, Mesh::ATTRIBUTE_COLOR, |values| match values {
        VertexAttributeValues::Float32x4(rows) => Some(rows.clone()),
        _ => None,
    });
    let pair = |values: &VertexAttributeValues| match values {
        VertexAttributeValues::Float32x2(rows) => Some(rows.clone()),
        _ => None,
    };
    let first = floats(mesh, Mesh::ATTRIBUTE_UV_0, pair);
    let second = floats(mesh, Mesh::ATTRIBUTE_UV_1, pair);
    assert!(positions.len() > 2);
    for (k, place) in positions.iter().enumerate() {
        let share = (Vec3::from_array(*place) + centre) / SIDES + 0.5;
        let [red, green, blue, opacity] = colors[k];
        assert!(
            Vec3::new(red, green, blue).distance(share) < 0.04,
            "{share}"
        );
        assert!(Vec2::from_array(first[k]).distance(share.truncate()) < 0.04);
        let wanted = Vec2::new(2.0 * share.y, share.z);
        assert!(Vec2::from_array(second[k]).distance(wanted) < 0.08);
        assert_eq!(opacity, 1.0);
        // The glaze is the front.
        assert!(material.index == 1 || share.z > 0.99, "{share}");
    }
}

/// Children with this marker: their materials, looks and meshes.
fn faces<F: Component>(app: &App, of: Entity) -> Vec<(Option<MaterialOfFile>, Paint, Mesh)> {
    let world = app.world();
    let children = world.get::<Children>(of).into_iter().flat_map(|c| c.iter());
    let face = |child: Entity| {
        world.get::<F>(child)?;
        let mesh = &world.get::<Mesh3d>(child).expect("a mesh").0;
        let mesh = world
            .resource::<Assets<Mesh>>()
            .get(mesh)
            .expect("its mesh");
        let material = world.get::<MaterialOfFile>(child).cloned();
        let name = world.get::<Name>(child).map(|name| name.to_string());
        assert_eq!(name, material.as_ref().map(|m| m.name.clone()));
        let paint = *world.get::<Paint>(child).expect("a look");
        Some((material, paint, mesh.clone()))
    };
    children.filter_map(face).collect()
}

#[test]
fn bodies_and_fragments_have_the_looks_of_their_file() {
    let (mut app, log) = painted();
    let tile = body(&mut app, "tile", Transform::from_xyz(0.0, 2.0, 0.0));
    app.world_mut().entity_mut(tile).insert(looks());
    ready(&mut app, tile);
    let world = app.world();
    let handle = world.get::<Breakable>(tile).expect("its asset").0.clone();
    let assets = world.resource::<Assets<FrangibleAsset>>();
    let asset = assets.get(&handle).expect("it is loaded");
    assert_eq!(asset.mesh_name(), "painted tile");
    let [glaze, clay] = asset.materials() else {
        panic!("{} materials", asset.materials().len());
    };
    assert_eq!((&glaze.name[..], &clay.name[..]), ("glaze", "clay"));
    assert_eq!(
        (glaze.emission, glaze.double_sided),
        ([0.5, 0.25, 0.0], true)
    );
    assert_eq!(
        asset.images()[glaze.textures[0].image as usize].name,
        "glaze.png"
    );
    assert!(world.get::<Mesh3d>(tile).is_none());
    let whole = faces::<OuterFaces>(&app, tile);
    assert_eq!(whole.len(), 2);
    for (material, paint, mesh) in whole {
        let material = material.expect("a material");
        assert_eq!(paint, Paint(material.index as u8));
        check(&mesh, Vec3::ZERO, &material);
    }

    ball(&mut app, Vec3::new(0.01, 2.005, 0.1), Vec3::NEG_Z * 25.0);
    for _ in 0..60 {
        app.update();
    }
    assert!(
        app.world().get::<Broken>(tile).is_some(),
        "{:?}",
        log.lines()
    );
    assert!(
        faces::<OuterFaces>(&app, tile).is_empty(),
        "its faces are gone"
    );
    let world = app.world();
    let pieces: Vec<Entity> = world
        .get::<Fragments>(tile)
        .expect("pieces")
        .iter()
        .collect();
    let mut seen = [0; 2];
    let mut cracks = 0;
    for &piece in &pieces {
        for (material, paint, mesh) in faces::<OuterFaces>(&app, piece) {
            let material = material.expect("a material");
            assert_eq!(paint, Paint(material.index as u8));
            assert!(mesh.indices().is_some());
            seen[material.index] += 1;
        }
        for (material, paint, mesh) in faces::<CrackFaces>(&app, piece) {
            assert_eq!((material, paint), (None, Paint(9)));
            assert!(mesh.contains_attribute(Mesh::ATTRIBUTE_COLOR));
            cracks += 1;
        }
    }
    println!(
        "{} pieces, {seen:?} outer faces, {cracks} with crack faces",
        pieces.len()
    );
    assert!(seen.iter().all(|&count| count > 0) && cracks > 1);
}

#[test]
fn without_a_list_a_body_is_one_mesh_and_its_faces_have_the_outer_look() {
    let (mut app, _) = painted();
    let tile = body(&mut app, "tile", Transform::default());
    app.world_mut().entity_mut(tile).insert(looks().0);
    ready(&mut app, tile);
    let mesh = &app.world().get::<Mesh3d>(tile).expect("a mesh").0;
    let mesh = app.world().resource::<Assets<Mesh>>().get(mesh);
    assert!(
        mesh.expect("its mesh")
            .contains_attribute(Mesh::ATTRIBUTE_UV_1)
    );
    assert!(faces::<OuterFaces>(&app, tile).is_empty());
    ball(&mut app, Vec3::new(0.01, 0.005, 0.1), Vec3::NEG_Z * 25.0);
    for _ in 0..60 {
        app.update();
    }
    let pieces = app.world().get::<Fragments>(tile).expect("pieces").iter();
    let pieces: Vec<Entity> = pieces.collect();
    assert!(pieces.len() > 1);
    for piece in pieces {
        for (_, paint, _) in faces::<OuterFaces>(&app, piece) {
            assert_eq!(paint, Paint(8));
        }
    }
}
