//! The china shop: things break, the same bits in every run, Rapier alone has their pieces.

use frangible_lab::bench::shop::{Options, measure};

#[test]
fn things_break_and_equal_runs_are_equal() {
    let options = Options {
        runs: 2,
        seconds: 1,
    };
    // Runs that differ are an error.
    let found = measure(&options, &mut |_, _| {}).unwrap();
    assert_eq!(
        (found.things, found.frames.len(), found.alone.len()),
        (1000, 60, 60)
    );
    let broken: usize = found.happened.iter().map(|h| h.breaks).sum();
    let pieces: usize = found.happened.iter().map(|h| h.pieces).sum();
    assert!(broken > 10 && pieces > 2 * broken, "{broken} into {pieces}");
    assert!(found.pieces > broken && found.pieces <= pieces);
    for (frame, alone) in found.frames.iter().zip(&found.alone) {
        assert!(frame.all > 0.0 && frame.rigid <= frame.all && *alone > 0.0);
        let parts: f64 = frame.parts.iter().sum();
        assert!(parts <= frame.ours + 1e-4, "{parts} {}", frame.ours);
    }
}
