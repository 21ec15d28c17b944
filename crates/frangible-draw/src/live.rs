//! The stage in a window: the lights, materials and floor of the pictures, drawn continuously.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use frangible_photo::internals::{
    Caster, Casting, Fineness, FloorShadow, StageUnits, clarity, key_light,
};
use frangible_recording::glam::Vec3;
use frangible_recording::{Floor, SurfaceMaterial, View};
use kiss3d::color::Color;
use kiss3d::resource::{GpuMesh3d, Texture};
use kiss3d::scene::SceneNode3d;
use kiss3d::window::Window;

use crate::backdrop::{HAZE, furnish, haze, surround};
use crate::color_map::color_of;
use crate::field::{dress_in_values, palette_texture, texel};
use crate::floor::{Laid, add_floor, texels};
use crate::stage::{add_lights, dress};

/// Appearance of a [`LiveMesh`].
#[derive(Clone, Debug, PartialEq)]
pub enum Looks {
    /// A surface as in the pictures.
    Surface(SurfaceMaterial),
    /// Coloured by its values.
    Values,
    /// Edges only, in this linear red, green and blue.
    Edges([f32; 3]),
}

/// Triangles with the same appearance.
pub struct LiveMesh<'a> {
    /// Appearance of the triangles.
    pub looks: &'a Looks,
    /// Vertices, m.
    pub positions: &'a [Vec3],
    /// Unit normals, one per vertex.
    pub normals: &'a [Vec3],
    /// Value from 0 to 1 of each vertex, for [`Looks::Values`].
    pub values: &'a [f32],
    /// Vertices of each triangle.
    pub faces: &'a Arc<Vec<[u32; 3]>>,
    /// Number that changes when the vertices change; 0 if changes are not tracked.
    pub stamp: u64,
}

/// A mesh on the stage.
struct Actor {
    looks: Looks,
    wireframe: bool,
    stamp: u64,
    faces: Arc<Vec<[u32; 3]>>,
    mesh: Rc<RefCell<GpuMesh3d>>,
    node: SceneNode3d,
}

/// A lit stage in a window, with lights and units for one view.
pub struct LiveStage {
    units: StageUnits,
    scene: SceneNode3d,
    actors: Vec<Actor>,
    floor: Option<SceneNode3d>,
    palette: Arc<Texture>,
    /// True if everything on the stage is opaque, and lit as in life.
    solid: bool,
}

/// Transform from the world to the stage, usable without a stage.
#[derive(Clone, Copy)]
pub struct Place {
    units: StageUnits,
    key: Vec3,
}

impl Place {
    /// The transform of a stage for this view.
    #[must_use]
    pub fn of(view: &View) -> Self {
        let units = StageUnits::of(view);
        Self {
            units,
            key: key_light(&units.view(view)),
        }
    }
}

impl LiveStage {
    /// Makes an empty stage with lights for this view, and sets up the window.
    #[must_use]
    pub fn new(window: &mut Window, view: &View) -> Self {
        furnish(window);
        surround(window, true);
        let units = StageUnits::of(view);
        let mut scene = SceneNode3d::empty();
        add_lights(&mut scene, &units.view(view));
        Self {
            units,
            scene,
            actors: Vec::new(),
            floor: None,
            palette: palette_texture(),
            solid: true,
        }
    }

    /// The scene to draw.
    pub fn scene(&mut self) -> &mut SceneNode3d {
        &mut self.scene
    }

    /// Sets up the window for the contents of the stage, and returns the view in stage units. The haze keeps its distance from the target of the view.
    pub fn look(&self, window: &mut Window, view: &View) -> View {
        // As in the pictures: a map gives glass the shadow of clay, and colours that stand for numbers want none.
        window.set_shadows_enabled(self.solid);
        let view = self.units.view(view);
        // The usual distance, where half the picture's height is 1 at the field of view of the scenes.
        let usual = (0.5 * view.vertical_fov).tan().recip();
        let farther = (view.eye.distance(view.target) - usual).max(0.0);
        haze(window, HAZE.map(|at| at + farther));
        view
    }

    /// Transforms a point of the world, m, to the stage.
    #[must_use]
    pub fn point(&self, world: Vec3) -> Vec3 {
        self.units.point(world)
    }

    /// Shows exactly these meshes. For meshes with the same faces and appearance as at the last call, only the vertices are uploaded, or nothing
    /// if the stamp is unchanged.
    pub fn show<'a>(&mut self, meshes: impl Iterator<Item = LiveMesh<'a>>, wireframe: bool) {
        self.solid = true;
        let mut before = std::mem::take(&mut self.actors);
        for mesh in meshes {
            self.solid &= match mesh.looks {
                Looks::Surface(surface) => clarity(surface) <= 0.0,
                Looks::Values => false,
                Looks::Edges(_) => true,
            };
            let same = before.iter().position(|actor| {
                Arc::ptr_eq(&actor.faces, mesh.faces)
                    && actor.looks == *mesh.looks
                    && actor.wireframe == wireframe
            });
            let actor = match same {
                Some(same) => {
                    let mut actor = before.swap_remove(same);
                    actor.move_to(&mesh);
                    actor
                }
                None => self.enter(&mesh, wireframe),
            };
            self.actors.push(actor);
        }
        for mut actor in before {
            actor.node.remove();
        }
    }

    fn enter(&mut self, mesh: &LiveMesh<'_>, wireframe: bool) -> Actor {
        let valued = *mesh.looks == Looks::Values;
        let texels = valued.then(|| mesh.values.iter().map(|&v| texel(v)).collect());
        let gpu = GpuMesh3d::new(
            mesh.positions.to_vec(),
            mesh.faces.to_vec(),
            Some(mesh.normals.to_vec()),
            texels,
            true,
        );
        let gpu = Rc::new(RefCell::new(gpu));
        // The graphics card does the change of units: vertices are uploaded as they are.
        let StageUnits { origin, scale } = self.units;
        let mut node = self.scene.add_mesh(Rc::clone(&gpu), Vec3::splat(scale));
        node.set_position(-scale * origin);
        match mesh.looks {
            Looks::Surface(surface) => dress(&mut node, surface),
            Looks::Values => dress_in_values(&mut node, Arc::clone(&self.palette)),
            Looks::Edges(_) => {
                node.set_casts_shadows(false);
            }
        }
        let edges = match mesh.looks {
            Looks::Edges(color) => Some(*color),
            _ => wireframe.then_some([0.05, 0.06, 0.07]),
        };
        if let Some([red, green, blue]) = edges {
            node.set_surface_rendering_activation(false);
            node.set_lines_width(1.0, false);
            node.set_lines_color(Some(Color::new(red, green, blue, 1.0)));
        }
        Actor {
            looks: mesh.looks.clone(),
            wireframe,
            stamp: mesh.stamp,
            faces: Arc::clone(mesh.faces),
            mesh: gpu,
            node,
        }
    }

    /// Sets the floor with its shadow, replacing the previous one.
    pub fn lay_floor(&mut self, shadow: Option<&LiveShadow>) {
        if let Some(mut old) = self.floor.take() {
            old.remove();
        }
        if let Some(LiveShadow {
            shadow,
            texels,
            height,
            color,
        }) = shadow
        {
            let lay = Laid {
                height: *height,
                color: *color,
                shadow,
                texels,
                // They would be made on this thread, in tens of milliseconds, and the shadow is soft anyway.
                mipmaps: false,
            };
            self.floor = Some(add_floor(&mut self.scene, lay));
        }
    }

    /// Number of draw calls per frame, for objects and floor without text.
    #[must_use]
    pub fn draw_calls(&self) -> usize {
        self.actors.len() + usize::from(self.floor.is_some())
    }
}

impl Actor {
    fn move_to(&mut self, mesh: &LiveMesh<'_>) {
        if mesh.stamp != 0 && mesh.stamp == self.stamp {
            return;
        }
        self.stamp = mesh.stamp;
        let gpu = self.mesh.borrow();
        for (buffer, from) in [
            (gpu.coords(), mesh.positions),
            (gpu.normals(), mesh.normals),
        ] {
            if let Ok(mut buffer) = buffer.write()
                && let Some(vertices) = buffer.data_mut()
            {
                vertices.clear();
                vertices.extend_from_slice(from);
            }
        }
        if self.looks == Looks::Values
            && let Ok(mut uvs) = gpu.uvs().write()
            && let Some(texels) = uvs.data_mut()
        {
            texels.clear();
            texels.extend(mesh.values.iter().map(|&value| texel(value)));
        }
    }
}

/// Triangles of one surface that cast a shadow on the floor.
pub struct ShadowCaster<'a> {
    /// Its surface.
    pub surface: &'a SurfaceMaterial,
    /// Vertices, m.
    pub positions: &'a [Vec3],
    /// Vertices of each triangle.
    pub faces: &'a [[u32; 3]],
}

/// A computed shadow of the floor, which may come from another thread.
pub struct LiveShadow {
    shadow: FloorShadow,
    texels: Vec<u8>,
    height: f32,
    color: [f32; 3],
}

impl LiveShadow {
    /// Computes the shadow of these casters on a floor. A fine shadow takes 0.05 to 1 s, a coarse one for moving objects a twentieth of that.
    #[must_use]
    pub fn cast(place: Place, casters: &[ShadowCaster<'_>], floor: &Floor, fine: bool) -> Self {
        LiveCasting::begin(place, casters, floor, fine).finish()
    }
}

/// Incremental computation of a shadow, for programs without other threads.
pub struct LiveCasting {
    casting: Casting,
    height: f32,
    color: [f32; 3],
}

impl LiveCasting {
    /// Starts the computation of the shadow that [`LiveShadow::cast`] computes at once.
    #[must_use]
    pub fn begin(place: Place, casters: &[ShadowCaster<'_>], floor: &Floor, fine: bool) -> Self {
        let Place { units, key } = place;
        let height = (floor.height - units.origin.y) * units.scale;
        let mut all = Vec::new();
        for caster in casters {
            let clarity = clarity(caster.surface);
            let one_sided = clarity <= 0.0 && !caster.surface.double_sided;
            all.extend(caster.faces.iter().map(|face| Caster {
                corners: face.map(|corner| units.point(caster.positions[corner as usize])),
                clarity,
                one_sided,
            }));
        }
        let fineness = match fine {
            true => Fineness::STILL,
            false => Fineness::MOVING,
        };
        Self {
            casting: Casting::begin(&all, height, key, fineness),
            height,
            color: floor.base_color,
        }
    }

    /// Does a hundredth of the work of a fine shadow, or a twentieth of a coarse one. Returns false when it is complete.
    pub fn go_on(&mut self) -> bool {
        self.casting.go_on()
    }

    /// Returns the shadow.
    #[must_use]
    pub fn finish(self) -> LiveShadow {
        let shadow = self.casting.finish();
        LiveShadow {
            texels: texels(&shadow),
            shadow,
            height: self.height,
            color: self.color,
        }
    }
}

/// The sRGB colour of a value from 0 to 1 in [`Looks::Values`].
#[must_use]
pub fn value_color(value: f32) -> [u8; 3] {
    color_of(value)
}

/// Returns true if points and wireframes can be drawn in an open window. They require storage buffers, which WebGL 2 lacks.
#[must_use]
pub fn has_storage_buffers() -> bool {
    let limits = kiss3d::context::Context::get().device.limits();
    limits.max_storage_buffers_per_shader_stage > 0
}
