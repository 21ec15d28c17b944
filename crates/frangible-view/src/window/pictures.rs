//! Pictures onto the stage, and the window into a file.

use std::path::Path;

use frangible_draw::kiss3d::color::Color;
use frangible_draw::kiss3d::window::Window;
use frangible_draw::{LiveMesh, LiveStage, Looks};
use frangible_photo::encode_png;
use frangible_recording::write_atomically;

use crate::error::ViewError;
use crate::picture::{BatchLooks, Picture};

/// Puts a picture's triangles on the stage, as edges where that is wanted and can be drawn.
pub(super) fn put(stage: &mut LiveStage, picture: &Picture, wireframes: bool) {
    let looks: Vec<Looks> = picture
        .batches
        .iter()
        .map(|batch| match &batch.looks {
            BatchLooks::Surface(surface) => Looks::Surface(surface.clone()),
            BatchLooks::Values => Looks::Values,
            BatchLooks::Edges(color) => Looks::Edges(*color),
        })
        .collect();
    let meshes = picture
        .batches
        .iter()
        .zip(&looks)
        .map(|(batch, looks)| LiveMesh {
            looks,
            positions: &batch.positions,
            normals: &batch.normals,
            values: &batch.values,
            faces: &batch.faces,
            stamp: batch.stamp,
        });
    stage.show(meshes, picture.wireframe && wireframes);
}

/// Draws a picture's strokes and dots over the next frame.
pub(super) fn strokes(stage: &LiveStage, window: &mut Window, picture: &Picture, dots: bool) {
    let color = |[red, green, blue]: [f32; 3]| Color::new(red, green, blue, 1.0);
    for line in &picture.lines {
        let [a, b] = line.ends.map(|end| stage.point(end));
        window.draw_line(a, b, color(line.color), line.width, false);
    }
    for dot in picture.dots.iter().filter(|_| dots) {
        window.draw_point(stage.point(dot.at), color(dot.color), dot.size);
    }
}

/// Writes the last frame as PNG.
pub(super) fn save(window: &Window, path: &Path) -> Result<(), ViewError> {
    let image = window.snap_image();
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|source| ViewError::File {
            path: path.to_path_buf(),
            doing: "written",
            source,
        })?;
    }
    write_atomically(path, &encode_png(&image.into())?)?;
    Ok(())
}
