//! Finds the sections in which large cracks lie.

use glam::{Mat3, Vec2, Vec3};

use super::field::StressField;
use super::section::{ALONG, Column, Plane, Section};
use super::single::Front;
use super::system::{CrackSystem, ELSEWHERE, UNCUT};
use crate::asset::Asset;
use crate::mesh::{FACES, NO_NEIGHBOUR};
use crate::state::{crossing, nominal_crossing};
use crate::tips::LARGE;

/// A section is looked for again when its cracks have grown by this factor.
const GREW: f64 = 1.3;

/// Distance from a section, in mean edges, up to which a crack runs along it.
const NEAR: f32 = 2.0;

/// Distance from a section, in its heights, up to which a crack runs along it, if that is more than [`NEAR`].
const NEAR_HEIGHT: f32 = 0.25;

/// A section is compact if its second moments of area differ by less than this factor.
const COMPACT: f32 = 2.25;

impl CrackSystem<'_> {
    /// Energy per area that the section of a front's crack gives it where it cuts its tetrahedron at the present step, J/m²; zero where the crack
    /// has none.
    pub(super) fn section_feed(
        &mut self,
        front: &Front,
        at: Vec3,
        normal: Vec3,
        field: &StressField,
    ) -> f64 {
        let Some(k) = self.cracks[front.crack as usize].section else {
            return 0.0;
        };
        let section = &mut self.sections[k as usize];
        let Some(column) = section.feeding(at, normal) else {
            return 0.0;
        };
        section.set_step(self.asset, field.motion, field.step);
        section.release_rate(column, self.asset.material.contact_modulus())
    }

    /// Finds the section of a crack that has grown.
    pub(super) fn keep_section(&mut self, crack: u32, field: &StressField) {
        if self.config.is_paper() {
            return;
        }
        let id = crack as usize;
        match self.cracks[id].section {
            Some(k) => self.find_anew(k, field),
            None => self.find_first(id, field),
        }
    }

    /// Finds a section again, if its cracks have grown.
    fn find_anew(&mut self, k: u32, field: &StressField) {
        let section = &self.sections[k as usize];
        let (cracked, plane) = (section.cracked(), section.plane);
        if cracked <= GREW * section.found {
            return;
        }
        let members: Vec<usize> = (0..self.cracks.len())
            .filter(|&id| self.cracks[id].section == Some(k))
            .collect();
        members.iter().for_each(|&id| self.measure(id));
        let moved = self.mean_plane(&members, Some(plane));
        if moved.is_some_and(|(origin, normal)| plane.is_like(origin, normal, self.edge)) {
            self.sections[k as usize].found = cracked;
            return;
        }
        match self.section(&members, Some(plane), field) {
            Some(new) => self.sections[k as usize] = new,
            None => self.sections[k as usize].found = cracked,
        }
        self.share_sections();
    }

    /// Gives a crack that has become large its section: one that there is already, or its own.
    fn find_first(&mut self, id: usize, field: &StressField) {
        let own = &self.cracks[id];
        let area = own.whole_area();
        let room = f64::from(self.thickness[own.start as usize]);
        if area <= own.unsought.max(LARGE * room * room) {
            return;
        }
        self.cracks[id].unsought = GREW * area;
        let start = self.cracks[id].start;
        if !self.is_own(start) || field.wall(start as usize).is_some() {
            return;
        }
        self.measure(id);
        let Some((origin, normal)) = self.mean_plane(&[id], None) else {
            return;
        };
        let known = self.sections.iter().position(|section| {
            section.plane.has(origin, normal)
                && section.column(section.plane.place(origin)).is_some()
        });
        let k = match known {
            Some(k) => {
                let cuts: Vec<_> = self.cuts_along(&[id], None).collect();
                for (middle, direction, area) in cuts {
                    self.sections[k].cut(middle, direction, area);
                }
                k
            }
            None => {
                let Some(section) = self.section(&[id], None, field) else {
                    return;
                };
                self.sections.push(section);
                self.sections.len() - 1
            }
        };
        self.cracks[id].section = Some(k as u32);
        self.share_sections();
    }

    /// Feeds only the most cracked one of sections that lie side by side: its cracks release the others.
    fn share_sections(&mut self) {
        let all: Vec<(Plane, f32, f64)> = self
            .sections
            .iter()
            .map(|s| {
                let height = s.columns().iter().map(|c| c.height()).fold(0.0, f64::max);
                (s.plane, height as f32, s.cracked())
            })
            .collect();
        for (k, section) in self.sections.iter_mut().enumerate() {
            let (plane, height, cracked) = all[k];
            let released = all
                .iter()
                .enumerate()
                .any(|(j, &(other, its_height, its))| {
                    let off = plane.origin - other.origin;
                    let reach = 0.5 * height.max(its_height);
                    j != k
                        && off.dot(other.normal).abs() < reach
                        && off.length() < 2.0 * reach
                        && plane.normal.dot(other.normal).abs() > ALONG
                        && (its, j) > (cracked, k)
                });
            section.is_fed = !released;
        }
    }

    /// Finds the middle and the area of the cuts that a crack has gained.
    fn measure(&mut self, id: usize) {
        let crack = &mut self.cracks[id];
        for cut in &crack.elements[crack.polygons.len()..] {
            let x = self.asset.fracture.corners(cut.tet as usize);
            let polygon = nominal_crossing(&x, &cut.values, cut.direction);
            crack.polygons.push(polygon);
        }
    }

    /// Cuts of cracks that are [measured](Self::measure), those along a plane if one is given: middles, m, normals and areas, m².
    fn cuts_along(
        &self,
        cracks: &[usize],
        along: Option<Plane>,
    ) -> impl Iterator<Item = (Vec3, Vec3, f32)> {
        let cuts = cracks.iter().flat_map(|&id| {
            let crack = &self.cracks[id];
            let polygons = crack.polygons.iter().skip(crack.settled);
            polygons.zip(crack.unsettled())
        });
        cuts.filter_map(move |(&(middle, area), cut)| {
            let runs = along.is_none_or(|plane| plane.has(middle, cut.direction));
            runs.then_some((middle, cut.direction, area))
        })
    }

    /// Mean plane of cracks, or of what of them runs along a plane: a point and the normal.
    fn mean_plane(&self, cracks: &[usize], along: Option<Plane>) -> Option<(Vec3, Vec3)> {
        let (mut normal, mut origin, mut area) = (Vec3::ZERO, Vec3::ZERO, 0.0);
        let mut first = along.map(|plane| plane.normal);
        for (middle, direction, own) in self.cuts_along(cracks, along) {
            let first = *first.get_or_insert(direction);
            normal += direction * own * direction.dot(first).signum();
            origin += middle * own;
            area += own;
        }
        Some((origin / area, normal.try_normalize()?))
    }

    /// Finds the section of cracks, near the plane of the one that they had.
    fn section(
        &self,
        cracks: &[usize],
        before: Option<Plane>,
        field: &StressField,
    ) -> Option<Section> {
        let (origin, normal) = self.mean_plane(cracks, before)?;
        let polygons = self.passed(cracks, origin, normal);
        let axis = normal.any_orthonormal_vector();
        let rough = Plane {
            origin,
            normal,
            axes: [axis, normal.cross(axis)],
            near: NEAR * self.edge,
        };
        let plane = self.turned(rough, cracks, &polygons);
        let flat: Vec<(Vec2, f32)> = (polygons.iter())
            .map(|&(_, at, area)| (plane.place(at), area))
            .collect();
        let mut section = Section::new(plane, &flat, self.edge)?;
        for (middle, direction, area) in self.cuts_along(cracks, None) {
            section.cut(middle, direction, area);
        }
        section.found = section.cracked();
        let mut columns = section.columns().iter();
        if columns.any(|c| c.area <= 0.0 || c.height() <= 0.0) {
            return None;
        }
        self.set_factors(&mut section, &polygons);
        self.set_stiffness(&mut section, field.motion.modes);
        Some(section)
    }

    /// The plane with its axes along the greatest and the least extent of the section. The height runs away from the cracks, so that the axes turn with
    /// the body; in a section that is about as wide as it is high, straight from the cracks to the ligament.
    fn turned(&self, plane: Plane, cracks: &[usize], polygons: &[(u32, Vec3, f32)]) -> Plane {
        let (mut area, mut mean, mut square) = (0.0_f32, Vec2::ZERO, [0.0_f32; 3]);
        for &(_, at, own) in polygons {
            area += own;
            mean += own * plane.place(at);
        }
        mean /= area;
        for &(_, at, own) in polygons {
            let off = plane.place(at) - mean;
            let products = [off.x * off.x, off.x * off.y, off.y * off.y];
            for (sum, product) in square.iter_mut().zip(products) {
                *sum += own * product;
            }
        }
        let [xx, xy, yy] = square;
        let (sin, cos) = libm::sincosf(0.5 * libm::atan2f(2.0 * xy, xx - yy));
        let least = (yy * cos * cos - 2.0 * xy * sin * cos + xx * sin * sin).max(0.0);
        let (mut cracked, mut sum) = (Vec2::ZERO, 0.0);
        for (middle, _, own) in self.cuts_along(cracks, Some(plane)) {
            cracked += own * plane.place(middle);
            sum += own;
        }
        // No crack may run along the new plane.
        let away = match sum > 0.0 {
            true => mean - cracked / sum,
            false => Vec2::ZERO,
        };
        let narrow = Vec2::new(-sin, cos);
        let toward = match xx + yy - least < COMPACT * least {
            true => away.normalize_or(narrow),
            false => narrow * away.dot(narrow).signum(),
        };
        let [a, b] = plane.axes;
        let toward = toward.x * a + toward.y * b;
        let axes = [plane.normal.cross(toward), toward];
        let height = libm::sqrtf(12.0 * least / area);
        Plane {
            axes,
            near: plane.near.max(NEAR_HEIGHT * height),
            ..plane
        }
    }

    /// Returns true if a tetrahedron has stress: in a piece only its own uncut ones do.
    fn is_own(&self, tet: u32) -> bool {
        let portion = self.asset.portion.as_ref();
        portion.is_none_or(|piece| piece.tets().binary_search(&tet).is_ok())
    }

    /// Tetrahedra that a plane passes, from those of cracks on through neighbours, with the middle and the area of what it cuts of them. Cracks
    /// across it end it.
    fn passed(&self, cracks: &[usize], origin: Vec3, normal: Vec3) -> Vec<(u32, Vec3, f32)> {
        let mesh = &self.asset.fracture;
        let values = |tet: u32| {
            let x = mesh.corners(tet as usize);
            (x, x.map(|x| (x - origin).dot(normal)))
        };
        let crosses = |s: &[f32]| s.iter().any(|&s| s < 0.0) && s.iter().any(|&s| s >= 0.0);
        let mut seen = vec![false; mesh.tets.len()];
        let mut queue: Vec<u32> = Vec::new();
        for cut in cracks.iter().flat_map(|&id| self.cracks[id].unsettled()) {
            let seen = &mut seen[cut.tet as usize];
            if !*seen && self.is_own(cut.tet) && crosses(&values(cut.tet).1) {
                *seen = true;
                queue.push(cut.tet);
            }
        }
        let is_open = |tet: u32| match self.fractured_by[tet as usize] {
            UNCUT => true,
            ELSEWHERE => false,
            by => {
                let cut = &self.cracks[by as usize].elements[self.cut_at[tet as usize] as usize];
                cut.direction.dot(normal).abs() > ALONG
            }
        };
        let mut next = 0;
        let mut polygons = Vec::new();
        while let Some(&tet) = queue.get(next) {
            next += 1;
            let (x, s) = values(tet);
            let (middle, area) = crossing(&x, &s);
            polygons.push((tet, middle, area));
            for (face, &n) in FACES.iter().zip(&mesh.neighbours[tet as usize]) {
                if n != NO_NEIGHBOUR
                    && !seen[n as usize]
                    && crosses(&face.map(|i| s[i]))
                    && self.is_own(n)
                    && is_open(n)
                {
                    seen[n as usize] = true;
                    queue.push(n);
                }
            }
        }
        polygons
    }

    /// Sets the factors of the displacements of the analysis nodes in the resultants.
    fn set_factors(&self, section: &mut Section, polygons: &[(u32, Vec3, f32)]) {
        let material = &self.asset.material;
        let (e, nu) = (material.youngs_modulus, material.poisson_ratio);
        let lambda = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))) as f32;
        let twice_mu = (e / (1.0 + nu)) as f32;
        let analysis = &self.asset.analysis;
        let count = section.columns().len();
        let normal = section.plane.normal;
        // σ_nn = λ ∇·u + 2 μ n·(∇u) n
        let stress = Mat3::from_diagonal(Vec3::splat(lambda))
            + twice_mu * Mat3::from_cols(normal.x * normal, normal.y * normal, normal.z * normal);
        // Rows of the nodes in the order in which polygons ask for them.
        let mut place_of = vec![u32::MAX; analysis.nodes.len()];
        let (mut nodes, mut rows) = (Vec::<u32>::new(), Vec::<[Vec3; 2]>::new());
        for &(tet, at, area) in polygons {
            let place = section.plane.place(at);
            let Some(column) = section.column(place) else {
                continue;
            };
            let arm = place.y - section.columns()[column].middle() as f32;
            let point = self.asset.embedded_tet(tet as usize);
            let element = point.element as usize;
            let barycentric = &analysis.barycentric_gradients[element];
            let point = point.moved(barycentric, at - self.centroids[tet as usize]);
            let gradients = point.shape_gradients(barycentric);
            for (&node, g) in analysis.elements[element].iter().zip(gradients) {
                let row = area * (stress * g);
                let place = &mut place_of[node as usize];
                if *place == u32::MAX {
                    *place = nodes.len() as u32;
                    nodes.push(node);
                    rows.resize(rows.len() + count, [Vec3::ZERO; 2]);
                }
                let rows = &mut rows[*place as usize * count + column];
                rows[0] += row;
                rows[1] -= arm * row;
            }
        }
        nodes.sort_unstable();
        let rows_of = |node: u32| {
            let first = place_of[node as usize] as usize * count;
            &rows[first..first + count]
        };
        section.factors = nodes
            .iter()
            .flat_map(|&node| rows_of(node))
            .copied()
            .collect();
        section.nodes = nodes;
    }

    /// Sets G Λ⁻¹ Gᵀ of the modes that are followed, as far as they are too slow to give way while a crack runs through the section.
    fn set_stiffness(&self, section: &mut Section, modes: usize) {
        let n = 2 * section.columns().len();
        let rows = products(self.asset, section, modes);
        let heights = section.columns().iter().map(Column::height);
        let duration = heights.fold(0.0, f64::max) / self.crack_speed();
        let mut matrix = vec![0.0; n * n];
        for (mode, &eigenvalue) in self.asset.modes.eigenvalues[..modes].iter().enumerate() {
            // A step of force that lasts for t moves a mode by 1 − cos ωt of its static response.
            let held = 1.0 / (1.0 + 0.5 * eigenvalue * duration * duration);
            let of = |i: usize| f64::from(rows[i * modes + mode]);
            for i in 0..n {
                for j in 0..n {
                    matrix[i * n + j] += of(i) * of(j) * held / eigenvalue;
                }
            }
        }
        (section.of_modes, section.stiffness) = (rows, matrix);
    }

    /// Speed of the cracks, m/s.
    fn crack_speed(&self) -> f64 {
        self.config.crack_speed().unwrap_or(1.0) * self.asset.material.rayleigh_speed()
    }
}

widest! {
    /// Resultants of a section in each mode of unit amplitude: `[resultant][mode]`.
    fn products(asset: &Asset, section: &Section, modes: usize) -> Vec<f32> {
        let n = 2 * section.columns().len();
        let mut rows = vec![0.0_f32; n * modes];
        for (&node, factors) in section.nodes.iter().zip(section.factors.chunks(n / 2)) {
            let [x, y, z] = asset.modes.rows(node as usize);
            let (x, y, z) = (&x[..modes], &y[..modes], &z[..modes]);
            for (row, f) in rows.chunks_mut(modes).zip(factors.as_flattened()) {
                // A node has factors in the columns about it.
                if *f == Vec3::ZERO {
                    continue;
                }
                for i in 0..modes {
                    row[i] += f.x * x[i] + f.y * y[i] + f.z * z[i];
                }
            }
        }
        rows
    }
}
