//! Several frames on one picture.

use frangible_recording::Recording;

use crate::{PhotoError, Picture, Studio};

/// Layout of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SheetOptions {
    /// Width of a cell, pixels. Default 640.
    pub cell_width: u32,
    /// Height of a cell, pixels. Default 480.
    pub cell_height: u32,
    /// Cells side by side. Default 2.
    pub columns: u32,
}

impl Default for SheetOptions {
    fn default() -> Self {
        Self {
            cell_width: 640,
            cell_height: 480,
            columns: 2,
        }
    }
}

/// White lines between the cells, pixels.
const GAP: u32 = 4;

/// The four moments of a break, labelled: before, first crack, just after, at
/// rest; each seen from the view of its own, if the recording has such views.
///
/// # Errors
///
/// The same as [`sheet_of_frames`].
pub fn contact_sheet(recording: &Recording, options: &SheetOptions) -> Result<Picture, PhotoError> {
    let moments = recording.labelled_moments();
    let cells = moments.map(|(frame, label)| (recording, frame, label));
    sheet_of_frames(&cells, options)
}

/// One labelled cell per frame, row by row; each seen from the view that its
/// own recording has for the frame.
///
/// # Errors
///
/// [`PhotoError::EmptySheet`] without a cell or a column, else as
/// [`Studio::new`] and [`Studio::frame`].
pub fn sheet_of_frames(
    cells: &[(&Recording, usize, &str)],
    options: &SheetOptions,
) -> Result<Picture, PhotoError> {
    let SheetOptions {
        cell_width,
        cell_height,
        columns,
    } = *options;
    let count = u32::try_from(cells.len()).unwrap_or(u32::MAX);
    let columns = columns.min(count);
    if columns == 0 {
        return Err(PhotoError::EmptySheet);
    }
    let studio = Studio::new(cell_width, cell_height)?;
    let rows = count.div_ceil(columns);
    let side = |cells: u32, length: u32| cells * (length + GAP) - GAP;
    let size = (side(columns, cell_width), side(rows, cell_height));
    let mut sheet = Picture::filled(size.0, size.1, [255; 3]);
    for (index, (recording, frame, label)) in (0..).zip(cells) {
        let cell = studio.frame(recording, *frame, &recording.view_of(*frame), label)?;
        let x = index % columns * (cell_width + GAP);
        let y = index / columns * (cell_height + GAP);
        sheet.paste(&cell, x, y);
    }
    Ok(sheet)
}
