//! Data of a kind of body on the GPU.

use std::sync::Arc;

use frangible::{Asset, Breakable, FractureConfig, Material};
use wgpu::{Buffer, BufferUsages};

use super::device::Gpu;
use super::error::GpuError;
use super::scratch::MOST;

/// A kind of body, its mode shapes and meshes on the GPU. Dropping it frees them.
#[derive(Clone, Debug)]
pub struct Loaded {
    pub(crate) kind: Breakable,
    /// Largest stress and gradient of every mode.
    pub(crate) root: Arc<[[f32; 2]]>,
    pub(crate) buffers: Arc<Buffers>,
}

/// Buffers of a kind.
#[derive(Debug)]
pub(crate) struct Buffers {
    pub(crate) shapes: Buffer,
    pub(crate) elements: Buffer,
    /// Per mode its largest stress and gradient.
    pub(crate) root: Buffer,
    /// Per cluster and mode the same.
    pub(crate) clusters: Buffer,
    /// The device they are on.
    pub(crate) device: wgpu::Device,
}

impl Loaded {
    pub(crate) fn asset(&self) -> &Asset {
        self.kind.asset()
    }

    /// Number of clusters of tetrahedra.
    pub(crate) fn clusters(&self) -> usize {
        self.kind.stress_bounds().stress.len() / self.root.len().max(1)
    }
}

fn pairs<'a>(stress: &'a [f32], gradient: &'a [f32]) -> impl Iterator<Item = [f32; 2]> + 'a {
    stress.iter().zip(gradient).map(|(&s, &g)| [s, g])
}

/// k of the bound's quadratic term, Pa: max(3λ, 0) + 2μ, λ and μ Lamé's parameters; none where strain is linear.
pub(crate) fn quadratic_modulus(material: &Material, config: &FractureConfig) -> f64 {
    if config.is_paper() {
        (3.0 * material.lame_lambda()).max(0.0) + 2.0 * material.shear_modulus()
    } else {
        0.0
    }
}

impl Gpu {
    /// Loads a kind of body; once for all its bodies.
    ///
    /// # Errors
    /// A kind whose arrays do not fit the GPU's buffers.
    pub fn load(&self, kind: &Breakable) -> Result<Loaded, GpuError> {
        let asset = kind.asset();
        let (stress, gradient) = kind.stress_bounds().root(asset.modes().count());
        let root: Arc<[[f32; 2]]> = pairs(&stress, &gradient).collect();
        let buffers = self.checked(|| {
            let elements: Vec<u32> = (0..asset.analysis().elements.len())
                .flat_map(|e| element_words(asset, e))
                .collect();
            let bounds = kind.stress_bounds();
            let clusters: Vec<[f32; 2]> = pairs(&bounds.stress, &bounds.gradient).collect();
            let buffer = |what, bytes: &[u8]| self.fixed(asset, what, bytes);
            Ok(Buffers {
                shapes: buffer(
                    "the mode shapes",
                    bytemuck::cast_slice(&asset.modes().shapes),
                )?,
                elements: buffer("the analysis mesh", bytemuck::cast_slice(&elements))?,
                root: buffer("the stress bounds", bytemuck::cast_slice(&root))?,
                clusters: buffer("the stress bounds", bytemuck::cast_slice(&clusters))?,
                device: self.device.clone(),
            })
        })?;
        Ok(Loaded {
            kind: kind.clone(),
            root,
            buffers: Arc::new(buffers),
        })
    }

    /// A buffer that never changes.
    fn fixed(&self, asset: &Asset, what: &'static str, bytes: &[u8]) -> Result<Buffer, GpuError> {
        let size = (bytes.len() as u64).max(16);
        if size > MOST {
            return Err(GpuError::TooLarge {
                what,
                asset: asset.name().to_owned(),
                bytes: size,
                limit: MOST,
            });
        }
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(what),
            size,
            usage: BufferUsages::STORAGE | BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, bytes);
        Ok(buffer)
    }
}

/// An analysis element in the form that the shader's `elements` has.
fn element_words(asset: &Asset, element: usize) -> [u32; 24] {
    let mut words = [0; 24];
    words[..10].copy_from_slice(&asset.analysis().elements[element]);
    let gradients = asset.analysis().barycentric_gradients[element];
    for (word, x) in words[12..]
        .iter_mut()
        .zip(gradients.iter().flat_map(|g| g.to_array()))
    {
        *word = x.to_bits();
    }
    words
}
