//! A picture in memory.

/// Pixels of red, green and blue, 8 bits each in sRGB, row by row from the upper left corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    height: u32,
    bytes: Vec<u8>,
}

impl Picture {
    /// A picture of one colour.
    #[must_use]
    pub fn filled(width: u32, height: u32, color: [u8; 3]) -> Self {
        Self::from_fn(width, height, |_, _| color)
    }

    /// A picture whose pixel in column `x` and row `y` is `color(x, y)`.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, mut color: impl FnMut(u32, u32) -> [u8; 3]) -> Self {
        let mut bytes = Vec::with_capacity(3 * width as usize * height as usize);
        for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
            bytes.extend(color(x, y));
        }
        Self {
            width,
            height,
            bytes,
        }
    }

    /// Width, pixels.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Height, pixels.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The bytes of all pixels.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The bytes of all pixels.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        &mut self.bytes
    }

    /// The pixel in column `x` and row `y`.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 3] {
        let at = self.offset(x, y);
        [self.bytes[at], self.bytes[at + 1], self.bytes[at + 2]]
    }

    /// Colours the pixel in column `x` and row `y`.
    ///
    /// # Panics
    /// If the pixel is outside the picture.
    pub fn set_pixel(&mut self, x: u32, y: u32, color: [u8; 3]) {
        let at = self.offset(x, y);
        self.bytes[at..at + 3].copy_from_slice(&color);
    }

    /// Copies another picture into this one, with its upper left corner at column `x` and row `y`. Parts outside are clipped.
    pub fn paste(&mut self, other: &Self, x: u32, y: u32) {
        let columns = other.width.min(self.width.saturating_sub(x)) as usize;
        let rows = other.height.min(self.height.saturating_sub(y));
        for row in 0..rows * u32::from(columns > 0) {
            let (from, to) = (other.offset(0, row), self.offset(x, y + row));
            self.bytes[to..to + 3 * columns]
                .copy_from_slice(&other.bytes[from..from + 3 * columns]);
        }
    }

    fn offset(&self, x: u32, y: u32) -> usize {
        assert!(
            x < self.width && y < self.height,
            "pixel {x}, {y} of {} × {}",
            self.width,
            self.height
        );
        3 * (y as usize * self.width as usize + x as usize)
    }
}

#[cfg(feature = "image")]
impl From<image::RgbImage> for Picture {
    fn from(image: image::RgbImage) -> Self {
        Self {
            width: image.width(),
            height: image.height(),
            bytes: image.into_raw(),
        }
    }
}

#[cfg(feature = "image")]
impl From<Picture> for image::RgbImage {
    fn from(picture: Picture) -> Self {
        let Picture {
            width,
            height,
            bytes,
        } = picture;
        Self::from_raw(width, height, bytes).expect("three bytes per pixel")
    }
}
