//! Attributes, materials and images of every format that has them, and words for what is not kept.

use super::*;
use frangible_mesh::{Blending, ImageKind, Placement, TextureSlot, Wrap};

const PNG: &[u8] = b"\x89PNG\r\n\x1a\nand so on";
const JPEG: &[u8] = b"\xff\xd8\xff\xe0and so on";

#[test]
fn gltf_keeps_attributes_materials_and_embedded_images() {
    let mut numbers = Numbers::tetrahedron();
    let tangents = numbers.floats("VEC4", &[1.0; 16]);
    let uvs: Vec<f32> = (0..8).map(|k| k as f32).collect();
    let first = numbers.floats("VEC2", &uvs);
    let second = numbers.floats("VEC2", &uvs.iter().map(|x| -x).collect::<Vec<_>>());
    let fourth = numbers.push(5121, "VEC2", 4, &[0, 255, 51, 0, 0, 0, 0, 0]);
    let (png, jpeg) = (numbers.view(PNG), numbers.view(JPEG));
    let json = format!(
        r#""nodes":[{{"mesh":0,"name":"lamp"}}],"animations":[{{"channels":[],"samplers":[]}}],
        "meshes":[{{"primitives":[{{"indices":1,"material":1,"attributes":{{"POSITION":0,"TANGENT":{tangents},
            "TEXCOORD_0":{first},"TEXCOORD_1":{second},"TEXCOORD_3":{fourth},"_HEAT":0}}}}]}}],
        "materials":[{{"name":"unused","emissiveTexture":{{"index":9}}}},
            {{"name":"glass","doubleSided":true,"alphaMode":"MASK","alphaCutoff":0.25,"emissiveFactor":[0.5,0.25,0],
            "extensions":{{"KHR_materials_emissive_strength":{{"emissiveStrength":8}},"KHR_materials_sheen":{{}}}},
            "pbrMetallicRoughness":{{"baseColorTexture":{{"index":0,"texCoord":1,
                "extensions":{{"KHR_texture_transform":{{"offset":[0.5,0.25],"rotation":1.5,"scale":[2,3]}}}}}},
                "metallicRoughnessTexture":{{"index":0}}}},
            "normalTexture":{{"index":1,"scale":0.5}},"occlusionTexture":{{"index":2,"texCoord":3}}}}],
        "textures":[{{"source":1,"sampler":0}},{{"source":0}},{{"extensions":{{"KHR_texture_basisu":{{"source":1}}}}}}],
        "samplers":[{{"magFilter":9728,"wrapS":33071,"wrapT":33648}}],
        "images":[{{"bufferView":{png},"mimeType":"image/png","name":"bumps"}},{{"bufferView":{jpeg},"mimeType":"image/jpeg"}}],
        "extensionsUsed":["KHR_texture_transform","KHR_materials_sheen","KHR_materials_emissive_strength"]"#
    );
    let mesh = read(MeshFormat::Gltf, numbers.glb(&json));
    assert_is_tetrahedron(&mesh);
    assert_eq!(mesh.uvs[3], Vec2::new(6.0, 7.0));
    assert_eq!(mesh.more_uvs.len(), 3);
    assert_eq!(mesh.more_uvs[0][3], Vec2::new(-6.0, -7.0));
    assert_eq!(mesh.more_uvs[1], [Vec2::ZERO; 4]);
    assert_eq!(mesh.more_uvs[2][0], Vec2::new(0.0, 1.0));
    let material = &mesh.materials[1];
    assert_eq!((&material.name[..], material.double_sided), ("glass", true));
    assert_eq!(material.blending, Blending::Mask(0.25));
    assert_eq!(material.emission, [4.0, 2.0, 0.0]);
    let textures = &material.textures;
    let slots: Vec<_> = textures
        .iter()
        .map(|t| (t.slot, t.image, t.uv_set))
        .collect();
    let wanted = [
        (TextureSlot::BaseColor, 0, 1),
        (TextureSlot::MetallicRoughness, 0, 0),
        (TextureSlot::Normal, 1, 0),
    ];
    assert_eq!(slots, wanted);
    assert_eq!(textures[0].wrap, [Wrap::Clamp, Wrap::Mirror]);
    assert_eq!(
        (textures[0].is_pixelated, textures[2].is_pixelated),
        (true, false)
    );
    let placement = Placement {
        offset: [0.5, 0.25],
        rotation: 1.5,
        scale: [2.0, 3.0],
    };
    assert_eq!(textures[0].placement, placement);
    assert_eq!(
        (textures[1].placement, textures[2].strength),
        (Placement::IDENTITY, 0.5)
    );
    let images: Vec<_> = mesh
        .images
        .iter()
        .map(|i| (&i.name[..], i.kind, &i.bytes[..]))
        .collect();
    assert_eq!(
        images,
        [("", ImageKind::Jpeg, JPEG), ("bumps", ImageKind::Png, PNG)]
    );
    let left_out = [
        "animations",
        "tangents",
        "textures that are neither PNG nor JPEG",
        "the extension KHR_materials_sheen",
        "the vertex attribute _HEAT",
    ];
    assert_eq!(mesh.left_out, left_out);
    // Opaque materials have no opacity, whatever the file says.
    let opaque = json.replace(r#""alphaMode":"MASK""#, r#""alphaMode":"OPAQUE""#);
    let opaque = opaque.replace(
        r#""pbrMetallicRoughness":{"#,
        r#""pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5],"#,
    );
    let opaque = read(MeshFormat::Gltf, numbers.glb(&opaque));
    assert_eq!(opaque.materials[1].base_color, [1.0; 4]);
}

#[test]
fn images_are_read_beside_the_mesh_and_missing_ones_are_named() {
    let folder = Folder::new("images");
    folder.write("old wood.png", PNG);
    folder.write("glow.jpg", JPEG);
    folder.write("film.bmp", b"BM...");
    folder.write(
        "a.mtl",
        "newmtl wood\nKe 0 0 0\nmap_Kd -o 0.25 0.5 -s 2 4 1 -clamp on old wood.png\nmap_Ke glow.jpg\nmap_Bump -bm 0.3 b.png\n\
         Ks 0.5 0.5 0.5\nnorm -bm 0.5 lost.png\nnewmtl plain\nKs 0 0 0\nKe 3 0 1\nmap_Kd film.bmp\nnewmtl unused\nmap_Kd far.png\n",
    );
    let faces = "vt 0 0\nvt 1 0\nvt 1 1\nmtllib a.mtl\nusemtl wood\nf 1/1 3/2 2/3\nf 1/1 2/2 4/3\nusemtl plain\nl 1 2\n\
                 f 1/1 4/2 3/3\nf 2/1 3/2 4/3\n";
    let text = obj().replacen("f 1", &format!("{faces}#"), 1);
    let text: String = text
        .split_inclusive('\n')
        .filter(|l| !l.starts_with("f ") || l.contains('/'))
        .collect();
    let mesh = read_mesh(&folder.write("a.obj", &text)).expect("an OBJ");
    assert_is_tetrahedron(&mesh);
    let [wood, plain] = &mesh.materials[..] else {
        panic!("{:?}", mesh.materials)
    };
    assert_eq!((wood.emission, plain.emission), ([1.0; 3], [3.0, 0.0, 1.0]));
    let textures: Vec<_> = wood.textures.iter().map(|t| (t.slot, t.image)).collect();
    assert_eq!(
        textures,
        [(TextureSlot::BaseColor, 0), (TextureSlot::Emission, 1)]
    );
    assert!(plain.textures.is_empty());
    // The file's point (u, v) is the mesh's (u, 1 − v), and its texel (2 u + ¼, 4 v + ½) the image's from the top.
    let Placement { offset, scale, .. } = wood.textures[0].placement;
    assert_eq!((scale, offset), ([2.0, 4.0], [0.25, 1.0 - 4.0 - 0.5]));
    assert_eq!(wood.textures[0].wrap, [Wrap::Clamp; 2]);
    let names: Vec<_> = mesh.images.iter().map(|image| &image.name[..]).collect();
    assert_eq!(names, ["old wood.png", "glow.jpg"]);
    assert_eq!(mesh.left_out.len(), 5, "{:?}", mesh.left_out);
    for words in [
        "image film.bmp, which is neither PNG nor JPEG",
        "image lost.png (there is no file",
        "map_Bump of materials",
        "points and lines",
        "specular colours",
    ] {
        assert!(
            mesh.left_out.iter().any(|what| what.starts_with(words)),
            "{words}: {:?}",
            mesh.left_out
        );
    }

    let image = r#","images":[{"uri":"old%20wood.png"}],"textures":[{"source":0}]"#;
    let textured = gltf(ONE_NODE, "").replace(
        r#""roughnessFactor":0.5"#,
        r#""roughnessFactor":0.5,"baseColorTexture":{"index":0}"#,
    );
    let mut textured = textured.replace(r#""POSITION":0"#, r#""POSITION":0,"TEXCOORD_0":2"#);
    textured = textured.replace(
        r#""type":"SCALAR"}"#,
        r#""type":"SCALAR"},{"bufferView":0,"componentType":5126,"count":4,"type":"VEC2"}"#,
    );
    textured.truncate(textured.len() - 1);
    let path = folder.write("a.glb", glb(&format!("{textured}{image}}}")));
    let mesh = read_mesh(&path).expect("a GLB");
    assert_eq!(
        (&mesh.images[0].bytes[..], mesh.materials[0].textures.len()),
        (PNG, 1)
    );
    assert!(mesh.left_out.is_empty());
    for (uri, words) in [
        ("lost.png", "image lost.png (there is no file"),
        ("../a.png", "is outside the folder"),
        ("https://example.org/a.png", "is a web address"),
        ("data:image/png;base64,?", "its base64 is damaged"),
    ] {
        let path = folder.write(
            "b.glb",
            glb(&format!("{textured}{image}}}").replace("old%20wood.png", uri)),
        );
        let mesh = read_mesh(&path).expect("a mesh without its image");
        assert_is_tetrahedron(&mesh);
        assert!(mesh.images.is_empty() && mesh.materials[0].textures.is_empty());
        assert!(mesh.left_out[0].contains(words), "{:?}", mesh.left_out);
    }
    let without = textured.replace(r#","TEXCOORD_0":2"#, "");
    let mesh = read(
        MeshFormat::Gltf,
        glb(&format!(
            "{without}{}}}",
            image.replace("old%20wood.png", "data:,")
        )),
    );
    assert!(mesh.materials[0].textures.is_empty() && mesh.left_out.len() == 1);
}

#[test]
fn ply_keeps_its_image_and_names_what_it_has_no_place_for() {
    let folder = Folder::new("ply-image");
    folder.write("a scan.JPG", JPEG);
    let header = "ply\nformat ascii 1.0\ncomment TextureFile a scan.JPG\nelement vertex 4\nproperty float x\nproperty float y\n\
                  property float z\nproperty float s\nproperty float t\nproperty float quality\nelement face 4\n\
                  property list uchar int vertex_indices\nproperty uchar red\nelement edge 1\nproperty int vertex1\nend_header\n";
    let vertices = CORNERS
        .map(|[x, y, z]| format!("{x} {y} {z} {x} {y} 9\n"))
        .concat();
    let faces = FACES.map(|[a, b, c]| format!("3 {a} {b} {c} 7\n")).concat();
    let text = format!("{header}{vertices}{faces}2\n");
    let mesh = read_mesh(&folder.write("a.ply", &text)).expect("a PLY");
    assert_is_tetrahedron(&mesh);
    assert_eq!(mesh.images[0].kind, ImageKind::Jpeg);
    assert_eq!(mesh.materials[0].textures[0].slot, TextureSlot::BaseColor);
    let left_out = ["quality of vertices", "red of faces", "the elements edge"];
    assert_eq!(mesh.left_out, left_out);
    // From memory there is no folder.
    let mesh = read(MeshFormat::Ply, &text);
    assert!(mesh.left_out.contains(&"image a scan.JPG".to_string()));
    let mut colored = stl(b"by hand");
    colored[84 + 48] = 0x1f;
    assert_eq!(
        read(MeshFormat::Stl, &colored).left_out,
        ["attributes of facets"]
    );
    assert!(read(MeshFormat::Stl, stl(b"by hand")).left_out.is_empty());
}
