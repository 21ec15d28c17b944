//! Squares into which a section is divided, and the part of each that is cracked.

use glam::Vec2;

/// Squares along the longer side, at most.
const MOST_SQUARES: usize = 256;

/// Area of a section by squares.
pub(super) struct Squares {
    low: Vec2,
    /// Side of a square, m.
    pub(super) side: f32,
    /// Numbers of squares along the axes.
    pub(super) count: [usize; 2],
    /// Area, and the part of it that is cracked, m², and the column.
    pub(super) list: Vec<(f32, f32, u32)>,
    /// Cracked area, m².
    pub(super) cracked: f64,
}

impl Squares {
    /// `polygons`: places and areas.
    pub(super) fn new(polygons: &[(Vec2, f32)], side: f32) -> Option<Self> {
        let places = || polygons.iter().map(|p| p.0);
        let low = places().reduce(Vec2::min)?;
        let extent = places().reduce(Vec2::max)? - low;
        let side = side.max(extent.max_element() / MOST_SQUARES as f32);
        let count = (extent / side).to_array().map(|n| n as usize + 1);
        let mut squares = Self {
            low,
            side,
            count,
            list: vec![(0.0, 0.0, 0); count[0] * count[1]],
            cracked: 0.0,
        };
        for &(place, area) in polygons {
            if let Some(k) = squares.of(place) {
                squares.list[k].0 += area;
            }
        }
        Some(squares)
    }

    /// Number of the square at a place, if there is one.
    pub(super) fn of(&self, place: Vec2) -> Option<usize> {
        let [x, y] = ((place - self.low) / self.side).to_array();
        let within = x >= 0.0 && y >= 0.0 && x < self.count[0] as f32 && y < self.count[1] as f32;
        within.then(|| y as usize * self.count[0] + x as usize)
    }

    /// Middle of a square along the height, m.
    pub(super) fn y(&self, k: usize) -> f64 {
        f64::from(self.low.y + self.side * ((k / self.count[0]) as f32 + 0.5))
    }
}

/// Standard deviation of the area along an axis, m. `polygons`: places and areas.
pub(super) fn spread(polygons: &[(Vec2, f32)], axis: usize) -> f64 {
    let sum = |power: i32| -> f64 {
        let moments = polygons.iter();
        let moments = moments.map(|&(at, a)| f64::from(a) * f64::from(at[axis]).powi(power));
        moments.sum()
    };
    let area = sum(0);
    let mean = sum(1) / area;
    libm::sqrt((sum(2) / area - mean * mean).max(0.0))
}
