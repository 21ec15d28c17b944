//! The shaders and their pipelines.

/// One pass: its name, and its own part of the shader.
pub(crate) const PASSES: [(&str, &str); 7] = [
    ("amplitudes", include_str!("shaders/amplitudes.wgsl")),
    ("bounds", include_str!("shaders/bounds.wgsl")),
    ("clusters", include_str!("shaders/clusters.wgsl")),
    ("displacements", include_str!("shaders/displacements.wgsl")),
    ("stress", include_str!("shaders/stress.wgsl")),
    ("summaries", include_str!("shaders/summaries.wgsl")),
    ("gather", include_str!("shaders/gather.wgsl")),
];

const COMMON: &str = include_str!("shaders/common.wgsl");

/// Columns of a tile of displacements, and steps from one restart of the response to the next: as in `common.wgsl`.
pub(crate) const COLUMNS: usize = 64;

/// Clusters of tetrahedra per workgroup: as in `common.wgsl`.
pub(crate) const CLUSTERS: usize = 16;

/// Weak tetrahedra per workgroup: as in `stress.wgsl`.
pub(crate) const POINTS: usize = 16;

/// Weak tetrahedra per summary: as in `common.wgsl`.
pub(crate) const TILE: usize = 256;

/// Workgroups along the first axis of a dispatch, at most: as in `common.wgsl`.
pub(crate) const ROW: usize = 32768;

/// Words that come back of an impact before its list: as in `gather.wgsl`.
pub(crate) const HEADER: usize = 11;

/// The whole text of a pass.
pub(crate) fn source(pass: &str) -> String {
    format!("{COMMON}\n{pass}")
}

/// A pass, compiled.
#[derive(Debug)]
pub(crate) struct Pass {
    pub(crate) name: &'static str,
    pub(crate) pipeline: wgpu::ComputePipeline,
}

/// The passes, in the order they run.
#[derive(Debug)]
pub(crate) struct Passes {
    pub(crate) amplitudes: Pass,
    pub(crate) bounds: Pass,
    pub(crate) clusters: Pass,
    pub(crate) displacements: Pass,
    pub(crate) stress: Pass,
    pub(crate) summaries: Pass,
    pub(crate) gather: Pass,
}

impl Passes {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let [
            amplitudes,
            bounds,
            clusters,
            displacements,
            stress,
            summaries,
            gather,
        ] = PASSES.map(|(name, text)| {
            let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(name),
                source: wgpu::ShaderSource::Wgsl(source(text).into()),
            });
            let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(name),
                layout: None,
                module: &module,
                entry_point: Some("main"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
            Pass { name, pipeline }
        });
        Self {
            amplitudes,
            bounds,
            clusters,
            displacements,
            stress,
            summaries,
            gather,
        }
    }
}

#[cfg(test)]
mod tests {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    use naga::{AddressSpace, front::wgsl};

    use super::*;

    /// Checks without a device that the WGSL is valid for any WebGPU, within its default limits.
    #[test]
    fn shaders_are_valid_and_within_the_default_limits_of_webgpu() {
        for (name, text) in PASSES {
            let text = source(text);
            let module = wgsl::parse_str(&text)
                .unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(&text)));
            let mut validator = Validator::new(ValidationFlags::all(), Capabilities::empty());
            validator
                .validate(&module)
                .unwrap_or_else(|e| panic!("{name}: {}", e.emit_to_string(&text)));
            let limits = wgpu::Limits::default();
            let count = |space: fn(AddressSpace) -> bool| {
                module
                    .global_variables
                    .iter()
                    .filter(|(_, v)| space(v.space))
                    .count() as u32
            };
            let storage = count(|s| matches!(s, AddressSpace::Storage { .. }));
            assert!(
                storage <= limits.max_storage_buffers_per_shader_stage,
                "{name}: {storage}"
            );
            let shared: u32 = module
                .global_variables
                .iter()
                .filter(|(_, v)| v.space == AddressSpace::WorkGroup)
                .map(|(_, v)| module.types[v.ty].inner.size(module.to_ctx()))
                .sum();
            assert!(
                shared <= limits.max_compute_workgroup_storage_size,
                "{name}: {shared}"
            );
            let [x, y, z] = module.entry_points[0].workgroup_size;
            assert!(
                x * y * z <= limits.max_compute_invocations_per_workgroup,
                "{name}"
            );
            println!("{name}: {storage} storage buffers, {shared} bytes shared, {x} × {y} × {z}");
        }
    }

    #[test]
    fn constants_of_the_shaders_are_those_of_the_host() {
        let all: String = PASSES.map(|(_, text)| source(text)).concat();
        for line in [
            format!("const POINTS: u32 = {POINTS}u;"),
            format!("const TILE: u32 = {TILE}u;"),
            format!("const COLUMNS: u32 = {COLUMNS}u;"),
            format!("const RESTART: u32 = {COLUMNS}u;"),
            format!("const CLUSTERS: u32 = {CLUSTERS}u;"),
            format!("const ROW: u32 = {ROW}u;"),
            format!("const HEADER: u32 = {HEADER}u;"),
            format!("const DOUBT: f32 = {:e};", crate::gpu::DOUBT),
        ] {
            assert!(all.contains(&line), "{line}");
        }
    }
}
