//! Arbitrary numbers, and an asset made of such that fit together but mean nothing.

use frangible::glam::Vec3;
use frangible::internals::asset::{
    AnalysisMesh, AssetParts, Blending, ConvexCell, EmbeddedPoint, Embedding, Image, ImageKind,
    OuterSurface, Placement, RenderMaterial, RenderSurface, Texture, TextureSlot, Wrap,
};
use frangible::internals::modal::ModalBasis;
use frangible::internals::stress::StressBounds;
use frangible::internals::{MassProperties, TetMesh};
use frangible::{Asset, Material};

/// How much of everything.
pub(crate) struct Size {
    /// Cubes of six tetrahedra along each axis.
    pub(crate) cubes: usize,
    /// Analysis nodes, 10 and up.
    pub(crate) analysis_nodes: usize,
    /// Analysis elements, 1 and up.
    pub(crate) elements: usize,
    /// Modes.
    pub(crate) modes: usize,
}

/// Numbers in 0..1 that differ in all their bits (a linear congruential generator).
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn f32(&mut self) -> f32 {
        self.next() as f32 - 0.5
    }

    fn vec3(&mut self) -> Vec3 {
        Vec3::new(self.f32(), self.f32(), self.f32())
    }

    fn index(&mut self, below: usize) -> u32 {
        (self.next() * below as f64) as u32
    }
}

/// A block of Kuhn's tetrahedra, one convex cell per cube, all else arbitrary.
pub(crate) fn synthetic_asset(size: &Size) -> Asset {
    let mut numbers = Numbers(1);
    let n = size.cubes;
    let node = |i: usize, j: usize, k: usize| (i + (n + 1) * (j + (n + 1) * k)) as u32;
    let mut positions = Vec::new();
    for k in 0..=n {
        for j in 0..=n {
            for i in 0..=n {
                let corner = Vec3::new(i as f32, j as f32, k as f32) - 0.5 * n as f32;
                positions.push(0.01 * (corner + 0.1 * numbers.vec3()));
            }
        }
    }
    let (mut tets, mut cell_of_tet, mut cells) = (Vec::new(), Vec::new(), Vec::new());
    for at in 0..n * n * n {
        let (i, j, k) = (at % n, at / n % n, at / (n * n));
        let c: [u32; 8] =
            std::array::from_fn(|b| node(i + (b & 1), j + (b >> 1 & 1), k + (b >> 2)));
        for [a, b] in [[1, 3], [3, 2], [2, 6], [6, 4], [4, 5], [5, 1]] {
            tets.push([c[0], c[a], c[b], c[7]]);
            cell_of_tet.push(at as u32);
        }
        let points = c.iter().map(|&v| positions[v as usize]).collect();
        cells.push(ConvexCell { points });
    }
    let fracture = TetMesh::new(positions, tets);
    let material = Material::preset("glass").unwrap();
    let corners = (0..fracture.tets.len()).map(|e| fracture.corners(e).map(Vec3::as_dvec3));
    let mass = MassProperties::of_tetrahedra(material.density, corners);
    let boundary = fracture.boundary();
    let surface = OuterSurface {
        normals: boundary
            .iter()
            .map(|_| [numbers.vec3(), -Vec3::ZERO, Vec3::Z])
            .collect(),
        curvature_radius: (0..boundary.len())
            .map(|t| {
                if t % 2 == 0 {
                    f32::INFINITY
                } else {
                    1.0 + numbers.f32()
                }
            })
            .collect(),
        tets: boundary.iter().map(|b| b.1).collect(),
        triangles: boundary.into_iter().map(|b| b.0).collect(),
        ..OuterSurface::default()
    };
    let analysis = AnalysisMesh {
        nodes: (0..size.analysis_nodes).map(|_| numbers.vec3()).collect(),
        elements: (0..size.elements)
            .map(|_| std::array::from_fn(|_| numbers.index(size.analysis_nodes)))
            .collect(),
        barycentric_gradients: (0..size.elements)
            .map(|_| std::array::from_fn(|_| numbers.vec3()))
            .collect(),
    };
    let mut point = || EmbeddedPoint {
        element: numbers.index(size.elements),
        barycentric: std::array::from_fn(|_| numbers.f32()),
        offset: numbers.vec3(),
    };
    let embedding = Embedding {
        tets: fracture.tets.iter().map(|_| point()).collect(),
        nodes: fracture.positions.iter().map(|_| point()).collect(),
    };
    let shapes = 3 * size.analysis_nodes * size.modes;
    let modes = ModalBasis {
        eigenvalues: (0..size.modes)
            .map(|i| 1e6 * (i as f64 + numbers.next()))
            .collect(),
        shapes: (0..shapes).map(|_| numbers.f32()).collect(),
        peak_stress: (0..size.modes).map(|_| 1.0 + numbers.f32()).collect(),
        ..ModalBasis::default()
    };
    let bounds = StressBounds {
        cluster_of_tet: (0..fracture.tets.len() as u32).map(|e| e % 2).collect(),
        stress: (0..2 * size.modes).map(|_| 1.0 + numbers.f32()).collect(),
        gradient: (0..2 * size.modes).map(|_| 1.0 + numbers.f32()).collect(),
    };
    Asset::from_parts(AssetParts {
        name: "Vase – größer".into(),
        material,
        fracture: fracture.into(),
        surface,
        analysis,
        embedding,
        modes,
        bounds,
        mass,
        cells,
        cell_of_tet,
        supported: Vec::new(),
        render: None,
        portion: None,
    })
}

/// Two triangles, two materials.
pub(crate) fn drawn_surface() -> RenderSurface {
    let material = |name: &str, roughness| RenderMaterial {
        name: name.into(),
        base_color: [0.1, 0.2, 0.3, 1.0],
        metallic: 0.0,
        roughness,
        ..RenderMaterial::default()
    };
    let mut shining = material("Glasur – blau", 0.25);
    shining.emission = [0.5, 2.5, 0.0];
    shining.double_sided = true;
    shining.blending = Blending::Mask(0.25);
    shining.textures = vec![Texture {
        slot: TextureSlot::Normal,
        image: 0,
        uv_set: 1,
        wrap: [Wrap::Clamp, Wrap::Mirror],
        is_pixelated: true,
        strength: 0.5,
        placement: Placement {
            offset: [0.1, 0.2],
            rotation: 0.3,
            scale: [-1.0, 2.0],
        },
    }];
    RenderSurface {
        name: "Vase".into(),
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z],
        normals: vec![Vec3::Z; 4],
        colors: vec![[1.0, 0.0, 0.5, 1.0], [0.0; 4], [1.0; 4], [0.25; 4]],
        srgb_colors: true,
        uvs: vec![[0.0, -0.0], [1.0, 0.0], [0.0, 1.0], [1.5, -1.5]],
        triangles: vec![[0, 1, 2], [0, 3, 1]],
        material_of_triangle: vec![1, 0],
        materials: vec![shining, material("", 1.0)],
        more_uvs: vec![vec![[0.5, -1.0]; 4]],
        images: vec![Image {
            name: "Höhe.png".into(),
            kind: ImageKind::Png,
            bytes: b"\x89PNG\r\n\x1a\n\0\xff".as_slice().into(),
        }],
    }
}
