//! Any bytes as tetrahedra: an error or a sound body, never a panic. The first byte chooses the format.

#![no_main]

use frangible_mesh::{TetFormat, mend_tets, parse_tetgen, parse_tets, quality};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Some((&choice, bytes)) = bytes.split_first() else {
        return;
    };
    let read = match choice {
        b'g' => parse_tets(TetFormat::Msh, bytes),
        b'l' => parse_tets(TetFormat::Vtk, bytes),
        b'x' => parse_tets(TetFormat::Vtu, bytes),
        b'm' => parse_tets(TetFormat::Medit, bytes),
        _ => {
            // Three files in one, parted by bars.
            let mut files = bytes.splitn(3, |&b| b == b'|');
            let (node, ele) = (
                files.next().unwrap_or_default(),
                files.next().unwrap_or_default(),
            );
            parse_tetgen(node, ele, files.next())
        }
    };
    if let Ok(read) = read
        && let Ok(mended) = mend_tets(&read)
    {
        let body = &mended.body;
        assert!(
            body.tets
                .iter()
                .flatten()
                .all(|&v| (v as usize) < body.positions.len())
        );
        assert!((0..body.tets.len()).all(|e| quality::volume(body.corners(e)) > 0.0));
        assert!(
            mended
                .groups
                .iter()
                .flat_map(|g| &g.nodes)
                .all(|&v| (v as usize) < body.positions.len())
        );
    }
});
