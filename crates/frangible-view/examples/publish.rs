//! Cost of a picture of many pieces for the session's thread, while they fall and when they lie:
//! `cargo run --release -p frangible-view --example publish`.

use frangible_view::{Command, Session, ViewError};

fn main() -> Result<(), ViewError> {
    let mut session = Session::new();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/viewer/heap.toml");
    let first = std::env::args().nth(1).unwrap_or_else(|| scene.into());
    session.apply(Command::parse(&format!("open {first}"))?)?;
    session.finish_jobs();
    for seconds in 1..=6 {
        for _ in 0..60 {
            session.apply(Command::Frames(1))?;
            // Two pictures are with whoever draws them.
            let shown = session.shown();
            if shown.steps.is_multiple_of(3) {
                std::hint::black_box(session.shown());
            }
        }
        let before = session.shown().picture;
        session.apply(Command::Frames(1))?;
        let shown = session.shown();
        let batches = before.batches.iter().zip(&shown.picture.batches);
        let written = batches.filter(|(a, b)| !std::sync::Arc::ptr_eq(a, b));
        println!(
            "{seconds} s: {} pieces, {} triangles, {} batches, {} of them written again; the last {} pictures: {:.2} ms, p99 {:.2} ms",
            shown.pieces,
            shown.picture.triangles(),
            shown.picture.batches.len(),
            written.count(),
            shown.publishing.count,
            1e3 * shown.publishing.median,
            1e3 * shown.publishing.p99,
        );
    }
    Ok(())
}
