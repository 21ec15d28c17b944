//! The render surface divided among the fragments of arbitrary labels.

use std::collections::BTreeMap;

use glam::Vec3;
use rand_chacha::rand_core::Rng;

use crate::asset::{RenderMaterial, RenderSurface};
use crate::crack::{CrackSystem, Known};
use crate::fragment::label::Labels;
use crate::fragment::tests::block;
use crate::fragment::{Built, build, draw};
use crate::mesh::{EDGES, RenderMesh, Threads};
use crate::outcome::Fragment;
use crate::rng::{Purpose, stream, uniform};
use crate::state::Cuts;
use crate::{Breakable, FractureConfig};

/// Cubes along an edge of the block, and its edge, m.
const CUBES: usize = 6;
const EDGE: f32 = 0.06;

/// Texture coordinates as a linear function of the place, so that interpolation has a closed form.
fn uv_at(p: Vec3) -> [f32; 2] {
    [10.0 * p.x + 20.0 * p.y - 5.0 * p.z, 7.0 * p.z - 3.0 * p.x]
}

/// The block's surface as `n` × `n` squares a side, a material per side, grown about its middle.
fn cube(n: u32, grown: f32) -> RenderSurface {
    let mut surface = RenderSurface::default();
    for side in 0..6_usize {
        let (axis, high) = (side / 2, side % 2 == 1);
        let first = surface.positions.len() as u32;
        for i in 0..=n {
            for j in 0..=n {
                let mut p = Vec3::ZERO;
                p[axis] = f32::from(u8::from(high));
                p[(axis + 1) % 3] = i as f32 / n as f32;
                p[(axis + 2) % 3] = j as f32 / n as f32;
                let p = EDGE * (0.5 + (p - 0.5) * (1.0 + grown));
                let mut normal = Vec3::ZERO;
                normal[axis] = if high { 1.0 } else { -1.0 };
                surface.positions.push(p);
                surface.normals.push(normal);
                surface.uvs.push(uv_at(p));
            }
        }
        let at = |i: u32, j: u32| first + i * (n + 1) + j;
        for i in 0..n {
            for j in 0..n {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                for [a, b, c] in [[a, b, c], [a, c, d]] {
                    surface
                        .triangles
                        .push(if high { [a, b, c] } else { [a, c, b] });
                    surface.material_of_triangle.push(side as u32);
                }
            }
        }
        surface.materials.push(RenderMaterial {
            name: format!("side {side}"),
            base_color: [1.0; 4],
            metallic: 0.0,
            roughness: 0.5,
            ..RenderMaterial::default()
        });
    }
    surface
}

/// Fragments of labels: random ones, or the nearest of `count` random places.
fn broken(surface: &RenderSurface, count: u32, random: bool, seed: u64) -> Vec<Fragment> {
    let mut asset = block(CUBES);
    asset.render = Some(surface.clone());
    let mut rng = stream(seed, Purpose::CrackDirection, count);
    let positions = &asset.fracture.positions;
    let place = |rng: &mut _| Vec3::from_array(std::array::from_fn(|_| uniform(rng) as f32)) * EDGE;
    let places: Vec<Vec3> = (0..count).map(|_| place(&mut rng)).collect();
    let nearest = |p: Vec3| {
        let gap = |k: &u32| places[*k as usize].distance(p);
        (0..count).min_by(|a, b| gap(a).total_cmp(&gap(b))).unwrap()
    };
    let of_node: Vec<u32> = positions
        .iter()
        .map(|&p| {
            if random {
                rng.next_u32() % count
            } else {
                nearest(p)
            }
        })
        .collect();
    let mut cuts = Cuts::none(positions.len());
    for tet in &asset.fracture.tets {
        for [i, j] in EDGES {
            if of_node[tet[i] as usize] != of_node[tet[j] as usize] {
                let at = 0.1 + 0.8 * uniform(&mut rng) as f32;
                cuts.cut(tet[i], tet[j], -at, 1.0 - at, 0);
            }
        }
    }
    let labels = Labels {
        of_node,
        count: count as usize,
        ..Labels::new(cuts, Known::default())
    };
    let config = FractureConfig::default();
    let body = Breakable::of_sound(asset.into()).body(1);
    let system = CrackSystem::new(&body, &config, 0.0);
    let Built {
        mut fragments,
        undrawn,
        ..
    } = build(&system, &labels, &body.prepared);
    draw(
        surface,
        &body.prepared,
        &mut fragments,
        undrawn.unwrap(),
        &Threads::default(),
    );
    fragments
}

fn area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    let double = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize].as_dvec3());
        (b - a).cross(c - a).length()
    };
    0.5 * triangles.iter().map(double).sum::<f64>()
}

fn volume(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    let six = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize].as_dvec3());
        a.dot(b.cross(c))
    };
    triangles.iter().map(six).sum::<f64>() / 6.0
}

fn check(surface: &RenderSurface, fragments: &[Fragment]) {
    let whole = area(&surface.positions, &surface.triangles);
    let mut sum = 0.0;
    for fragment in fragments {
        let mesh = fragment.render.as_ref().unwrap();
        sum += area(&mesh.positions, &mesh.triangles[..mesh.outer_triangles]);
        assert_eq!(mesh.material_of_triangle.len(), mesh.outer_triangles);
        assert_eq!(mesh.positions.len(), mesh.normals.len());
        assert_eq!(mesh.positions.len(), mesh.uvs.len());
        assert!(mesh.positions.iter().all(|p| p.is_finite()));
        assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-4));
        assert!(mesh.uvs.iter().flatten().all(|x| x.is_finite()));
        let outer = &mesh.triangles[..mesh.outer_triangles];
        for (triangle, &material) in outer.iter().zip(&mesh.material_of_triangle) {
            for v in triangle.map(|v| v as usize) {
                let p = mesh.positions[v] + fragment.mass.centre.as_vec3();
                let (expected, uv) = (uv_at(p), mesh.uvs[v]);
                // Coordinates of some units, rounded to f32 a few times.
                let close = (0..2).all(|k| (expected[k] - uv[k]).abs() < 3e-6);
                assert!(close, "{uv:?} instead of {expected:?}");
                // The author's normal points along the side's axis.
                let axis = material as usize / 2;
                assert!(mesh.normals[v].abs()[axis] > 0.999);
            }
        }
    }
    assert!(
        (sum / whole - 1.0).abs() < 1e-5,
        "area {sum} of {whole} for {} triangles",
        surface.triangles.len()
    );
}

/// Sides that have no other one between the same places, by the places of their ends.
fn open_sides(mesh: &RenderMesh) -> Vec<[Vec3; 2]> {
    let place = |v: u32| mesh.positions[v as usize] + 0.0;
    let bits = |p: Vec3| p.to_array().map(f32::to_bits);
    let mut sides = BTreeMap::new();
    for t in &mesh.triangles {
        let corners = t.map(place);
        for k in 0..3 {
            let ends = [corners[k], corners[(k + 1) % 3]];
            let [from, to] = ends.map(bits);
            let side = sides.entry((from.min(to), from.max(to)));
            side.or_insert((0, ends)).0 += from.cmp(&to) as i32;
        }
    }
    let open = sides.into_values().filter(|side| side.0 != 0);
    open.map(|side| side.1).collect()
}

/// Sides that more than two triangles have, those that are nothing but a line left out.
fn crowded_sides(mesh: &RenderMesh) -> usize {
    let place = |v: u32| {
        (mesh.positions[v as usize] + 0.0)
            .to_array()
            .map(f32::to_bits)
    };
    let mut sides = BTreeMap::new();
    for t in &mesh.triangles {
        let [a, b, c] = t.map(place);
        if a != b && b != c && c != a {
            for [from, to] in [[a, b], [b, c], [c, a]] {
                *sides.entry((from.min(to), from.max(to))).or_insert(0) += 1;
            }
        }
    }
    sides
        .into_values()
        .filter(|&triangles| triangles > 2)
        .count()
}

#[test]
fn fragments_of_a_closed_surface_are_closed() {
    let (mut crowded, mut triangles) = (0, 0);
    for grown in [0.0, -0.05, 0.05] {
        for n in [1, 2, 7, 30] {
            for (count, random) in [(2, false), (7, false), (4, true)] {
                let surface = cube(n, grown);
                let fragments = broken(&surface, count, random, u64::from(n));
                check(&surface, &fragments);
                let mut enclosed = 0.0;
                for fragment in &fragments {
                    let mesh = fragment.render.as_ref().unwrap();
                    let open = open_sides(mesh).len();
                    assert_eq!(open, 0, "{n}, {grown}, {count} labels");
                    crowded += crowded_sides(mesh);
                    triangles += mesh.triangles.len();
                    enclosed += volume(&mesh.positions, &mesh.triangles);
                }
                let whole = volume(&surface.positions, &surface.triangles);
                let off = enclosed / whole - 1.0;
                assert!(off.abs() < 2e-3, "{n}, {grown}, {count} labels: {off}");
            }
        }
    }
    // A crack face may have a side between two places of the border, where the surface has one too.
    assert!(
        100_000 * crowded < triangles,
        "{crowded} sides of {triangles} triangles"
    );
}

#[test]
fn holes_stay_holes_unless_a_crack_runs_through_them_and_nothing_else_is_open() {
    const CELLS: u32 = 8;
    for grown in [0.0, 0.05] {
        let mut surface = cube(CELLS, grown);
        // Four squares in the middle of the last side, which is the upper one along z.
        let middle = EDGE * 0.5;
        let is_hole = |p: Vec3| (p - middle).abs().truncate().max_element() < 0.14 * EDGE;
        let kept: Vec<usize> = (0..surface.triangles.len())
            .filter(|&t| {
                let corners = surface.triangles[t].map(|v| surface.positions[v as usize]);
                corners[0].z < middle || !corners.into_iter().all(is_hole)
            })
            .collect();
        assert_eq!(surface.triangles.len() - kept.len(), 8);
        surface.triangles = kept.iter().map(|&t| surface.triangles[t]).collect();
        surface.material_of_triangle = kept
            .iter()
            .map(|&t| surface.material_of_triangle[t])
            .collect();
        for count in [2, 5, 9] {
            let fragments = broken(&surface, count, false, 4);
            let mut open = 0;
            for fragment in &fragments {
                for ends in open_sides(fragment.render.as_ref().unwrap()) {
                    open += 1;
                    for p in ends {
                        let p = p + fragment.mass.centre.as_vec3();
                        assert!(is_hole(p) && p.z > middle, "{p} is open, {count} labels");
                    }
                }
            }
            // Two labels leave the hole to one of them; of more, cracks run through it.
            assert_eq!(
                open,
                if count == 2 { 8 } else { 0 },
                "{grown}, {count} labels"
            );
        }
    }
}

#[test]
fn fragments_share_out_a_surface_finer_and_coarser_than_the_tetrahedra() {
    for n in [1, 2, 5, 40] {
        for (count, random) in [(2, false), (7, false), (3, true), (9, true)] {
            // Where the surfaces are the same, the shares are those of the exact partition, and the mesh encloses
            // the same volume: it has neither gaps nor overlaps.
            let surface = cube(n, 0.0);
            let fragments = broken(&surface, count, random, u64::from(n));
            check(&surface, &fragments);
            for fragment in &fragments {
                let (mesh, render) = (&fragment.mesh, fragment.render.as_ref().unwrap());
                let exact = area(&mesh.positions, &mesh.triangles[..mesh.outer_triangles]);
                let drawn = area(
                    &render.positions,
                    &render.triangles[..render.outer_triangles],
                );
                let scale = f64::from(EDGE * EDGE);
                assert!(
                    (exact - drawn).abs() < 1e-5 * scale,
                    "{n}, {count} labels: {drawn} of {exact}"
                );
                let enclosed = volume(&render.positions, &render.triangles);
                let difference = (enclosed - fragment.mass.volume).abs();
                assert!(
                    difference < 1e-6 * f64::from(EDGE).powi(3),
                    "{n}, {count} labels: volume off by {difference}"
                );
            }
        }
    }
}

#[test]
fn a_surface_off_the_tetrahedra_is_shared_out_whole() {
    for grown in [-0.05, 0.05] {
        for n in [1, 7, 30] {
            for (count, random) in [(5, false), (4, true)] {
                let surface = cube(n, grown);
                let fragments = broken(&surface, count, random, 3);
                check(&surface, &fragments);
            }
        }
    }
}

#[test]
fn rims_of_crack_faces_are_drawn_to_the_surface() {
    // 1.5 mm off the tetrahedra, whose mean edge is some 13 mm.
    let surface = cube(30, 0.05);
    let fragments = broken(&surface, 5, false, 3);
    let off = |p: Vec3| {
        let p = ((p / EDGE) - 0.5).abs().max_element();
        (p - 0.525).abs() * EDGE
    };
    let (mut on_tets, mut on_surface) = (0, 0);
    for fragment in &fragments {
        let mesh = fragment.render.as_ref().unwrap();
        for v in mesh.triangles[mesh.outer_triangles..].iter().flatten() {
            let p = mesh.positions[*v as usize] + fragment.mass.centre.as_vec3();
            let depth = ((p / EDGE) - 0.5).abs().max_element();
            on_surface += usize::from(off(p) < 1e-6);
            on_tets += usize::from((depth - 0.5).abs() < 1e-5);
        }
    }
    assert!(on_surface > 100, "{on_surface}");
    assert_eq!(on_tets, 0);
}

#[test]
fn a_surface_wound_the_wrong_way_has_the_same_shares() {
    let mut surface = cube(4, 0.0);
    let right = broken(&surface, 6, false, 5);
    for t in &mut surface.triangles {
        t.swap(1, 2);
    }
    let wrong = broken(&surface, 6, false, 5);
    for (a, b) in right.iter().zip(&wrong) {
        let shares = [a, b].map(|f| {
            let mesh = f.render.as_ref().unwrap();
            area(&mesh.positions, &mesh.triangles[..mesh.outer_triangles])
        });
        assert!((shares[0] - shares[1]).abs() < 1e-5 * f64::from(EDGE * EDGE));
    }
}

#[test]
fn degenerate_triangles_and_a_surface_far_away_do_no_harm() {
    let mut surface = cube(3, 0.0);
    let first = surface.triangles[0];
    surface.triangles.push([first[0]; 3]);
    surface.triangles.push([first[0], first[1], first[1]]);
    surface.triangles.push(first);
    surface.material_of_triangle.extend([0; 3]);
    let fragments = broken(&surface, 4, true, 9);
    check(&surface, &fragments);
    for p in &mut surface.positions {
        *p += 3.0;
    }
    surface.uvs.clear();
    surface.normals.clear();
    let fragments = broken(&surface, 4, true, 9);
    let drawn: f64 = fragments
        .iter()
        .map(|f| {
            let mesh = f.render.as_ref().unwrap();
            assert!(mesh.normals.iter().all(|n| n.is_normalized()));
            area(&mesh.positions, &mesh.triangles[..mesh.outer_triangles])
        })
        .sum();
    let whole = area(&surface.positions, &surface.triangles);
    assert!((drawn / whole - 1.0).abs() < 1e-4);
}

#[test]
fn the_same_break_is_drawn_the_same_bit_for_bit() {
    let surface = cube(6, 0.03);
    let meshes = |_| {
        let fragments = broken(&surface, 6, true, 2);
        fragments.into_iter().map(|f| f.render).collect::<Vec<_>>()
    };
    assert_eq!(meshes(1), meshes(2));
}
