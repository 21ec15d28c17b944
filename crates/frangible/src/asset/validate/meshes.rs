//! Checks that the fracture mesh has right-handed tetrahedra that know their neighbours.

use super::rows::{Check, below, finite, one_each};
use crate::mesh::{FACES, NO_NEIGHBOUR, TetMesh};

pub(super) fn tetrahedra(mesh: &TetMesh) -> Check {
    if mesh.tets.is_empty() {
        return Err("it has no tetrahedra".into());
    }
    finite("node", &mesh.positions)?;
    below("tetrahedron", &mesh.tets, mesh.positions.len(), "node")?;
    let flat = (0..mesh.tets.len()).find(|&e| mesh.volume(e) <= 0.0);
    flat.map_or(Ok(()), |e| {
        Err(format!(
            "the volume of tetrahedron {e} is {} m³, not above zero",
            mesh.volume(e)
        ))
    })
}

/// Checks that neighbour references are mutual and across the same three nodes.
pub(super) fn neighbours(mesh: &TetMesh) -> Check {
    let tets = mesh.tets.len();
    one_each("tetrahedron", tets, "neighbour row", mesh.neighbours.len())?;
    for (e, (tet, row)) in mesh.tets.iter().zip(&mesh.neighbours).enumerate() {
        for (face, &other) in FACES.iter().zip(row) {
            if other == NO_NEIGHBOUR {
                continue;
            }
            let o = other as usize;
            let (Some(other_tet), Some(back)) = (mesh.tets.get(o), mesh.neighbours.get(o)) else {
                return Err(format!(
                    "tetrahedron {e} refers to neighbour {o}, but there are only {tets}"
                ));
            };
            let same = |f: &[usize; 3]| {
                let theirs = f.map(|i| other_tet[i]);
                face.iter().all(|&i| theirs.contains(&tet[i]))
            };
            let returned = FACES.iter().zip(back);
            if o == e
                || !returned
                    .into_iter()
                    .any(|(f, &b)| b as usize == e && same(f))
            {
                return Err(format!(
                    "tetrahedra {e} and {o} are not neighbours of each other across a common face"
                ));
            }
        }
    }
    Ok(())
}
