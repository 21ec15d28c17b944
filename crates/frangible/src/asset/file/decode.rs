//! Bytes to asset.

use std::sync::Arc;

use glam::{DMat3, DVec3, Vec3};

use super::AssetFileError;
use super::drawn;
use super::reader::Reader;
use super::sections::{self as s, Section};
use crate::asset::half::Half;
use crate::asset::{
    AnalysisMesh, Asset, ConvexCell, EmbeddedPoint, Embedding, OuterSurface, StressBounds,
    SurfaceWalls,
};
use crate::material::{Laminate, Material};
use crate::mesh::{MassProperties, TetMesh};
use crate::modal::ModalBasis;

impl Asset {
    /// Reads what [`Asset::to_bytes`] wrote. Sections of unknown number are skipped.
    ///
    /// Nothing is trusted: the asset that this returns has passed [`Asset::validate`].
    ///
    /// # Errors
    /// [`AssetFileError`]: bytes of another kind or version, missing or changed ones, sections that do not fit
    /// in the file, arrays that do not fit together.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, AssetFileError> {
        let r = Reader::new(bytes)?;
        let of_tets = [s::TET_ELEMENTS, s::TET_BARYCENTRIC, s::TET_OFFSETS];
        let of_nodes = [s::NODE_ELEMENTS, s::NODE_BARYCENTRIC, s::NODE_OFFSETS];
        let asset = Self {
            name: r.text(s::NAME)?.to_owned(),
            material: Material {
                residual_stress: match r.has(s::RESIDUAL_STRESS) {
                    true => r.one(s::RESIDUAL_STRESS)?,
                    false => 0.0,
                },
                laminate: match r.has(s::LAMINATE) {
                    true => Some(Laminate::of_numbers(r.one(s::LAMINATE)?)),
                    false => None,
                },
                ..material(r.text(s::MATERIAL_NAME)?, r.one(s::MATERIAL)?)
            },
            fracture: Arc::new(TetMesh {
                positions: r.rows(s::POSITIONS)?,
                tets: r.rows(s::TETS)?,
                neighbours: r.rows(s::NEIGHBOURS)?,
            }),
            surface: OuterSurface {
                triangles: r.rows(s::SURFACE_TRIANGLES)?,
                tets: r.rows(s::SURFACE_TETS)?,
                normals: r.rows(s::SURFACE_NORMALS)?,
                curvature_radius: r.rows(s::SURFACE_CURVATURE)?,
                walls: walls(&r)?,
            },
            analysis: AnalysisMesh {
                nodes: r.rows(s::ANALYSIS_NODES)?,
                elements: r.rows(s::ANALYSIS_ELEMENTS)?,
                barycentric_gradients: r.rows(s::ANALYSIS_GRADIENTS)?,
            },
            embedding: Embedding {
                tets: embedded(&r, of_tets)?,
                nodes: embedded(&r, of_nodes)?,
            },
            modes: ModalBasis {
                eigenvalues: r.rows(s::EIGENVALUES)?,
                shapes: shapes(&r)?,
                peak_stress: r.rows(s::PEAK_STRESS)?,
                residual_modes: r.one::<u32>(s::RESIDUAL_MODES)? as usize,
            },
            bounds: bounds(&r)?,
            mass: mass(r.one(s::MASS)?),
            cells: cells(&r)?,
            cell_of_tet: r.rows(s::CELL_OF_TET)?,
            supported: supported(&r)?,
            render: drawn::decode(&r)?,
            portion: None,
        };
        asset.validate()?;
        Ok(asset)
    }
}

fn material(name: &str, numbers: [f64; 15]) -> Material {
    let [
        youngs_modulus,
        poisson_ratio,
        density,
        stiffness_damping,
        mass_damping,
        strength,
        fracture_energy,
        energy_depth,
        weak_point_density,
        branching_constant,
        roughness_amplitude,
        roughness_wavelength,
        crushing_pressure,
        restitution,
        friction,
    ] = numbers;
    Material {
        name: name.to_owned(),
        youngs_modulus,
        poisson_ratio,
        density,
        stiffness_damping,
        mass_damping,
        strength,
        fracture_energy,
        energy_depth,
        weak_point_density,
        branching_constant,
        roughness_amplitude,
        roughness_wavelength,
        crushing_pressure,
        restitution,
        friction,
        residual_stress: 0.0,
        laminate: None,
    }
}

fn mass([mass, volume, x, y, z, inertia @ ..]: [f64; 14]) -> MassProperties {
    MassProperties {
        mass,
        volume,
        centre: DVec3::new(x, y, z),
        inertia: DMat3::from_cols_array(&inertia),
    }
}

fn embedded(r: &Reader<'_>, sections: [Section; 3]) -> Result<Vec<EmbeddedPoint>, AssetFileError> {
    let [of_elements, of_barycentric, of_offsets] = sections;
    let elements = r.each::<u32>(of_elements)?;
    let barycentric = r.each::<[f32; 4]>(of_barycentric)?;
    let check = |section: Section, rows: usize| {
        if rows == elements.len() {
            return Ok(());
        }
        let problem = format!("has {rows} rows, not {}", elements.len());
        Err(AssetFileError::section(section.name, problem))
    };
    check(of_barycentric, barycentric.len())?;
    let offsets = if r.has(of_offsets) {
        let offsets = r.each::<Vec3>(of_offsets)?;
        check(of_offsets, offsets.len())?;
        Some(offsets)
    } else {
        None
    };
    let points = elements.zip(barycentric);
    let mut points: Vec<EmbeddedPoint> = points
        .map(|(element, barycentric)| EmbeddedPoint {
            element,
            barycentric,
            offset: Vec3::ZERO,
        })
        .collect();
    for (point, offset) in points.iter_mut().zip(offsets.into_iter().flatten()) {
        point.offset = offset;
    }
    Ok(points)
}

fn cells(r: &Reader<'_>) -> Result<Vec<ConvexCell>, AssetFileError> {
    let mut points = r.each::<Vec3>(s::CELL_POINTS)?;
    let sizes = r.rows::<u32>(s::CELL_SIZES)?;
    // Empty cells would let four bytes of file ask for many times that of memory.
    let sound = !sizes.contains(&0) && sum(&sizes) == points.len() as u64;
    if !sound {
        let problem = format!(
            "does not divide the {} cell points into cells of one point or more",
            points.len()
        );
        return Err(AssetFileError::section(s::CELL_SIZES.name, problem));
    }
    let cell = |&size: &u32| ConvexCell {
        points: points.by_ref().take(size as usize).collect(),
    };
    Ok(sizes.iter().map(cell).collect())
}

/// The walls behind the surface, where there are any: all of their sections or none.
fn walls(r: &Reader<'_>) -> Result<SurfaceWalls, AssetFileError> {
    let sections = [s::WALL_THICKNESS, s::WALL_STIFFENING, s::WALL_MARGIN];
    if !sections.iter().any(|&section| r.has(section)) {
        return Ok(SurfaceWalls::default());
    }
    Ok(SurfaceWalls {
        thickness: r.rows(s::WALL_THICKNESS)?,
        stiffening: r.rows(s::WALL_STIFFENING)?,
        margin: r.rows(s::WALL_MARGIN)?,
    })
}

/// The stress bounds, where the file has them.
fn bounds(r: &Reader<'_>) -> Result<StressBounds, AssetFileError> {
    let sections = [s::BOUND_CLUSTERS, s::STRESS_BOUNDS, s::GRADIENT_BOUNDS];
    if !sections.iter().any(|&section| r.has(section)) {
        return Ok(StressBounds::default());
    }
    Ok(StressBounds {
        cluster_of_tet: r.rows(s::BOUND_CLUSTERS)?,
        stress: r.rows(s::STRESS_BOUNDS)?,
        gradient: r.rows(s::GRADIENT_BOUNDS)?,
    })
}

/// Mode shapes: as they are, or in half precision times the scale of their column.
fn shapes(r: &Reader<'_>) -> Result<Vec<f32>, AssetFileError> {
    if r.has(s::MODE_SHAPES) {
        return r.rows(s::MODE_SHAPES);
    }
    let scales = r.rows::<f32>(s::HALF_SCALES)?;
    if let Some(mode) = scales.iter().position(|s| !(s.is_finite() && *s > 0.0)) {
        let problem = format!("has a value that is not finite and above zero, for mode {mode}");
        return Err(AssetFileError::section(s::HALF_SCALES.name, problem));
    }
    let halves = r.each::<Half>(s::HALF_SHAPES)?;
    if halves.len() > 0 && (scales.is_empty() || !halves.len().is_multiple_of(scales.len())) {
        let problem = format!(
            "has {} numbers, which is not a whole number of rows of {} modes",
            halves.len(),
            scales.len()
        );
        return Err(AssetFileError::section(s::HALF_SHAPES.name, problem));
    }
    let columns = scales.iter().cycle();
    Ok(halves.zip(columns).map(|(h, s)| h.value() * s).collect())
}

/// The nodes that something holds; none of a free body, whose file has no such section.
fn supported(r: &Reader<'_>) -> Result<Vec<u32>, AssetFileError> {
    if !r.has(s::SUPPORTED) {
        return Ok(Vec::new());
    }
    let nodes = r.rows(s::SUPPORTED)?;
    if nodes.is_empty() {
        let problem = "is empty, although a free body has no such section";
        return Err(AssetFileError::section(s::SUPPORTED.name, problem));
    }
    Ok(nodes)
}

/// Sum of the lengths of rows that lie one after another.
pub(super) fn sum(sizes: &[u32]) -> u64 {
    sizes.iter().map(|&n| u64::from(n)).sum()
}
