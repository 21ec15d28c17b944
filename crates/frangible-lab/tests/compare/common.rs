//! Bodies and blows for the tests.

use std::sync::Arc;

use frangible::glam::Vec3;
use frangible::{Asset, Body, Breakable, Contact, FractureConfig, Material, Striker};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_lab::compare::{Broken, Hit, Method, Options, compare};

/// A baked shape of about so many fracture tetrahedra.
pub(crate) fn baked(shape: Shape, material: Material, tets: f64) -> Arc<Asset> {
    let spec = BakeSpec {
        modes: 30,
        fracture: Some(shape.size_for(tets).expect("a size")),
        ..BakeSpec::new("body", shape, material)
    };
    Arc::new(bake(&spec).expect("a baked body"))
}

pub(crate) fn preset(name: &str) -> Material {
    Material::preset(name).expect("a preset")
}

/// A square plate of glass.
pub(crate) fn plate() -> Arc<Asset> {
    plate_of(preset("glass"))
}

pub(crate) fn plate_of(material: Material) -> Arc<Asset> {
    let size = [0.2, 0.2, 0.006];
    baked(Shape::Box { size }, material, 4000.0)
}

/// A steel ball of 100 g in the middle of the plate's upper face.
pub(crate) fn in_the_middle(asset: &Asset, speed: f64) -> Contact {
    let ball = Striker::ball(&preset("steel"), 0.1, 0.015);
    Contact::collision(asset, Vec3::new(0.0, 0.0, 0.003), Vec3::NEG_Z, speed, ball)
}

/// A body and its contacts.
pub(crate) struct Case {
    pub(crate) body: Body,
    pub(crate) contacts: Vec<Contact>,
    pub(crate) config: FractureConfig,
}

impl Case {
    pub(crate) fn new(asset: &Arc<Asset>, contact: Contact) -> Self {
        Self {
            body: Breakable::uniform(Arc::clone(asset))
                .expect("a sound asset")
                .body(1),
            contacts: vec![contact],
            config: FractureConfig::default(),
        }
    }

    /// The plate hit in its middle.
    pub(crate) fn of_plate() -> Self {
        let asset = plate();
        Self::new(&asset, in_the_middle(&asset, 20.0))
    }

    pub(crate) fn hit(&self) -> Hit<'_> {
        Hit {
            body: &self.body,
            contacts: &self.contacts,
            config: &self.config,
        }
    }

    pub(crate) fn by(&self, method: Method, options: &Options) -> Broken {
        let all = compare(self.hit(), &[method], options, &mut |_| {}).expect("a comparison");
        all.into_iter().next().expect("one method")
    }

    pub(crate) fn by_all(&self) -> Vec<Broken> {
        let options = Options::default();
        compare(self.hit(), &Method::ALL, &options, &mut |_| {}).expect("a comparison")
    }
}
