//! A break sent to another machine as bytes, and made again there bit for bit: `cargo run --release -p frangible-rapier --example replay`.

use frangible_rapier::rapier3d::dynamics::RigidBodyBuilder;
use std::error::Error;
use std::sync::Arc;

use frangible::{Asset, Breakable, Contact, FractureConfig, Material, Outcome, impact};
use frangible_bake::{BakeSpec, Shape, bake};
use frangible_rapier::rapier3d::math::{Pose, Vector};
use frangible_rapier::{BreakableWorld, SurfaceProperties, WorldConfig};

fn main() -> Result<(), Box<dyn Error>> {
    let spec = BakeSpec::for_games("bowl", Shape::bowl(), Material::preset("porcelain")?)?;
    let file = bake(&spec)?.to_bytes();

    // The server: the bowl falls, and of its break the seed and the contacts are kept.
    let kind = Breakable::new(Arc::new(Asset::from_bytes(&file)?))?;
    let mut world = BreakableWorld::new(WorldConfig::default())?;
    world.insert_fixed_half_space(Vector::ZERO, Vector::Y, SurfaceProperties::STONE)?;
    let pose = Pose::translation(0.0, 1.5, 0.0);
    world.insert(kind.body(77), RigidBodyBuilder::dynamic().pose(pose))?;
    let event = loop {
        if let Some(event) = world.step()?.first() {
            break event.clone();
        }
    };
    let mut message = 77_u64.to_le_bytes().to_vec();
    message.extend(event.contacts.iter().flat_map(Contact::to_bytes));
    println!(
        "{} pieces, {} bytes on the wire",
        event.fragments.len(),
        message.len()
    );

    // The client has the same file, and breaks the same body by itself.
    let kind = Breakable::new(Arc::new(Asset::from_bytes(&file)?))?;
    let (seed, contacts) = message.split_at(8);
    let body = kind.body(u64::from_le_bytes(seed.try_into()?));
    let (mut contacts, mut left) = (Vec::new(), contacts);
    while !left.is_empty() {
        let (contact, behind) = Contact::read(left)?;
        contacts.push(contact);
        left = behind;
    }
    let Outcome::Broke(again) = impact(&body, &contacts, &FractureConfig::default())? else {
        return Err("the client's bowl held".into());
    };
    for (ours, theirs) in again.fragments.iter().zip(&event.fracture.fragments) {
        assert_eq!(ours.mesh.positions, theirs.mesh.positions);
        assert_eq!(ours.mesh.triangles, theirs.mesh.triangles);
    }
    assert_eq!(again.fragments.len(), event.fragments.len());
    println!("the client's pieces are the same, bit for bit");
    Ok(())
}
