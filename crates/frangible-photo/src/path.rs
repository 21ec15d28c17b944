//! The way of light, followed back from the camera.

use frangible_recording::glam::Vec3A;

use crate::light::{backdrop, backdrop_seen};
use crate::optics::{at_crack, at_glass, bumpy, facing, mirror, outward};
use crate::random::Random;
use crate::set::{Met, Set};

/// Faces that a path may meet.
const LONGEST: u32 = 10;

/// Faces that a mirror image may meet.
const MIRRORED: u32 = 3;

/// Times that light may be scattered by matt faces; further light is taken from the room.
const SCATTERINGS: u32 = 1;

/// Share of the room's light that remains where a path ends among things.
const AMONG_THINGS: f32 = 0.45;

/// No path is brighter: one that finds a lamp by luck would leave a spark.
const BRIGHTEST: f32 = 2.5;

/// No face.
const NONE: u32 = u32::MAX;

/// Result of a path.
#[derive(Clone, Copy, Default)]
pub(crate) struct Seen {
    /// Light, without that of a matt face.
    pub(crate) light: Vec3A,
    /// Light on the matt face seen first, before its colour.
    pub(crate) diffuse: Vec3A,
    pub(crate) albedo: Vec3A,
    /// The product of the two.
    pub(crate) lit: Vec3A,
    pub(crate) normal: Vec3A,
    pub(crate) distance: f32,
    /// 1 where a matt face was seen first.
    pub(crate) matt: f32,
}

impl Seen {
    pub(crate) fn add(&mut self, other: &Self) {
        self.light += other.light;
        self.diffuse += other.diffuse;
        self.albedo += other.albedo;
        self.lit += other.lit;
        self.normal += other.normal;
        self.distance += other.distance;
        self.matt += other.matt;
    }

    pub(crate) fn scaled(&self, by: f32) -> Self {
        Self {
            light: self.light * by,
            diffuse: self.diffuse * by,
            albedo: self.albedo * by,
            lit: self.lit * by,
            normal: self.normal * by,
            distance: self.distance * by,
            matt: self.matt * by,
        }
    }
}

/// A path on its way.
#[derive(Clone, Copy)]
struct Ray {
    from: Vec3A,
    along: Vec3A,
    leaves: u32,
}

/// Follows paths through a set.
pub(crate) struct Traced<'a> {
    pub(crate) set: &'a Set,
}

impl Traced<'_> {
    /// Traces a ray from the camera.
    pub(crate) fn seen(&self, (from, along): (Vec3A, Vec3A), random: &mut Random) -> Seen {
        let ray = Ray {
            from,
            along,
            leaves: NONE,
        };
        let met = self.set.meet(from, along, NONE);
        if let Some((distance, ground)) = self.ground_before(&ray, met.as_ref()) {
            return Seen {
                light: ground.min(Vec3A::splat(BRIGHTEST))
                    + self.gloss_of_ground(&ray, distance, random),
                ..Seen::default()
            };
        }
        let Some(met) = met else {
            return Seen {
                light: backdrop_seen(along),
                ..Seen::default()
            };
        };
        if met.look.bends() || met.look.opacity < 1.0 {
            return Seen {
                light: self.glass_first(&ray, &met, random),
                ..Seen::default()
            };
        }
        self.matt_first(&ray, &met, random)
    }

    /// Distance and light of the floor, if it is nearer than the intersection.
    fn ground_before(&self, ray: &Ray, met: Option<&Met<'_>>) -> Option<(f32, Vec3A)> {
        let ground = self.set.ground.as_ref()?;
        let distance = ground.distance(ray.from, ray.along)?;
        if met.is_some_and(|met| met.distance < distance) {
            return None;
        }
        let at = ray.from + ray.along * distance;
        Some((distance, ground.light(at, ray.along)))
    }

    /// A faint mirror image of things on the floor.
    fn gloss_of_ground(&self, ray: &Ray, distance: f32, random: &mut Random) -> Vec3A {
        let at = ray.from + ray.along * distance;
        let Some(ground) = &self.set.ground else {
            return Vec3A::ZERO;
        };
        let share = ground.gloss(at, ray.along);
        if share <= 0.0 {
            return Vec3A::ZERO;
        }
        let [x, z] = random.disc();
        let normal = (Vec3A::Y + 0.05 * Vec3A::new(x, 0.0, z)).normalize();
        let along = mirror(ray.along, normal);
        let here = Ray {
            from: at,
            along,
            leaves: NONE,
        };
        match self.set.meet(at, along, NONE) {
            // Only things on the floor: the plain floor is as bright as it should be.
            Some(_) => share * (self.light(here, random, MIRRORED) - backdrop(along)),
            None => Vec3A::ZERO,
        }
    }

    /// Both ways of light at the first clear face: the fainter would be noise.
    fn glass_first(&self, ray: &Ray, met: &Met<'_>, random: &mut Random) -> Vec3A {
        if met.look.opacity < 1.0 || met.look.thin {
            return self.light(*ray, random, LONGEST);
        }
        let skin = met.skin();
        if skin.cloud > 0.0 {
            return self.light(*ray, random, LONGEST);
        }
        let normal = bumpy(met, skin.bump);
        let (reflected, bent) = at_glass(ray.along, normal, met.look.ior);
        let here = |along| Ray {
            from: met.at,
            along,
            leaves: met.face,
        };
        let mut light = Vec3A::ZERO;
        if reflected > 0.004 {
            let along = outward(mirror(ray.along, normal), met.flat, ray.along);
            light += reflected * self.light(here(along), random, MIRRORED);
        }
        if let Some(bent) = bent {
            light += (1.0 - reflected) * self.light(here(bent), random, LONGEST);
        }
        light
    }

    fn matt_first(&self, ray: &Ray, met: &Met<'_>, random: &mut Random) -> Seen {
        let skin = met.skin();
        let normal = facing(bumpy(met, skin.bump), ray.along);
        let (gloss, reflectance) = self.gloss(ray, met, normal, skin.roughness, random);
        let mut seen = Seen {
            light: gloss * specular_color(met, skin.color),
            albedo: skin.color * (1.0 - met.look.metallic) * (1.0 - reflectance),
            normal,
            distance: met.distance,
            matt: 1.0,
            ..Seen::default()
        };
        seen.diffuse = self.on_matt(met, normal, random, 0);
        seen.lit = seen.diffuse * seen.albedo;
        seen.light = seen.light.min(Vec3A::splat(BRIGHTEST));
        seen
    }

    /// Light on a matt face: from the key lamp, and from one other direction.
    fn on_matt(&self, met: &Met<'_>, normal: Vec3A, random: &mut Random, depth: u32) -> Vec3A {
        let toward = self.set.lights.toward_key(random);
        let cosine = normal.dot(toward);
        let mut light = Vec3A::ZERO;
        if cosine > 0.0 && met.flat.dot(toward) * met.flat.dot(normal) > 0.0 {
            let way = self.set.clear_way(met.at, toward, met.face);
            light += way * self.set.lights.key(cosine);
        }
        let along = random.matt(normal);
        let ray = Ray {
            from: met.at,
            along,
            leaves: met.face,
        };
        light + self.room(ray, random, depth + 1)
    }

    /// Light from the room along a ray, by way of things.
    fn room(&self, ray: Ray, random: &mut Random, depth: u32) -> Vec3A {
        let met = self.set.meet(ray.from, ray.along, ray.leaves);
        if let Some((_, ground)) = self.ground_before(&ray, met.as_ref()) {
            return ground;
        }
        let Some(met) = met else {
            return self.set.lights.room(ray.along);
        };
        if met.look.is_clear() {
            // Through clear things, straight: bent light makes no brighter shade.
            return 0.9 * self.set.lights.room(ray.along);
        }
        let skin = met.skin();
        let normal = facing(met.smooth, ray.along);
        if depth >= SCATTERINGS {
            return AMONG_THINGS * skin.color * backdrop(normal);
        }
        skin.color * self.on_matt(&met, normal, random, depth)
    }

    /// Light that a glossy face mirrors, and its share of the light.
    fn gloss(
        &self,
        ray: &Ray,
        met: &Met<'_>,
        normal: Vec3A,
        roughness: f32,
        random: &mut Random,
    ) -> (Vec3A, f32) {
        let cosine = -ray.along.dot(normal);
        let base = 0.04 + 0.96 * met.look.metallic;
        // A rough face mirrors less at a glance than Schlick's smooth one.
        let most = (1.0 - roughness).max(base);
        let share = base + (most - base) * (1.0 - cosine).clamp(0.0, 1.0).powi(5);
        if roughness > 0.7 && met.look.metallic < 0.5 {
            return (Vec3A::ZERO, 0.0);
        }
        let along = outward(mirror(ray.along, normal), met.flat, ray.along);
        let here = at(met, along);
        // Lamps are blurred as the roughness is; things are mirrored sharply, as only near ones are seen at all.
        let blur = roughness * roughness;
        let near = self.set.meet(here.from, along, here.leaves);
        let mirrored = match (self.ground_before(&here, near.as_ref()), near) {
            (Some((_, ground)), _) => ground,
            (None, None) => self.set.lights.mirrored(along, blur),
            (None, Some(_)) => self.light(here, random, MIRRORED),
        };
        (share * mirrored, share)
    }

    /// Light along a ray that was bent or mirrored, with at most so many more faces.
    fn light(&self, mut ray: Ray, random: &mut Random, longest: u32) -> Vec3A {
        let (mut left, mut gathered) = (Vec3A::ONE, Vec3A::ZERO);
        let cut = |light: Vec3A| light.min(Vec3A::splat(BRIGHTEST));
        let mut last_was_cloudy = false;
        for _ in 0..longest {
            let met = self.set.meet(ray.from, ray.along, ray.leaves);
            if let Some((_, ground)) = self.ground_before(&ray, met.as_ref()) {
                return cut(gathered + left * ground);
            }
            let Some(met) = met else {
                return cut(gathered + left * self.set.lights.mirrored(ray.along, 0.0));
            };
            let look = met.look;
            if !look.bends() && (look.opacity >= 1.0 || random.next() < look.opacity) {
                let skin = met.skin();
                let normal = facing(met.smooth, ray.along);
                if look.metallic > 0.5 {
                    left *= skin.color;
                    let along = outward(mirror(ray.along, normal), met.flat, ray.along);
                    ray = at(&met, along);
                    continue;
                }
                let lit = self.on_matt(&met, normal, random, 1);
                return cut(gathered + left * skin.color * lit);
            }
            if !look.bends() {
                ray = at(&met, ray.along);
                continue;
            }
            let inside = ray.along.dot(met.flat) > 0.0;
            if inside && !look.thin {
                left *= (-look.swallows * met.distance).exp();
            }
            let skin = met.skin();
            // Both the clouds and the things behind them are seen; after another cloudy face one of the two, by chance.
            let cloud = match std::mem::replace(&mut last_was_cloudy, skin.cloud > 0.0) {
                false => skin.cloud,
                true => f32::from(random.next() < skin.cloud),
            };
            if cloud > 0.0 {
                // Clouds inside are lit as a matt body is, and more evenly.
                let normal = facing(met.smooth, ray.along);
                let lit = self.on_matt(&met, normal, random, 1);
                let lit = 0.6 * lit + 0.4 * backdrop(Vec3A::Y);
                gathered += left * cloud * look.cloud_color() * lit;
                left *= 1.0 - cloud;
            }
            if left == Vec3A::ZERO {
                return cut(gathered);
            }
            let normal = bumpy(&met, skin.bump);
            let (reflected, bent) = if look.thin {
                at_crack(ray.along, normal, look.ior)
            } else {
                at_glass(ray.along, normal, look.ior)
            };
            let mirrored = outward(mirror(ray.along, normal), met.flat, ray.along);
            // One way is followed, that of most of the light: chance would be noise. The lamps in the mirror image on a face from
            // outside are taken as if nothing stood between.
            let along = match bent {
                Some(bent) => {
                    if !inside {
                        gathered += left * reflected * self.set.lights.mirrored(mirrored, 0.0);
                    }
                    left *= 1.0 - reflected;
                    bent
                }
                None => mirrored,
            };
            ray = at(&met, along);
        }
        cut(gathered + left * backdrop(ray.along))
    }
}

fn at(met: &Met<'_>, along: Vec3A) -> Ray {
    Ray {
        from: met.at,
        along,
        leaves: met.face,
    }
}

/// The colour of a mirror image: a metal's own.
fn specular_color(met: &Met<'_>, color: Vec3A) -> Vec3A {
    Vec3A::ONE.lerp(color, met.look.metallic)
}
