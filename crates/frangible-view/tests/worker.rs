//! A session on its own thread holds nobody up.

use std::time::{Duration, Instant};

use crate::common;
use frangible_view::{Command, Shown, Worker};

fn wait(worker: &Worker, until: impl Fn(&Shown) -> bool) -> std::sync::Arc<Shown> {
    let began = Instant::now();
    loop {
        let shown = worker.latest();
        if until(&shown) {
            return shown;
        }
        assert!(!worker.is_dead());
        assert!(
            began.elapsed() < Duration::from_secs(300),
            "it takes for ever"
        );
        std::thread::sleep(Duration::from_millis(2));
    }
}

fn send(worker: &mut Worker, line: &str) {
    assert!(worker.send(Command::parse(line).unwrap()));
}

#[test]
fn a_bake_and_a_break_show_on_the_way_and_are_done_at_the_end() {
    let mut worker = Worker::start(false, None);
    let path = common::scene_file("worker");
    send(&mut worker, &format!("open {}", path.display()));
    // While it bakes, the shown state says so.
    wait(&worker, |shown| shown.bake.is_some());
    wait(&worker, |shown| shown.whole == 1);
    send(&mut worker, "step 500");
    send(&mut worker, "look cracks");
    let shown = wait(&worker, |shown| worker.is_done(shown));
    assert_eq!(shown.steps, 500, "commands wait for the steps before them");
    assert!(shown.pieces > 3 && shown.course.is_some());
}

#[test]
fn the_clock_runs_by_itself_and_stands_when_it_is_told() {
    let mut worker = Worker::start(true, None);
    let path = common::scene_file("clock");
    send(&mut worker, &format!("open {}", path.display()));
    wait(&worker, |shown| shown.time > 0.01);
    send(&mut worker, "pause");
    let stopped = wait(&worker, |shown| worker.is_done(shown));
    std::thread::sleep(Duration::from_millis(50));
    assert_eq!(worker.latest().steps, stopped.steps);
    send(&mut worker, "slow-motion 0.001");
    send(&mut worker, "run");
    std::thread::sleep(Duration::from_millis(300));
    let slow = worker.latest().time - stopped.time;
    // A thousandth of 0.3 s, or a step more; a busy machine may have given it less.
    assert!(slow < 2e-3, "{slow} s");
}
