//! The bodies of Table 1 of `[G12]`, as far as the paper describes them, and the blows, which are ours.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::{Asset, Contact, Material, Striker};
use frangible_bake::{MeshSize, Shape, SolidShape, TetShape};
use frangible_mesh::ready_shape;
use serde::Serialize;

use crate::Result;
use crate::bench::grid;

/// Modes of every body, as in the paper.
pub const MODES: usize = 100;

/// Sides of the slabs, m: small enough that their weak points, 4e7 per m³ as in glass, hardly grow with the mesh, as the paper
/// says of its own.
const SLAB: [f64; 3] = [0.1, 0.1, 0.005];

/// Elements that carry the modes of a slab, with some 3 200 nodes.
const SLAB_ELEMENTS: f64 = 1500.0;

/// Tetrahedra asked of the mesher for the pig.
pub(crate) const PIG_TETS: usize = 21_460;

/// Growth of the pig to all sides, m: with the paper's few tetrahedra its wall is just over one cell thick, and nodes and tetrahedra both come near
/// the paper's. Found by trying.
pub(crate) const PIG_GROWN: f64 = 3e-4;

/// Shape, analysis mesh, fracture mesh.
pub type Geometry = (Shape, Option<MeshSize>, Option<MeshSize>);

/// A line of Table 1: one thread of a 2.3 GHz Core2, initiation also on a Quadro FX 3700M.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Paper {
    /// Nodes of the body.
    pub nodes: usize,
    /// Its tetrahedra.
    pub tets: usize,
    /// Initiation on the processor, ms.
    pub initiation_cpu_ms: f64,
    /// Initiation on the graphics card, ms.
    pub initiation_gpu_ms: f64,
    /// Propagation, ms.
    pub propagation_ms: f64,
    /// Fragments, ms.
    pub fragments_ms: f64,
}

/// A blow, which the paper does not describe.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Blow {
    /// Point of impact, in shares of the body's box.
    pub at: [f32; 3],
    /// Direction of the impulse on the body, of any length.
    pub toward: [f32; 3],
    /// Speed of approach, m/s.
    pub speed: f64,
    /// Speed of approach in our model, m/s. It takes more there, because cracks have to be paid for.
    pub speed_ours: f64,
    /// Mass of the steel ball that hits, kg; without one the body lands on flat stone.
    pub ball: Option<f64>,
}

/// A body of Table 1 and the blow it gets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Subject {
    /// Its name on the command line.
    pub name: &'static str,
    /// Preset with the paper's parameters.
    pub material: &'static str,
    /// The paper's line.
    pub paper: Paper,
    /// The blow.
    pub blow: Blow,
}

/// The bodies in the paper's order. The speeds are chosen so that cracks cross some hundreds to thousands of tetrahedra, more in
/// the finer slabs: at 2 to 5 µs each that is what the paper's times of propagation may stand for.
/// The pig stands twice in the paper, with the same mesh and two blows.
pub const SUBJECTS: [Subject; 8] = [
    Subject {
        name: "glass",
        material: "paper-glass",
        paper: paper(7_912, 24_410, [34.0, 3.5, 5.1, 1.3]),
        blow: Blow {
            at: [1.0, 0.5, 0.98],
            toward: [-1.0, 0.0, -0.3],
            speed: 30.0,
            speed_ours: 100.0,
            ball: Some(0.06),
        },
    },
    Subject {
        name: "pig",
        material: "paper-piggy",
        paper: paper(5_992, 20_777, [66.0, 8.3, 6.6, 6.0]),
        blow: PIG,
    },
    Subject {
        name: "pig-harder",
        material: "paper-piggy",
        paper: paper(5_992, 20_777, [150.0, 15.0, 12.3, 6.4]),
        blow: Blow {
            speed: 48.0,
            speed_ours: 48.0,
            ..PIG
        },
    },
    slab(
        "slab-low",
        "paper-slab-low",
        paper(644, 1_740, [12.0, 1.7, 0.8, 0.6]),
    ),
    slab(
        "slab-moderate",
        "paper-slab",
        paper(2_761, 8_190, [17.0, 3.9, 2.4, 0.37]),
    ),
    slab(
        "slab-high",
        "paper-slab-high",
        paper(12_017, 39_901, [25.0, 7.0, 6.0, 17.0]),
    ),
    slab(
        "slab-very-high",
        "paper-slab-very-high",
        paper(50_476, 175_095, [26.0, 7.0, 25.0, 21.0]),
    ),
    Subject {
        name: "rabbit",
        material: "paper-rabbit",
        paper: paper(5_089, 18_767, [42.0, 3.2, 6.0, 7.0]),
        blow: Blow {
            at: [0.5, 1.0, 0.35],
            toward: [0.1, -1.0, 0.0],
            speed: 120.0,
            speed_ours: 120.0,
            ball: None,
        },
    },
];

const PIG: Blow = Blow {
    at: [0.6, 0.55, 1.0],
    toward: [0.0, 0.0, -1.0],
    speed: 36.0,
    speed_ours: 36.0,
    ball: Some(0.13),
};

const SLAB_BLOW: Blow = Blow {
    at: [0.55, 0.53, 1.0],
    toward: [0.0, 0.0, -1.0],
    speed: 35.0,
    speed_ours: 40.0,
    ball: Some(0.13),
};

const fn slab(name: &'static str, material: &'static str, paper: Paper) -> Subject {
    Subject {
        name,
        material,
        paper,
        blow: SLAB_BLOW,
    }
}

const fn paper(nodes: usize, tets: usize, ms: [f64; 4]) -> Paper {
    Paper {
        nodes,
        tets,
        initiation_cpu_ms: ms[0],
        initiation_gpu_ms: ms[1],
        propagation_ms: ms[2],
        fragments_ms: ms[3],
    }
}

/// The bodies of these names, all of none.
///
/// # Errors
/// A name that is none of theirs.
pub fn chosen(names: &[String]) -> Result<Vec<&'static Subject>> {
    let known = |name: &String| {
        let known = SUBJECTS.iter().find(|s| s.name == name);
        let names = SUBJECTS.map(|s| s.name).join(", ");
        known.ok_or_else(|| format!("there is no body `{name}`; the bodies are {names}").into())
    };
    if names.is_empty() {
        return Ok(SUBJECTS.iter().collect());
    }
    names.iter().map(known).collect()
}

impl Subject {
    /// Shape, elements of the analysis mesh and of the fracture mesh; `None` where the bake's default serves or the shape has
    /// its own.
    ///
    /// # Errors
    /// A body that cannot be meshed.
    pub fn geometry(&self) -> Result<Geometry> {
        let slab = |x, y| {
            let body = grid::slab(SLAB, [x, y, 2]);
            // As the bake counts the elements that cover a body: 12.6 per cube.
            let edge = (12.6 * body.volume() / SLAB_ELEMENTS).cbrt();
            let analysis = Some(MeshSize { edge, layers: 0 });
            (Shape::Tets(TetShape::new(body)), analysis, None)
        };
        Ok(match self.name {
            "glass" => {
                let fracture = MeshSize {
                    edge: 2.72e-3,
                    layers: 1,
                };
                (Shape::drinking_glass(), None, Some(fracture))
            }
            "slab-low" => slab(14, 13),
            "slab-moderate" => slab(29, 29),
            "slab-high" => slab(64, 63),
            "slab-very-high" => slab(131, 131),
            "rabbit" => (solid("rabbit", 0.0, 18_767)?, None, None),
            _ => (solid("piggy_bank", PIG_GROWN, PIG_TETS)?, None, None),
        })
    }

    /// Name of its baked file: the pig is baked once.
    #[must_use]
    pub fn file(&self) -> &'static str {
        if self.name == "pig-harder" {
            "pig"
        } else {
            self.name
        }
    }

    /// Its blow at this speed, m/s, on the baked body, with the impulse that rigid bodies would exchange.
    ///
    /// # Errors
    /// None but a preset that is missing.
    pub fn contact(&self, asset: &Asset, speed: f64) -> Result<Contact> {
        let (low, high) = asset
            .fracture()
            .positions
            .iter()
            .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(low, high), &p| {
                (low.min(p), high.max(p))
            });
        let point = low + (high - low) * Vec3::from_array(self.blow.at);
        let striker = match self.blow.ball {
            Some(mass) => steel_ball(mass)?,
            None => Striker::fixed(&Material::preset("stone")?),
        };
        Ok(Contact::collision(
            asset,
            point,
            Vec3::from_array(self.blow.toward),
            speed,
            striker,
        ))
    }
}

/// A ready solid, grown by so much to all sides, m, in about so many tetrahedra.
pub(crate) fn solid(name: &str, grown: f64, tets: usize) -> Result<Shape> {
    let Some(solid) = ready_shape(name) else {
        return Err(crate::Error::from(format!("there is no solid `{name}`")));
    };
    let mut shape = SolidShape::new(Arc::new(solid.grown(grown)));
    shape.tets = tets;
    Ok(Shape::Solid(shape))
}

/// A steel ball of this mass, kg.
///
/// # Errors
/// None but a preset that is missing.
pub fn steel_ball(mass: f64) -> Result<Striker> {
    let steel = Material::preset("steel")?;
    let radius = (0.75 * mass / steel.density / std::f64::consts::PI).cbrt();
    Ok(Striker::ball(&steel, mass, radius).with_restitution(0.5))
}

#[cfg(test)]
mod tests {
    use super::{SUBJECTS, Subject};
    use frangible_bake::Shape;
    use frangible_mesh::{Resolution, TetOptions, tetrahedralize};

    /// Nodes and tetrahedra as the bake makes them.
    fn counts(subject: &Subject) -> [usize; 2] {
        match subject.geometry().unwrap() {
            (Shape::Solid(solid), ..) => {
                let mut options = TetOptions::default();
                options.resolution = Resolution::Tets(solid.tets);
                options.irregular = Some(1);
                let report = tetrahedralize(solid.solid.as_ref(), &options).unwrap().1;
                [report.nodes, report.tets]
            }
            (Shape::Tets(tets), ..) => [tets.body.positions.len(), tets.body.tets.len()],
            (shape, _, size) => {
                let mesh = shape.fracture_mesh(size.unwrap(), 1).unwrap();
                [mesh.positions.len(), mesh.tets.len()]
            }
        }
    }

    #[test]
    fn the_bodies_have_the_papers_sizes() {
        for subject in &SUBJECTS {
            let paper = [subject.paper.nodes, subject.paper.tets];
            let own = counts(subject);
            for (what, (own, paper)) in ["nodes", "tetrahedra"].iter().zip(own.iter().zip(paper)) {
                let off = *own as f64 / paper as f64 - 1.0;
                // A lattice has more tetrahedra per node than the paper's bunny.
                let allowed = if (subject.name, *what) == ("rabbit", "nodes") {
                    0.17
                } else {
                    0.05
                };
                assert!(
                    off.abs() <= allowed,
                    "{}: {own} {what}, not {paper}",
                    subject.name
                );
            }
        }
    }
}
