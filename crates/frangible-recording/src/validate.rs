//! Checks a recording, so that writers may index without fear.

use frangible_geometry::{Blending, Placement};
use glam::Vec3;

use crate::RecordingError;
use crate::recording::{
    Floor, RecordedBlow, RecordedMesh, RecordedNode, RecordedSlide, RecordedTouch, Recording,
    SurfaceMaterial, View,
};

type Checked = Result<(), RecordingError>;

impl Recording {
    /// Checks every index, count and number.
    ///
    /// # Errors
    ///
    /// The first thing found wrong, by name and value.
    pub fn validate(&self) -> Checked {
        if self.frame_count == 0 {
            return Err(RecordingError::NoFrame);
        }
        let rate = f64::from(self.frame_rate);
        finite(rate, || "the frame rate".into())?;
        in_range(rate, rate > 0.0, "above zero, in 1/s", || {
            "the frame rate".into()
        })?;
        for surface in &self.surfaces {
            check_surface(surface, self.images.len())?;
        }
        for mesh in &self.meshes {
            check_mesh(mesh, self.surfaces.len())?;
        }
        for node in &self.nodes {
            check_node(node, self.meshes.len(), self.frame_count)?;
        }
        if let Some(floor) = &self.floor {
            check_floor(floor)?;
        }
        self.camera.validate()?;
        self.views.iter().flatten().try_for_each(View::validate)?;
        for (i, blow) in self.blows.iter().enumerate() {
            check_blow(i, blow, self.nodes.len())?;
        }
        for (i, touch) in self.touches.iter().enumerate() {
            check_touch(i, touch, self.nodes.len())?;
        }
        for (i, slide) in self.slides.iter().enumerate() {
            check_slide(i, slide, self.nodes.len())?;
        }
        let moments = self.labelled_moments();
        moments.iter().try_for_each(|(frame, label)| {
            index(*frame, self.frame_count, || {
                format!("the frame of the moment \"{label}\"")
            })
        })
    }
}

impl View {
    /// Checks that the camera looks somewhere.
    ///
    /// # Errors
    ///
    /// The error in it.
    pub fn validate(&self) -> Checked {
        finite_vector(self.eye, || "the camera's eye".into())?;
        finite_vector(self.target, || "the camera's target".into())?;
        finite_vector(self.up, || "the camera's up direction".into())?;
        let fov = f64::from(self.vertical_fov);
        let name = || "the camera's vertical field of view".into();
        finite(fov, name)?;
        in_range(
            fov,
            fov > 0.0 && fov < std::f64::consts::PI,
            "between 0 and π, in rad",
            name,
        )?;
        let forward = (self.target - self.eye).normalize_or_zero();
        let sideways = forward.cross(self.up.normalize_or_zero());
        // Below this sine the picture's roll is decided by rounding.
        if sideways.length() < 1e-4 {
            return Err(RecordingError::BadView);
        }
        Ok(())
    }
}

fn check_blow(i: usize, blow: &RecordedBlow, nodes: usize) -> Checked {
    index(blow.node, nodes, || format!("the node of blow {i}"))?;
    if !blow.pieces.is_empty() {
        index(blow.pieces.end - 1, nodes, || {
            format!("the last piece of blow {i}")
        })?;
    }
    finite(blow.time, || format!("the time of blow {i}"))?;
    finite(blow.fracture_energy, || {
        format!("the fracture energy of blow {i}")
    })?;
    for pulse in &blow.pulses {
        finite_vector(pulse.point, || format!("the place of blow {i}"))?;
        finite_vector(pulse.direction, || format!("the direction of blow {i}"))?;
        let step = pulse.time_step;
        let name = || format!("the time step of blow {i}");
        finite(step, name)?;
        in_range(step, step > 0.0, "above zero, in s", name)?;
        for &force in &pulse.force {
            finite(f64::from(force), || format!("a force of blow {i}"))?;
        }
    }
    for crack in &blow.cracks {
        if crack.times.len() != crack.places.len() {
            return Err(RecordingError::BadCount {
                what: format!("the times of a crack of blow {i}"),
                count: crack.times.len(),
                expected: format!("{}, one per place, are", crack.places.len()),
            });
        }
        for (&place, &time) in crack.places.iter().zip(&crack.times) {
            finite_vector(place, || format!("a place of a crack of blow {i}"))?;
            finite(time, || format!("a time of a crack of blow {i}"))?;
        }
    }
    Ok(())
}

fn check_touch(i: usize, touch: &RecordedTouch, nodes: usize) -> Checked {
    let (first, second) = touch.nodes;
    index(first, nodes, || format!("the node of touch {i}"))?;
    if let Some(second) = second {
        index(second, nodes, || format!("the other node of touch {i}"))?;
    }
    finite(touch.time, || format!("the time of touch {i}"))?;
    finite_vector(touch.point, || format!("the place of touch {i}"))?;
    finite_vector(touch.normal, || format!("the normal of touch {i}"))?;
    finite(touch.impulse, || format!("the impulse of touch {i}"))
}

fn check_slide(i: usize, slide: &RecordedSlide, nodes: usize) -> Checked {
    let (first, second) = slide.nodes;
    index(first, nodes, || format!("the node of slide {i}"))?;
    if let Some(second) = second {
        index(second, nodes, || format!("the other node of slide {i}"))?;
    }
    finite(slide.time, || format!("the time of slide {i}"))?;
    let name = || format!("the duration of slide {i}");
    finite(slide.duration, name)?;
    in_range(
        slide.duration,
        slide.duration > 0.0,
        "above zero, in s",
        name,
    )?;
    finite_vector(slide.point, || format!("the place of slide {i}"))?;
    finite_vector(slide.normal, || format!("the normal of slide {i}"))?;
    finite(slide.speed, || format!("the speed of slide {i}"))?;
    finite(slide.power, || format!("the power of slide {i}"))
}

fn check_surface(surface: &SurfaceMaterial, images: usize) -> Checked {
    let name = &surface.name;
    let [r, g, b, opacity] = surface.base_color;
    let fractions = [
        (r, "red"),
        (g, "green"),
        (b, "blue"),
        (opacity, "opacity"),
        (surface.metallic, "metallic"),
        (surface.roughness, "roughness"),
        (surface.transmission, "transmission"),
    ];
    for (value, what) in fractions {
        fraction(value, || format!("{what} of the surface \"{name}\""))?;
    }
    let ior = f64::from(surface.ior);
    let what = || format!("the index of refraction of the surface \"{name}\"");
    finite(ior, what)?;
    in_range(ior, ior >= 1.0, "at least 1 (glass: 1.5)", what)?;
    for part in surface.attenuation_color.map(f64::from) {
        let what = || format!("the attenuation colour of the surface \"{name}\"");
        finite(part, what)?;
        in_range(part, part > 0.0 && part <= 1.0, "above 0, at most 1", what)?;
    }
    let distance = f64::from(surface.attenuation_distance);
    let what = || format!("the attenuation distance of the surface \"{name}\"");
    // Infinite where nothing is swallowed.
    in_range(distance, distance > 0.0, "above zero, in m", what)?;
    for part in surface.emission.map(f64::from) {
        let what = || format!("the emission of the surface \"{name}\"");
        finite(part, what)?;
        in_range(part, part >= 0.0, "0 or more", what)?;
    }
    if let Blending::Mask(least) = surface.blending {
        fraction(least, || {
            format!("the opacity that the surface \"{name}\" needs")
        })?;
    }
    for texture in &surface.textures {
        index(texture.image as usize, images, || {
            format!("the image of a texture of the surface \"{name}\"")
        })?;
        let Placement {
            offset: [u, v],
            rotation,
            scale: [along, across],
        } = texture.placement;
        for number in [texture.strength, u, v, rotation, along, across] {
            finite(f64::from(number), || {
                format!("a number of a texture of the surface \"{name}\"")
            })?;
        }
    }
    Ok(())
}

fn check_mesh(mesh: &RecordedMesh, surfaces: usize) -> Checked {
    let name = &mesh.name;
    if mesh.normals.len() != mesh.positions.len() {
        return Err(RecordingError::BadCount {
            what: format!("the normals of the mesh \"{name}\""),
            count: mesh.normals.len(),
            expected: format!("{}, one per position, are", mesh.positions.len()),
        });
    }
    let count = mesh.positions.len();
    for uvs in mesh.more_uvs.iter().chain([&mesh.uvs]) {
        per_position(uvs, count, || {
            format!("texture coordinates of the mesh \"{name}\"")
        })?;
    }
    for uvs in mesh.more_uvs.iter().filter(|_| count > 0) {
        index(0, uvs.len(), || {
            format!("a further set of texture coordinates of the mesh \"{name}\"")
        })?;
    }
    per_position(&mesh.colors, count, || {
        format!("colours of the mesh \"{name}\"")
    })?;
    per_position(&mesh.marks, count, || {
        format!("marks of the mesh \"{name}\"")
    })?;
    for (i, (&position, &normal)) in mesh.positions.iter().zip(&mesh.normals).enumerate() {
        finite_vector(position, || format!("position {i} of the mesh \"{name}\""))?;
        finite_vector(normal, || format!("normal {i} of the mesh \"{name}\""))?;
    }
    for (p, part) in mesh.parts.iter().enumerate() {
        index(part.surface, surfaces, || {
            format!("the surface of part {p} of the mesh \"{name}\"")
        })?;
        if part.indices.len() % 3 != 0 {
            return Err(RecordingError::BadCount {
                what: format!("the index list of part {p} of the mesh \"{name}\""),
                count: part.indices.len(),
                expected: "a multiple of three is".into(),
            });
        }
        for (i, &vertex) in part.indices.iter().enumerate() {
            let what = || format!("index {i} of part {p} of the mesh \"{name}\"");
            index(vertex as usize, mesh.positions.len(), what)?;
        }
    }
    Ok(())
}

/// Checks that there are no rows or one per position, all of finite numbers.
fn per_position<const N: usize>(
    rows: &[[f32; N]],
    count: usize,
    what: impl Fn() -> String,
) -> Checked {
    if !rows.is_empty() && rows.len() != count {
        return Err(RecordingError::BadCount {
            what: format!("the {}", what()),
            count: rows.len(),
            expected: format!("none or {count}, one per position, are"),
        });
    }
    for (i, row) in rows.iter().enumerate() {
        for &part in row {
            finite(f64::from(part), || format!("row {i} of the {}", what()))?;
        }
    }
    Ok(())
}

fn check_node(node: &RecordedNode, meshes: usize, frames: usize) -> Checked {
    let name = &node.name;
    index(node.mesh, meshes, || {
        format!("the mesh of the node \"{name}\"")
    })?;
    if node.poses.len() != 1 && node.poses.len() != frames {
        return Err(RecordingError::BadCount {
            what: format!("the pose list of the node \"{name}\""),
            count: node.poses.len(),
            expected: format!("{frames}, one per frame, or exactly one are"),
        });
    }
    for (frame, pose) in node.poses.iter().enumerate() {
        let what = || format!("the pose of the node \"{name}\" in frame {frame}");
        finite_vector(pose.translation, what)?;
        for part in pose.rotation.to_array() {
            finite(f64::from(part), what)?;
        }
        let length = f64::from(pose.rotation.length());
        // Far from unit length means that it is no rotation at all.
        in_range(length, (0.5..2.0).contains(&length), "close to 1", || {
            format!("the length of the rotation in {}", what())
        })?;
    }
    let (start, end) = (node.visible.start, node.visible.end);
    if end > frames {
        return Err(RecordingError::BadIndex {
            what: format!("the end of the visible frames of the node \"{name}\""),
            index: end,
            count: frames,
        });
    }
    in_range(
        start as f64,
        start <= end,
        "at most the last visible frame",
        || format!("the first visible frame of the node \"{name}\""),
    )?;
    for (key, value) in &node.keep_extras {
        finite(*value, || format!("\"{key}\" of the node \"{name}\""))?;
    }
    Ok(())
}

fn check_floor(floor: &Floor) -> Checked {
    finite(f64::from(floor.height), || "the height of the floor".into())?;
    let colours = floor.base_color.into_iter();
    colours
        .into_iter()
        .try_for_each(|part| fraction(part, || "a colour of the floor".into()))
}

fn fraction(value: f32, what: impl Fn() -> String) -> Checked {
    let value = f64::from(value);
    finite(value, &what)?;
    in_range(value, (0.0..=1.0).contains(&value), "from 0 to 1", what)
}

fn finite_vector(vector: Vec3, what: impl Fn() -> String) -> Checked {
    vector
        .to_array()
        .iter()
        .try_for_each(|&part| finite(f64::from(part), &what))
}

fn finite(value: f64, what: impl Fn() -> String) -> Checked {
    if value.is_finite() {
        return Ok(());
    }
    Err(RecordingError::NotFinite {
        what: what(),
        value,
    })
}

fn in_range(value: f64, holds: bool, range: &'static str, what: impl Fn() -> String) -> Checked {
    if holds {
        return Ok(());
    }
    Err(RecordingError::OutOfRange {
        what: what(),
        value,
        range,
    })
}

fn index(index: usize, count: usize, what: impl Fn() -> String) -> Checked {
    if index < count {
        return Ok(());
    }
    Err(RecordingError::BadIndex {
        what: what(),
        index,
        count,
    })
}
