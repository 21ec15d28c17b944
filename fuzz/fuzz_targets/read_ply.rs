//! Any bytes as Ply: an error or a sound surface, never a panic.

#![no_main]

use frangible_mesh::{MeshFormat, parse_mesh, repair};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if let Ok(mesh) = parse_mesh(MeshFormat::Ply, bytes, None)
        && let Ok((surface, report)) = repair(&mesh)
    {
        assert_eq!(surface.triangles.len(), report.faces_out);
        assert!(
            surface
                .triangles
                .iter()
                .flatten()
                .all(|&v| (v as usize) < surface.positions.len())
        );
    }
});
