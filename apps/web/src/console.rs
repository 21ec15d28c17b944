//! Log output to the browser's console.

use log::{LevelFilter, Log, Metadata, Record};

struct Console;

impl Log for Console {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        metadata.level() <= log::max_level()
    }

    fn log(&self, record: &Record<'_>) {
        if self.enabled(record.metadata()) {
            let text = format!("{}: {}", record.target(), record.args());
            web_sys::console::warn_1(&text.into());
        }
    }

    fn flush(&self) {}
}

/// Warnings and errors from now on.
pub(crate) fn start() {
    // It fails when there is a logger already; then that one has them.
    if log::set_logger(&Console).is_ok() {
        log::set_max_level(LevelFilter::Warn);
    }
}
