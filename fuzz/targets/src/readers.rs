//! Readers of files.

use std::path::Path;

use frangible::Asset;
use frangible::internals::asset::seal;
use frangible_mesh::{
    MeshFormat, TetFormat, mend_tets, parse_mesh, parse_tetgen, parse_tets, quality, repair,
};
use frangible_scenes::{parse_scene, scene_to_toml};

/// A `.frangible` file is refused, or gives a sound asset.
pub fn read_asset(bytes: &[u8]) {
    let _ = Asset::from_bytes(bytes);
    // The checksum would stop every mutation.
    let mut sealed = bytes.to_vec();
    seal(&mut sealed);
    if let Ok(asset) = Asset::from_bytes(&sealed) {
        let bytes = asset.to_bytes();
        let back = Asset::from_bytes(&bytes).expect("what was written must be readable");
        assert_eq!(bytes, back.to_bytes());
    }
}

/// A glTF file is refused, or gives a sound surface.
pub fn read_gltf(bytes: &[u8]) {
    surface(MeshFormat::Gltf, bytes);
}

/// An OBJ file is refused, or gives a sound surface.
pub fn read_obj(bytes: &[u8]) {
    surface(MeshFormat::Obj, bytes);
}

/// A PLY file is refused, or gives a sound surface.
pub fn read_ply(bytes: &[u8]) {
    surface(MeshFormat::Ply, bytes);
}

/// An STL file is refused, or gives a sound surface.
pub fn read_stl(bytes: &[u8]) {
    surface(MeshFormat::Stl, bytes);
}

fn surface(format: MeshFormat, bytes: &[u8]) {
    if let Ok(mesh) = parse_mesh(format, bytes, None)
        && let Ok((surface, report)) = repair(&mesh)
    {
        assert_eq!(surface.triangles.len(), report.faces_out);
        let mut corners = surface.triangles.iter().flatten();
        assert!(corners.all(|&v| (v as usize) < surface.positions.len()));
    }
}

/// Tetrahedra are refused, or give a sound body. The first byte chooses the format.
pub fn read_tets(bytes: &[u8]) {
    let Some((&choice, bytes)) = bytes.split_first() else {
        return;
    };
    let read = match choice {
        b'g' => parse_tets(TetFormat::Msh, bytes),
        b'm' => parse_tets(TetFormat::Medit, bytes),
        _ => {
            // Three files in one, parted by bars.
            let mut files = bytes.splitn(3, |&b| b == b'|');
            let [node, ele] = [(); 2].map(|()| files.next().unwrap_or_default());
            parse_tetgen(node, ele, files.next())
        }
    };
    if let Ok(read) = read
        && let Ok(mended) = mend_tets(&read)
    {
        let body = &mended.body;
        let known = |&v: &u32| (v as usize) < body.positions.len();
        assert!(body.tets.iter().flatten().all(known));
        assert!((0..body.tets.len()).all(|e| quality::volume(body.corners(e)) > 0.0));
        assert!(mended.groups.iter().flat_map(|g| &g.nodes).all(known));
    }
}

/// The text of a scene is refused, or gives a sound scene.
pub fn read_scene(bytes: &[u8]) {
    if let Ok(scene) = parse_scene(crate::text(bytes), Path::new("")) {
        scene.validate().expect("a scene that was accepted");
        // Written and read again it may fail only where its paths or texts cannot be written.
        let _ = parse_scene(&scene_to_toml(&scene), Path::new(""));
    }
}
