//! Conversion of the keys of a `[[body]]` to a body.

use std::path::Path;

use frangible::glam::{Quat, Vec3};
use frangible::internals::Fatigue;
use frangible_bake::{PaneShape, Shape, Station};
use frangible_mesh::{PartChoice, did_you_mean};

use super::convert::{preset, set, short, vector};
use super::either::{AxisTable, MaterialChoice, RotationChoice};
use super::schema::{BodyTable, MaterialTable, PaneTable, PartsName, RotationTable, ShapeTable};
use super::support::support;
use crate::body::{BodySpec, Place};
use crate::check::Fault;
use crate::error::SceneError;
use crate::rescale::{MaterialEdit, Rescale};
use crate::source::{Axis, BodySource};

/// Material of a body unless the file says otherwise.
const MATERIAL: &str = "porcelain";

pub(super) fn body(table: BodyTable, usual: String, folder: &Path) -> Result<BodySpec, Fault> {
    let baked = table.asset.is_some();
    let meshed = table.mesh.is_some();
    for (key, given, fits, problem) in [
        (
            "modes",
            table.modes.is_some(),
            !baked,
            "`modes` are part of a baked body; bake it again to change them",
        ),
        (
            "followed",
            table.followed.is_some(),
            !baked,
            "`followed` is part of a baked body; bake it again to change it",
        ),
        (
            "size",
            table.size.is_some(),
            meshed || baked,
            "`size` applies only to a `mesh` or an `asset`",
        ),
        (
            "resolution",
            table.resolution.is_some(),
            !baked,
            "`resolution` is part of a baked body; bake it again to change it",
        ),
        (
            "wall",
            table.wall.is_some(),
            meshed,
            "`wall` applies only to a `mesh`; other shapes define their own walls",
        ),
        (
            "parts",
            table.parts.is_some(),
            meshed,
            "`parts` applies only to a `mesh`; other bodies have one part",
        ),
        (
            "part",
            table.part.is_some(),
            meshed,
            "`part` applies only to a `mesh`; other bodies have one part",
        ),
        (
            "gap",
            table.gap.is_some(),
            table.parts == Some(PartsName::Weld),
            "`gap` applies only to welded parts; set parts = \"weld\"",
        ),
        (
            "part",
            table.part.is_some(),
            table.parts.is_none(),
            "`part` names one part of a mesh, and `parts` is for all; remove one of the two",
        ),
        (
            "up",
            table.up.is_some(),
            meshed,
            "`up` applies only to a `mesh`; turn other bodies with `rotation`",
        ),
    ] {
        if given && !fits {
            return Err(clash(key, problem));
        }
    }
    let source = match (table.shape, table.mesh, table.asset) {
        (Some(shape), None, None) => self::shape(shape, table.resolution)?,
        (None, Some(mesh), None) => {
            let path = folder.join(mesh);
            let up = match table.up {
                None => Axis::up_in(&path),
                Some(given) => axis_up(&given)?,
            };
            BodySource::Mesh {
                path,
                size: table.size,
                up,
                resolution: table.resolution,
                wall: table.wall,
                parts: parts(table.parts, table.gap, table.part),
            }
        }
        (None, None, Some(asset)) => BodySource::Asset(folder.join(asset)),
        (None, None, None) => {
            let problem = "a body needs `shape`, `mesh` or `asset`, for example shape = \"vase\"";
            return Err(clash("shape", problem));
        }
        _ => {
            let problem =
                "a body has exactly one of `shape`, `mesh` and `asset`; remove the others";
            return Err(clash("shape", problem));
        }
    };
    let edit = table.material.map(|MaterialChoice(given)| edit(given));
    let usual_material = preset("material", MATERIAL)?;
    let material = match &edit {
        Some(edit) if !baked => edit
            .apply(&usual_material)
            .map_err(|e| Fault::new("material", e))?,
        _ => usual_material,
    };
    // For meshes and ready solids it is part of the source.
    let own = matches!(source, BodySource::Shape(_));
    let mut body = BodySpec::new(table.name.unwrap_or(usual), source, material);
    if baked {
        body.rescale = Rescale {
            size: table.size,
            material: edit,
        };
    }
    set(&mut body.modes, table.modes);
    body.followed = table.followed;
    body.resolution = table.resolution.filter(|_| own);
    body.place = place(table.position.as_deref(), table.drop)?;
    if let Some(RotationChoice(turns)) = table.rotation {
        body.rotation = rotation(&turns)?;
    }
    set(&mut body.velocity, table.velocity.map(vector));
    set(&mut body.spin, table.spin.map(vector));
    body.supports = table
        .supports
        .into_iter()
        .map(support)
        .collect::<Result<_, _>>()?;
    (body.paint, body.weakness) = super::weakness::weakness(table.weakness)?;
    body.weibull_modulus = table.weibull_modulus;
    body.specimen = table.specimen;
    body.fatigue = table.fatigue.map(|table| Fatigue {
        exponent: table.exponent,
        rate: table.rate,
        increase: table.increase,
    });
    Ok(body)
}

fn shape(table: ShapeTable, resolution: Option<usize>) -> Result<BodySource, Fault> {
    let ready = |name: &str| {
        Ok(BodySource::Ready {
            name: name.into(),
            resolution,
        })
    };
    let shape = match table {
        ShapeTable::PiggyBank => return ready("piggy_bank"),
        ShapeTable::Rabbit => return ready("rabbit"),
        ShapeTable::Statuette => return ready("statuette"),
        ShapeTable::CoffeeCup => return ready("coffee_cup"),
        ShapeTable::BrickSolid => return ready("brick_solid"),
        ShapeTable::HammerHead => return ready("hammer_head"),
        ShapeTable::WineGlass => return ready("wine_glass"),
        ShapeTable::Chandelier => return ready("chandelier"),
        ShapeTable::Candelabrum => return ready("candelabrum"),
        ShapeTable::Coral => return ready("coral"),
        ShapeTable::DrinkingGlass => Shape::drinking_glass(),
        ShapeTable::Bowl => Shape::bowl(),
        ShapeTable::Vase => Shape::vase(),
        ShapeTable::DinnerPlate => Shape::dinner_plate(),
        ShapeTable::Box(size) => Shape::Box { size },
        ShapeTable::Pane(PaneTable { size, corner, bow }) => {
            Shape::Pane(PaneShape { size, corner, bow })
        }
        ShapeTable::Revolution(stations) => Shape::Revolution {
            profile: stations
                .into_iter()
                .map(|s| Station {
                    outer: s.outer,
                    inner: s.inner,
                    corner: s.corner,
                })
                .collect(),
        },
    };
    Ok(BodySource::Shape(shape))
}

fn edit(table: MaterialTable) -> MaterialEdit {
    MaterialEdit {
        preset: table.preset,
        name: table.name,
        numbers: [
            table.youngs_modulus,
            table.poisson_ratio,
            table.density,
            table.stiffness_damping,
            table.mass_damping,
            table.strength,
            table.fracture_energy,
            table.energy_depth,
            table.weak_point_density,
            table.branching_constant,
            table.roughness_amplitude,
            table.roughness_wavelength,
            table.crushing_pressure,
            table.restitution,
            table.friction,
            table.residual_stress,
        ],
        laminate: table.laminate.map(|table| {
            [
                table.plies,
                table.ply,
                table.interlayer,
                table.shear_modulus,
                table.strength,
                table.stretch,
            ]
        }),
    }
}

fn parts(parts: Option<PartsName>, gap: Option<f64>, part: Option<String>) -> PartChoice {
    match (parts, part) {
        (_, Some(name)) => PartChoice::Only(name),
        (None | Some(PartsName::Auto), None) => PartChoice::Auto,
        (Some(PartsName::Separate), None) => PartChoice::Separate,
        (Some(PartsName::Largest), None) => PartChoice::Largest,
        (Some(PartsName::Weld), None) => PartChoice::Weld { gap },
    }
}

fn place(position: Option<&[f64]>, drop: Option<f64>) -> Result<Place, Fault> {
    Ok(match (position, drop) {
        (None, None) => Place::Standing { over: [0.0; 2] },
        (None, Some(height)) => Place::Above {
            height,
            over: [0.0; 2],
        },
        (Some(&[x, z]), None) => Place::Standing {
            over: [x as f32, z as f32],
        },
        (Some(&[x, z]), Some(height)) => Place::Above {
            height,
            over: [x as f32, z as f32],
        },
        (Some(&[x, y, z]), None) => Place::Centre(vector([x, y, z])),
        (Some([_, _, _]), Some(_)) => {
            let problem = "`drop` sets the height; give `position` as [x, z], or remove `drop`";
            return Err(clash("position", problem));
        }
        _ => {
            let problem = "`position` must be [x, z] for a body on or above the floor, or [x, y, z] for its centre of mass, in m";
            return Err(clash("position", problem));
        }
    })
}

/// Turns one after the other, each about the world's axes.
fn rotation(turns: &[RotationTable]) -> Result<Quat, Fault> {
    let mut whole: Option<Quat> = None;
    for turn in turns {
        let next = match (&turn.axis, turn.degrees, turn.quaternion) {
            (Some(axis), Some(degrees), None) => {
                let axis = axis_vector(axis)?;
                Quat::from_axis_angle(axis, (degrees as f32).to_radians())
            }
            (None, None, Some(q)) => Quat::from_array(q.map(|x| x as f32)),
            _ => {
                let problem = "a rotation must be { axis = \"z\", degrees = 30 } or { quaternion = [x, y, z, w] }";
                return Err(clash("rotation", problem));
            }
        };
        whole = Some(whole.map_or(next, |before| next * before));
    }
    Ok(whole.unwrap_or(Quat::IDENTITY))
}

fn axis_vector(table: &AxisTable) -> Result<Vec3, Fault> {
    match table {
        AxisTable::Name(name) => Ok(match axis_of("rotation", name)? {
            Axis::X => Vec3::X,
            Axis::Y => Vec3::Y,
            Axis::Z => Vec3::Z,
        }),
        AxisTable::Vector(v) => vector(*v).try_normalize().ok_or_else(|| {
            let problem = "the axis of a rotation must be three finite numbers, not all zero";
            clash("rotation", problem)
        }),
    }
}

fn axis_up(table: &AxisTable) -> Result<Axis, Fault> {
    match table {
        AxisTable::Name(name) => axis_of("up", name),
        AxisTable::Vector(_) => Err(clash("up", "`up` must be \"x\", \"y\" or \"z\"")),
    }
}

fn axis_of(key: &'static str, name: &str) -> Result<Axis, Fault> {
    Axis::from_name(name).ok_or_else(|| {
        let hint = did_you_mean(name, ["x", "y", "z"]);
        let problem = format!("`{}` is not an axis{hint}; axes: x, y, z", short(name));
        Fault::new(key, SceneError::Clash(problem))
    })
}

pub(super) fn clash(key: &'static str, problem: &str) -> Fault {
    Fault::new(key, SceneError::Clash(problem.into()))
}
