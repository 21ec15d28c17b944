//! Pictures by the graphics driver.

mod mode_sheet;
