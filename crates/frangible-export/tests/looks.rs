//! Colours, textures and marks of a written file, read back by another library.

use frangible_export::{GlbOptions, write_glb, write_glb_with};
use frangible_recording::glam::Vec3;
use frangible_recording::{
    Blending, Image, ImageKind, MeshPart, Placement, Pose, RecordedMesh, RecordedNode, Recording,
    SurfaceMaterial, Texture, TextureSlot, Wrap,
};
use gltf::material::AlphaMode;
use gltf::texture::{MagFilter, WrappingMode};

/// A triangle of each surface.
fn recording() -> Recording {
    let image = |name: &str, kind, bytes: &[u8]| Image {
        name: name.into(),
        kind,
        bytes: bytes.into(),
    };
    let placed = Texture {
        uv_set: 1,
        wrap: [Wrap::Clamp, Wrap::Mirror],
        is_pixelated: true,
        placement: Placement {
            offset: [0.5, 0.25],
            rotation: 1.5,
            scale: [2.0, -3.0],
        },
        ..Texture::of(TextureSlot::BaseColor, 1)
    };
    let bumps = Texture {
        strength: 0.5,
        ..Texture::of(TextureSlot::Normal, 0)
    };
    let surface = |name: &str| SurfaceMaterial {
        name: name.into(),
        ..SurfaceMaterial::default()
    };
    let part = |surface, indices| MeshPart { surface, indices };
    Recording {
        frame_rate: 60.0,
        frame_count: 1,
        surfaces: vec![
            SurfaceMaterial {
                emission: [4.0, 1.0, 0.0],
                double_sided: true,
                blending: Blending::Mask(0.25),
                textures: vec![placed, bumps],
                ..surface("lamp")
            },
            SurfaceMaterial {
                emission: [0.5, 0.0, 0.25],
                blending: Blending::Blend,
                textures: vec![bumps, Texture::of(TextureSlot::Occlusion, 0)],
                ..surface("veil")
            },
            SurfaceMaterial {
                ends_inside: true,
                ..surface("veil crack")
            },
        ],
        // Three bytes would shift what comes after them.
        images: vec![
            image("bumps", ImageKind::Png, b"png"),
            image("", ImageKind::Jpeg, b"jpeg!"),
        ],
        meshes: vec![RecordedMesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: vec![[0.0, 1.0]; 3],
            more_uvs: vec![vec![[2.0, 3.0]; 3], vec![[4.0, 5.0]; 3]],
            colors: vec![[1.0, 0.5, 0.25, 0.75]; 3],
            parts: (0..3).map(|surface| part(surface, vec![0, 1, 2])).collect(),
            ..RecordedMesh::default()
        }],
        nodes: vec![RecordedNode {
            poses: vec![Pose::default()],
            visible: 0..1,
            ..RecordedNode::default()
        }],
        ..Recording::default()
    }
}

#[test]
fn looks_are_found_again() {
    let bytes = write_glb(&recording()).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).expect("a valid GLB");
    let blob = file.blob.as_deref().expect("a binary chunk");
    let used: Vec<_> = file.extensions_used().collect();
    for extension in ["KHR_materials_emissive_strength", "KHR_texture_transform"] {
        assert!(used.contains(&extension), "{used:?}");
    }
    let materials: Vec<_> = file.materials().collect();
    let lamp = &materials[0];
    assert_eq!(lamp.emissive_factor(), [1.0, 0.25, 0.0]);
    assert!(lamp.double_sided() && !materials[1].double_sided());
    assert_eq!(
        (lamp.alpha_mode(), lamp.alpha_cutoff()),
        (AlphaMode::Mask, Some(0.25))
    );
    assert_eq!(materials[1].alpha_mode(), AlphaMode::Blend);
    assert_eq!(materials[1].emissive_factor(), [0.5, 0.0, 0.25]);
    let color = lamp.pbr_metallic_roughness().base_color_texture().unwrap();
    assert_eq!(
        (color.tex_coord(), color.texture().source().index()),
        (1, 1)
    );
    let sampler = color.texture().sampler();
    assert_eq!(sampler.mag_filter(), Some(MagFilter::Nearest));
    assert_eq!(sampler.wrap_s(), WrappingMode::ClampToEdge);
    assert_eq!(sampler.wrap_t(), WrappingMode::MirroredRepeat);
    assert_eq!(lamp.normal_texture().unwrap().scale(), 0.5);
    let (bumps, light) = (
        materials[1].normal_texture().unwrap(),
        materials[1].occlusion_texture().unwrap(),
    );
    assert_eq!(bumps.texture().index(), light.texture().index());
    assert_eq!(file.textures().count(), 2);
    let images = file.images().map(|image| match image.source() {
        gltf::image::Source::View { view, mime_type } => {
            assert_eq!(view.offset() % 4, 0);
            (mime_type, &blob[view.offset()..][..view.length()])
        }
        gltf::image::Source::Uri { uri, .. } => panic!("{uri}"),
    });
    let images: Vec<_> = images.collect();
    assert_eq!(
        images,
        [("image/png", &b"png"[..]), ("image/jpeg", b"jpeg!")]
    );
    let json: serde_json::Value = serde_json::to_value(file.document.into_json()).unwrap();
    let strength = &json["materials"][0]["extensions"]["KHR_materials_emissive_strength"];
    assert_eq!(strength["emissiveStrength"], 4.0);
    let transform = &json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]
        ["KHR_texture_transform"];
    let wanted =
        serde_json::json!({ "offset": [0.5, 0.25], "rotation": 1.5, "scale": [2.0, -3.0] });
    assert_eq!(*transform, wanted);
}

#[test]
fn attributes_of_vertices_are_found_again_and_ending_cracks_are_marked() {
    let bytes = write_glb(&recording()).unwrap();
    let file = gltf::Gltf::from_slice(&bytes).expect("a valid GLB");
    let blob = file.blob.as_deref();
    let mesh = file.meshes().next().unwrap();
    let mut marks = Vec::new();
    for primitive in mesh.primitives() {
        let reader = primitive.reader(|_| blob);
        let set = |set| -> Vec<_> { reader.read_tex_coords(set).unwrap().into_f32().collect() };
        assert_eq!(
            [0, 1, 2].map(|k| set(k)[2]),
            [[0.0, 1.0], [2.0, 3.0], [4.0, 5.0]]
        );
        let colors: Vec<_> = reader.read_colors(0).unwrap().into_rgba_f32().collect();
        assert_eq!(colors, [[1.0, 0.5, 0.25, 0.75]; 3]);
        marks.push(
            primitive
                .extras()
                .as_ref()
                .map(|mark| mark.get().to_owned()),
        );
    }
    let mark = r#"{"ends_inside":true,"name":"veil crack"}"#.to_string();
    assert_eq!(marks, [None, None, Some(mark)]);
}

#[test]
fn unsound_looks_are_errors() {
    type Spoiled = (fn(&mut Recording), &'static str);
    let cases: [Spoiled; 6] = [
        (
            |r| r.surfaces[0].textures[0].image = 2,
            "image of a texture of the surface \"lamp\"",
        ),
        (
            |r| r.surfaces[0].textures[1].strength = f32::NAN,
            "number of a texture",
        ),
        (
            |r| r.surfaces[1].emission[1] = -1.0,
            "emission of the surface \"veil\"",
        ),
        (
            |r| r.surfaces[0].blending = Blending::Mask(2.0),
            "opacity that the surface \"lamp\" needs",
        ),
        (
            |r| r.meshes[0].colors.truncate(2),
            "the colours of the mesh",
        ),
        (
            |r| r.meshes[0].more_uvs[1].clear(),
            "further set of texture coordinates",
        ),
    ];
    for (spoil, words) in cases {
        let mut recording = recording();
        spoil(&mut recording);
        let error = write_glb(&recording).unwrap_err().to_string();
        assert!(error.contains(words), "{error}; expected: {words}");
    }
}

#[test]
fn quantised_vertices_are_near_those_given() {
    let mut recording = recording();
    let places = [[0.3, -0.02, 0.1], [0.5, 0.04, 0.1], [0.35, 0.0, 0.101]].map(Vec3::from_array);
    recording.meshes[0].positions = places.to_vec();
    recording.meshes[0].normals = [Vec3::new(1.0, -2.0, 0.5), Vec3::Y, Vec3::NEG_Z].to_vec();
    let mut options = GlbOptions::default();
    options.quantized = true;
    let bytes = write_glb_with(&recording, &options).unwrap();
    assert!(
        gltf::Gltf::from_slice(&bytes).is_err(),
        "a reader without the extension"
    );
    let file = gltf::Gltf::from_slice_without_validation(&bytes).unwrap();
    assert_eq!(
        file.extensions_required().collect::<Vec<_>>(),
        ["KHR_mesh_quantization"]
    );
    let blob = file.blob.as_deref().unwrap();
    let node = file.nodes().next().unwrap();
    let child = node.children().next().expect("a node for the mesh");
    assert!(
        node.mesh().is_none()
            && file
                .scenes()
                .next()
                .unwrap()
                .nodes()
                .all(|n| n.index() != child.index())
    );
    let (center, _, scale) = child.transform().decomposed();
    let primitive = child.mesh().unwrap().primitives().next().unwrap();
    let rows = |semantic, size: usize| {
        let accessor = primitive.get(&semantic).unwrap();
        let view = accessor.view().unwrap();
        let stride = view.stride().unwrap();
        assert!(
            accessor.normalized() && stride.is_multiple_of(4) && view.offset().is_multiple_of(4)
        );
        (0..3)
            .map(|k| blob[view.offset() + k * stride..][..size].to_vec())
            .collect::<Vec<_>>()
    };
    for (row, place) in rows(gltf::Semantic::Positions, 6).iter().zip(places) {
        for axis in 0..3 {
            let whole = i16::from_le_bytes([row[2 * axis], row[2 * axis + 1]]);
            let found = center[axis] + scale[axis] * f32::from(whole) / 32767.0;
            // Half a step of the longest side.
            assert!((found - place[axis]).abs() < 0.2 * 8e-6, "{found} {place}");
        }
    }
    for (row, normal) in rows(gltf::Semantic::Normals, 3)
        .iter()
        .zip(&recording.meshes[0].normals)
    {
        let found = Vec3::from_array([0, 1, 2].map(|k| f32::from(row[k] as i8) / 127.0));
        assert!(
            found.distance(normal.normalize()) < 0.01,
            "{found} {normal}"
        );
    }
    let color = &rows(gltf::Semantic::Colors(0), 8)[0];
    assert_eq!(color[2..4], 32768_u16.to_le_bytes());
}
