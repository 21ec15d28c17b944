//! Baked bodies that are held: their nodes, their pieces, and supports that are refused.

use frangible::glam::{DVec3, Vec3};
use frangible::{Asset, Breakable, Contact, FractureConfig, Outcome, Striker, impact};
use frangible_bake::{
    BakeError, BakeSpec, Baked, Group, MeshSize, Region, Support, bake, bake_with,
};

use super::small_plate;

#[test]
fn an_asset_knows_its_supported_nodes() {
    let ball = Region::Sphere {
        centre: DVec3::new(0.2, 0.2, 0.005),
        radius: 0.03,
    };
    let spec = small_plate(vec![
        Support::clamped(Region::below(0, 0.0)),
        Support::clamped(ball),
    ]);
    let Baked { asset, report } = bake_with(&spec, |_| {}).unwrap();
    assert!(asset.is_supported());
    assert!(report.unknowns < 3 * asset.analysis().nodes.len());
    let centre = DVec3::new(0.1, 0.1, 0.005);
    for (v, p) in asset.fracture().positions.iter().enumerate() {
        let p = p.as_dvec3() + centre;
        let inside = p.x < 1e-6 || p.distance(DVec3::new(0.2, 0.2, 0.005)) < 0.03;
        let supported = asset.supported().contains(&(v as u32));
        // The irregular mesh has its centre of mass within a fraction of a millimetre.
        let near = p.x < 1e-3 || (p.distance(DVec3::new(0.2, 0.2, 0.005)) - 0.03).abs() < 1e-3;
        assert!(supported == inside || near, "node {v} at {p}");
    }
    let free = bake(&small_plate(Vec::new())).unwrap();
    assert!(!free.is_supported());
}

#[test]
fn a_shelf_that_breaks_leaves_a_piece_in_the_wall() {
    let mut spec = small_plate(vec![Support::clamped(Region::below(0, 0.03))]);
    spec.modes = 30;
    spec.analysis = Some(MeshSize {
        edge: 0.02,
        layers: 1,
    });
    spec.fracture = Some(MeshSize {
        edge: 0.008,
        layers: 1,
    });
    let asset = bake(&spec).unwrap();
    let read = Asset::from_bytes(&asset.to_bytes()).unwrap();
    assert_eq!(read.supported(), asset.supported());
    let body = Breakable::uniform(read).unwrap().body(1);
    let striker = Striker::rigid()
        .with_contact_modulus(2.3e11)
        .with_effective_mass(2.0)
        .with_curvature_radius(0.02)
        .with_restitution(0.5);
    // Impulse of a ball of 2 kg against a body that does not give way.
    let impulse = |speed: f32| 1.5 * 2.0 * speed;
    let point = Vec3::new(0.09, 0.0, 0.005);
    let hit = |speed| Contact {
        impulse: impulse(speed),
        ..Contact::strike(point, Vec3::NEG_Z, speed, striker.clone())
    };
    let config = FractureConfig::default();
    let soft = impact(&body, &[hit(0.05)], &config).unwrap();
    assert!(matches!(soft, Outcome::Held { .. }));
    let Outcome::Broke(fracture) = impact(&body, &[hit(6.0)], &config).unwrap() else {
        panic!("it held");
    };
    let supported: Vec<bool> = fracture.fragments.iter().map(|f| f.supported).collect();
    assert!(
        supported.contains(&true) && supported.contains(&false),
        "{supported:?}"
    );
    // Every supported piece reaches into the wall.
    for fragment in fracture.fragments.iter().filter(|f| f.supported) {
        let centre = fragment.mass.centre.as_vec3();
        let lowest = fragment.mesh.positions.iter().map(|p| p.x + centre.x);
        assert!(lowest.fold(f32::INFINITY, f32::min) < 0.03 - 0.1 + 1e-3);
    }
}

#[test]
fn supports_that_cannot_be_meant_are_errors_that_name_them() {
    let good = Support::clamped(Region::below(0, 0.0));
    let sphere = |radius| Region::Sphere {
        centre: DVec3::ZERO,
        radius,
    };
    let cuboid = |low, high| Region::Box { low, high };
    let half = |point, normal| Region::HalfSpace { point, normal };
    let cases = [
        (Region::below(2, -0.1), "contains no part of the body"),
        (
            cuboid(DVec3::splat(5.0), DVec3::splat(6.0)),
            "contains no part of the body",
        ),
        (cuboid(DVec3::ONE, DVec3::ZERO), "low corner above"),
        (cuboid(DVec3::NAN, DVec3::ONE), "NaN"),
        (sphere(0.0), "radius"),
        (sphere(f64::INFINITY), "not finite"),
        (half(DVec3::NAN, DVec3::X), "not finite"),
        (half(DVec3::ZERO, DVec3::ZERO), "normal of length zero"),
    ];
    for (region, words) in cases {
        let spec = small_plate(vec![good.clone(), good.clone(), Support::clamped(region)]);
        let error = bake(&spec).unwrap_err();
        assert!(
            matches!(error, BakeError::Support { support: 2, .. }),
            "{error}"
        );
        let message = error.to_string();
        assert!(
            message.starts_with("support 2 ") && message.contains(words),
            "{message}"
        );
    }
    let idle = Support {
        axes: [false; 3],
        ..good
    };
    let error = bake(&small_plate(vec![idle])).unwrap_err().to_string();
    assert!(error.contains("fixes no axis"), "{error}");
    let all = Support::clamped(Region::below(2, 1.0));
    let error = bake(&small_plate(vec![all])).unwrap_err();
    assert_eq!(error, BakeError::AllHeld);
    // Between the nodes that carry the modes, 25 mm apart, but not between those of the cracks.
    let spot = cuboid(
        DVec3::new(0.053, 0.053, -1.0),
        DVec3::new(0.072, 0.072, 1.0),
    );
    let mut spec = small_plate(vec![Support::clamped(spot)]);
    spec.fracture = Some(MeshSize {
        edge: 0.006,
        layers: 1,
    });
    let error = bake(&spec).unwrap_err();
    assert!(error.to_string().contains("refine the"), "{error}");
}

/// The face x = 0 of the small plate, as two triangles.
fn end_face() -> Group {
    let corner = |y: f64, z: f64| DVec3::new(0.0, y, z);
    let [a, b, c, d] = [
        corner(0.0, 0.0),
        corner(0.2, 0.0),
        corner(0.2, 0.01),
        corner(0.0, 0.01),
    ];
    Group {
        name: "wall".into(),
        triangles: vec![[a, b, c], [a, c, d]],
        points: Vec::new(),
    }
}

#[test]
fn a_group_holds_what_the_same_region_holds() {
    let by_region = small_plate(vec![Support::clamped(Region::below(0, 0.0))]);
    let Baked {
        asset: region,
        report: at_region,
    } = bake_with(&by_region, |_| {}).unwrap();
    let mut by_group = small_plate(vec![Support::clamped(Region::Group("wall".into()))]);
    by_group.groups.push(end_face());
    let Baked {
        asset: group,
        report: at_group,
    } = bake_with(&by_group, |_| {}).unwrap();
    assert_eq!(region.supported(), group.supported());
    assert_eq!(at_region.frequencies, at_group.frequencies);
    // Its nodes one by one are the same part.
    let origin = region
        .fracture()
        .positions
        .iter()
        .fold(DVec3::INFINITY, |low, p| low.min(p.as_dvec3()));
    by_group.groups = vec![Group {
        name: "wall".into(),
        triangles: end_face().triangles.into_iter().take(2).collect(),
        points: region
            .supported()
            .iter()
            .map(|&v| region.fracture().positions[v as usize].as_dvec3() - origin)
            .collect(),
    }];
    let points = bake(&by_group).unwrap();
    assert_eq!(region.supported(), points.supported());
}

#[test]
fn an_unknown_group_is_refused_with_the_names_there_are() {
    let mut spec = small_plate(vec![Support::clamped(Region::Group("wal".into()))]);
    let message = |spec: &BakeSpec| bake(spec).unwrap_err().to_string();
    assert!(
        message(&spec).contains("this body has no groups"),
        "{}",
        message(&spec)
    );
    spec.groups = vec![end_face()];
    let text = message(&spec);
    assert!(
        text.contains("`wal`, did you mean `wall`?; groups: `wall`"),
        "{text}"
    );
    spec.supports[0].region = Region::Group("wall".into());
    spec.groups[0].triangles.clear();
    assert!(
        message(&spec).contains("contains no part of the body"),
        "{}",
        message(&spec)
    );
}
