//! Functions called by the script of the package. Numbers are passed as rows, see [`plain`](crate::plain); the script converts them to objects and
//! messages.

use frangible::{Asset, Body, Breakable, Fracture, FractureConfig, Material, Outcome, impact};
use js_sys::{Array, Float32Array, Float64Array, Object, Reflect, Uint32Array};
use wasm_bindgen::prelude::*;

use crate::drawn::{Drawn, Group, authored};
use crate::hulls::{hulls_of_body, hulls_of_fragment};
use crate::looks::looks;
use crate::plain;

/// Plane-strain modulus, Pa, crushing pressure, Pa, and coefficient of restitution of a named material.
///
/// # Errors
/// An unknown material.
#[wasm_bindgen]
pub fn material(name: &str) -> Result<Vec<f64>, JsError> {
    let material = Material::preset(name)?;
    Ok(vec![
        material.contact_modulus(),
        material.crushing_pressure,
        material.restitution,
    ])
}

/// Radius, m, of a ball of this mass, kg, and named material.
///
/// # Errors
/// An unknown material.
#[wasm_bindgen]
pub fn ball(name: &str, mass: f64) -> Result<f64, JsError> {
    let density = Material::preset(name)?.density;
    Ok((mass / density * 0.75 / std::f64::consts::PI).cbrt())
}

/// A kind of body.
#[wasm_bindgen]
pub struct Kind(Breakable);

#[wasm_bindgen]
impl Kind {
    /// Reads a baked body.
    ///
    /// # Errors
    /// A file that is not a baked body, is truncated or damaged, or has another version.
    #[wasm_bindgen(constructor)]
    pub fn new(bytes: &[u8]) -> Result<Kind, JsError> {
        Ok(Self(Breakable::new(Asset::from_bytes(bytes)?)?))
    }

    /// Name, material, mass, inertia, volume, strength, supports, mesh to draw and convex parts.
    pub fn about(&self) -> Object {
        let asset = self.0.asset();
        let object = Object::new();
        set(&object, "name", asset.name());
        set(&object, "material", asset.material().name.as_str());
        masses(&object, &asset.mass());
        set(&object, "strength", asset.material().strength);
        set(&object, "supported", asset.is_supported());
        set(&object, "geometry", drawn(&Drawn::whole(asset)));
        set(&object, "hulls", hulls(hulls_of_body(asset)));
        if let Some(surface) = authored(asset) {
            set(&object, "looks", looks(surface));
        }
        object
    }

    /// Makes one body of the kind.
    pub fn body(&self, seed: u32) -> WasmBody {
        WasmBody(self.0.body(seed.into()))
    }
}

/// One body, or a piece of one.
#[wasm_bindgen]
pub struct WasmBody(Body);

impl From<Body> for WasmBody {
    fn from(body: Body) -> Self {
        Self(body)
    }
}

#[wasm_bindgen]
impl WasmBody {
    /// Computes the outcome of contacts, given as rows of numbers. `pose` is the pose of the body if they are in world axes, otherwise empty.
    ///
    /// # Errors
    /// An invalid number.
    pub fn impact(&mut self, mut contacts: Vec<f64>, pose: &[f64]) -> Result<Break, JsError> {
        if !pose.is_empty() {
            plain::to_body_frame(&mut contacts, pose);
        }
        let outcome = impact(
            &self.0,
            &plain::contacts(&contacts),
            &FractureConfig::default(),
        )?;
        self.came(outcome)
    }

    fn came(&mut self, outcome: Outcome) -> Result<Break, JsError> {
        match outcome {
            Outcome::Held {
                margin,
                report,
                state,
            } => {
                if let Some(state) = state {
                    self.0.set_state(*state)?;
                }
                Ok(Break {
                    body: self.0.clone(),
                    margin,
                    fracture: Fracture::new(Vec::new(), report),
                })
            }
            Outcome::Broke(fracture) => Ok(Break {
                body: self.0.clone(),
                margin: 0.0,
                fracture: *fracture,
            }),
            _ => Err(JsError::new(
                "unknown kind of outcome; the npm package and the core crate do not match",
            )),
        }
    }
}

/// Outcome of an impact. Without fragments the body held.
#[wasm_bindgen]
pub struct Break {
    body: Body,
    margin: f64,
    fracture: Fracture,
}

#[wasm_bindgen]
impl Break {
    /// The report, the margin and the fragments.
    pub fn outcome(&self) -> Object {
        let (object, report) = (Object::new(), &self.fracture.report);
        set(&object, "broke", !self.fracture.fragments.is_empty());
        set(&object, "margin", self.margin);
        let numbers = Object::new();
        for (name, number) in [
            ("contactDuration", report.contact_duration),
            ("peakStress", report.peak_stress),
            ("stressBound", report.stress_bound),
            ("strength", report.strength),
            ("approachEnergy", report.approach_energy),
            ("fractureEnergy", report.fracture_energy),
            ("crackArea", report.crack_area),
            ("cracks", report.cracks as f64),
            ("seconds", report.timings.total()),
        ] {
            set(&numbers, name, number);
        }
        if let Some(time) = report.first_crack_time {
            set(&numbers, "firstCrackTime", time);
        }
        let contacts: Array = report.contacts.iter().map(contact).collect();
        set(&numbers, "contacts", contacts);
        set(&object, "report", numbers);
        let asset = self.body.asset();
        let fragments = self.fracture.fragments.iter();
        let fragments: Array = fragments.map(|f| fragment(asset, f)).collect();
        set(&object, "fragments", fragments);
        object
    }

    /// Velocity and angular velocity of each fragment after the break, and of the striker if there is one.
    pub fn motions(&self, pose: &[f64], motion: &[f64], striker: &[f64]) -> Vec<f64> {
        plain::motions(self.body.asset(), &self.fracture, pose, motion, striker)
    }
}

impl Break {
    /// The body that was hit.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Fracture of the body.
    pub fn fracture(&self) -> &Fracture {
        &self.fracture
    }
}

fn contact(report: &frangible::internals::outcome::ContactReport) -> JsValue {
    let object = Object::new();
    for (name, number) in [
        ("impulse", report.impulse),
        ("peakForce", report.peak_force),
        ("duration", report.duration),
        ("departureSpeed", report.departure_speed),
        ("crushingEnergy", report.crushing_energy),
        ("crushedVolume", report.crushed_volume),
    ] {
        set(&object, name, number);
    }
    object.into()
}

fn fragment(asset: &Asset, fragment: &frangible::Fragment) -> JsValue {
    let object = Object::new();
    masses(&object, &fragment.mass);
    set(&object, "supported", fragment.supported);
    set(
        &object,
        "geometry",
        drawn(&Drawn::fragment(asset, fragment)),
    );
    set(&object, "hulls", hulls(hulls_of_fragment(fragment)));
    let solid = Object::new();
    let positions: Vec<f32> = fragment
        .mesh
        .positions
        .iter()
        .flat_map(|p| p.to_array())
        .collect();
    set(&solid, "positions", Float32Array::from(&positions[..]));
    let triangles = fragment.mesh.triangles.as_flattened();
    set(&solid, "indices", Uint32Array::from(triangles));
    set(&object, "solid", solid);
    object.into()
}

fn masses(object: &Object, mass: &frangible::internals::MassProperties) {
    set(object, "mass", mass.mass);
    set(object, "volume", mass.volume);
    set(
        object,
        "centre",
        Float64Array::from(&mass.centre.to_array()[..]),
    );
    set(
        object,
        "inertia",
        Float64Array::from(&mass.inertia.to_cols_array()[..]),
    );
}

fn drawn(mesh: &Drawn) -> Object {
    let object = Object::new();
    set(
        &object,
        "positions",
        Float32Array::from(&mesh.positions[..]),
    );
    set(&object, "normals", Float32Array::from(&mesh.normals[..]));
    set(&object, "uvs", Float32Array::from(&mesh.uvs[..]));
    let more = mesh.more_uvs.iter().map(|uvs| Float32Array::from(&uvs[..]));
    set(&object, "moreUvs", more.collect::<Array>());
    if !mesh.colors.is_empty() {
        set(&object, "colors", Float32Array::from(&mesh.colors[..]));
    }
    let group = |group: &Group| {
        let object = Object::new();
        set(&object, "start", group.first as f64);
        set(&object, "count", group.count as f64);
        set(&object, "material", group.material);
        object
    };
    set(
        &object,
        "groups",
        mesh.groups.iter().map(group).collect::<Array>(),
    );
    set(&object, "indices", Uint32Array::from(&mesh.indices[..]));
    set(&object, "outerIndices", mesh.outer_indices as f64);
    object
}

fn hulls(hulls: Vec<Vec<f32>>) -> Array {
    hulls
        .iter()
        .map(|points| Float32Array::from(&points[..]))
        .collect()
}

pub(crate) fn set(object: &Object, name: &str, value: impl Into<JsValue>) {
    // It fails on frozen objects only, and this one is new.
    let _ = Reflect::set(object, &name.into(), &value.into());
}
