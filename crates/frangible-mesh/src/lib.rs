//! Any surface or signed distance in, sound tetrahedra out.
//!
//! A mesh file becomes an [`InputMesh`] (what is drawn, kept as it is), is repaired to a [`Surface`] (what is
//! solid), becomes a [`Solid`] by its generalised winding number, and is filled with tetrahedra.

mod error;
mod input;
pub mod quality;
mod solid;
mod stuffing;
mod surface;
mod tetrahedralize;
mod tets;

pub use error::TetError;
pub use glam;
pub use input::{InputMaterial, InputMesh};
pub use solid::{Solid, SurfacePoint};
pub use surface::Surface;
pub use tetrahedralize::{
    CELLS_PER_WALL, Resolution, SMALLEST_ANGLE, TetOptions, TetReport, tetrahedralize,
};
pub use tets::TetBody;
pub use tets::features::Features;

#[cfg(test)]
mod probe {
    use super::*;
    use glam::DVec3;
    struct Ball(DVec3, f64, Option<f64>);
    impl Solid for Ball {
        fn bounds(&self) -> [DVec3; 2] {
            [self.0 - self.1, self.0 + self.1]
        }
        fn signed_distance(&self, p: DVec3) -> f64 {
            let d = p.distance(self.0) - self.1;
            match self.2 {
                None => d,
                Some(t) => d.max(-t - d),
            }
        }
    }
    struct Block(glam::DMat3);
    impl Solid for Block {
        fn bounds(&self) -> [DVec3; 2] {
            [DVec3::splat(-1.8), DVec3::splat(1.8)]
        }
        fn signed_distance(&self, p: DVec3) -> f64 {
            let q = (self.0.transpose() * p).abs() - DVec3::new(1.0, 0.8, 0.3);
            q.max(DVec3::ZERO).length() + q.max_element().min(0.0)
        }
    }
    fn euler(b: &TetBody) -> i64 {
        let f = b.boundary();
        let mut e: Vec<(u32, u32)> = f
            .iter()
            .flat_map(|f| {
                let f = f.0;
                [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])].map(|(a, b)| (a.min(b), a.max(b)))
            })
            .collect();
        e.sort_unstable();
        e.dedup();
        let mut v: Vec<u32> = f.iter().flat_map(|f| f.0).collect();
        v.sort_unstable();
        v.dedup();
        v.len() as i64 - e.len() as i64 + f.len() as i64
    }
    #[test]
    fn angles() {
        for seed in [None, Some(1)] {
            for (n, s) in [
                ("id", Block(glam::DMat3::IDENTITY)),
                (
                    "rot",
                    Block(glam::DMat3::from_euler(glam::EulerRot::XYZ, 0.3, 0.5, 0.7)),
                ),
            ] {
                for tets in [2000, 20000] {
                    let o = TetOptions {
                        irregular: seed,
                        resolution: Resolution::Tets(tets),
                        ..TetOptions::default()
                    };
                    let t = std::time::Instant::now();
                    match tetrahedralize(&s, &o) {
                        Ok((b, r)) => println!(
                            "block {n} {seed:?}: {r} chi {} exact {:.3} {:?}",
                            euler(&b),
                            r.volume / 1.92,
                            t.elapsed()
                        ),
                        Err(e) => println!("block {n}: {e}"),
                    }
                }
            }
        }
        for (cell, wall) in [
            (0.3_f64, None),
            (0.2, None),
            (0.1, None),
            (0.1, Some(0.25)),
            (0.1, Some(0.2)),
            (0.1, Some(0.18)),
            (0.1, Some(0.16)),
            (0.1, Some(0.15)),
            (0.1, Some(0.14)),
            (0.1, Some(0.13)),
            (0.1, Some(0.12)),
        ] {
            let s = Ball(DVec3::new(0.1, 0.2, 0.05), 1.0, wall);
            let o = TetOptions {
                irregular: Some(1),
                resolution: Resolution::Cell(cell),
                ..TetOptions::default()
            };
            let t = std::time::Instant::now();
            match tetrahedralize(&s, &o) {
                Ok((b, r)) => println!(
                    "ball {cell} {wall:?}: {r} chi {} pinch {} {:?}",
                    euler(&b),
                    r.pinches,
                    t.elapsed()
                ),
                Err(e) => println!("ball {cell} {wall:?}: {e}"),
            }
        }
    }
}
