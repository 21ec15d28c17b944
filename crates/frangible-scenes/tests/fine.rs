//! Fine drawings: crack faces finer than the mesh.

use frangible_scenes::{Drawing, Run, bake, play, scene};

/// The hammered brick, until its pieces have come apart.
fn broken(drawing: Drawing) -> Run {
    let mut brick = scene("hammer").unwrap();
    brick.duration = 0.3;
    brick.output.drawing = drawing;
    play(&brick, &bake(&brick).unwrap(), &mut |_| {}).unwrap()
}

#[test]
fn a_fine_drawing_changes_crack_faces_alone() {
    let [full, fine] = [Drawing::Full, Drawing::Fine].map(broken);
    assert!(full.recording.nodes.len() > 2);
    let [full, fine] = [full.recording, fine.recording];
    assert_eq!(full.blows, fine.blows);
    let inner = full
        .surfaces
        .iter()
        .position(|s| s.name.ends_with("crack face"));
    let inner = inner.unwrap();
    let (mut before, mut after) = (0, 0);
    for (node, same) in full.nodes.iter().zip(&fine.nodes) {
        assert_eq!(node.poses, same.poses);
        let of = |mesh: &frangible_recording::RecordedMesh| -> usize {
            let parts = mesh.parts.iter().filter(|part| part.surface == inner);
            parts.map(|part| part.indices.len() / 3).sum()
        };
        before += of(&full.meshes[node.mesh]);
        after += of(&fine.meshes[same.mesh]);
    }
    assert!(before > 0 && after > 5 * before, "{before} {after}");
}
