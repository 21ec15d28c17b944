//! Several pictures on one.

use crate::plot::Chart;
use image::RgbImage;

/// White between pictures, pixels.
const GAP: u32 = 4;

/// Side by side, upper edges level.
pub(crate) fn beside(pictures: &[RgbImage]) -> RgbImage {
    let width: u32 = pictures.iter().map(|p| p.width() + GAP).sum();
    let height = pictures.iter().map(RgbImage::height).max().unwrap_or(1);
    let mut all = white(width.saturating_sub(GAP), height);
    let mut x = 0;
    for picture in pictures {
        copy(&mut all, picture, x, 0);
        x += picture.width() + GAP;
    }
    all
}

/// One below the other, left edges level.
pub(crate) fn below(pictures: &[RgbImage]) -> RgbImage {
    let height: u32 = pictures.iter().map(|p| p.height() + GAP).sum();
    let width = pictures.iter().map(RgbImage::width).max().unwrap_or(1);
    let mut all = white(width, height.saturating_sub(GAP));
    let mut y = 0;
    for picture in pictures {
        copy(&mut all, picture, 0, y);
        y += picture.height() + GAP;
    }
    all
}

/// A drawn chart.
pub(crate) fn chart(chart: &Chart, width: u32, height: u32) -> RgbImage {
    chart.draw(width, height)
}

fn white(width: u32, height: u32) -> RgbImage {
    let mut picture = RgbImage::new(width.max(1), height.max(1));
    picture.fill(255);
    picture
}

fn copy(to: &mut RgbImage, from: &RgbImage, x: u32, y: u32) {
    for (column, row, &pixel) in from.enumerate_pixels() {
        to.put_pixel(x + column, y + row, pixel);
    }
}
