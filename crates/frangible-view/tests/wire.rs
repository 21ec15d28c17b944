//! A session in another program is seen as if it were here.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::common::{self, broken};
use frangible_view::{Command, Packer, Remote, Session, Shown, Unpacker, Worker};

fn give(session: &mut Session, line: &str) {
    session.apply(Command::parse(line).unwrap()).unwrap();
    session.finish_jobs();
}

#[test]
fn what_is_read_is_what_was_written() {
    let mut session = broken("wire");
    let (mut packer, mut unpacker) = (Packer::default(), Unpacker::default());
    for line in [
        "step 1",
        "show weak-points",
        "look stress",
        "scrub 0.3",
        "look cracks",
        "show starts",
        "look modes",
        "knob strength 40",
        "hit-again",
        "look world",
        "select 0.06,0.1,1 0.06,0.1,0",
        "explode 1",
        "step 3",
        "undo",
    ] {
        give(&mut session, line);
        let shown = session.shown();
        let read = unpacker.unpack(&packer.pack(&shown)).expect(line);
        assert_eq!(format!("{read:?}"), format!("{shown:?}"), "{line}");
    }
}

#[test]
fn triangles_that_are_known_are_not_sent_again() {
    let mut session = broken("wire-again");
    let (mut packer, mut unpacker) = (Packer::default(), Unpacker::default());
    let first = packer.pack(&session.shown());
    let known = unpacker.unpack(&first).unwrap();
    // Nothing has changed.
    let again = packer.pack(&session.shown());
    assert!(20 * again.len() < first.len(), "{} bytes", again.len());
    let read = unpacker.unpack(&again).unwrap();
    assert!(Arc::ptr_eq(&read.picture, &known.picture));
    // Pieces that have moved have the triangles that they had.
    give(&mut session, "step 5");
    let moved = unpacker.unpack(&packer.pack(&session.shown())).unwrap();
    assert_ne!(moved.picture.version, known.picture.version);
    let pairs = known.picture.batches.iter().zip(&moved.picture.batches);
    assert!(pairs.len() > 0);
    for (before, after) in pairs {
        assert!(Arc::ptr_eq(&before.faces, &after.faces));
    }
}

#[test]
fn bytes_of_something_else_are_refused() {
    let bytes = Packer::default().pack(&broken("wire-bad").shown());
    let read = |bytes: &[u8]| Unpacker::default().unpack(bytes);
    assert!(read(&bytes).is_some());
    for length in (0..bytes.len()).step_by(bytes.len() / 300 + 1) {
        assert!(read(&bytes[..length]).is_none(), "{length} bytes");
    }
    assert!(read(&[&bytes[..], &[0]].concat()).is_none());
    // Lengths that cannot be: an answer, whatever it is, and no end of memory.
    let mut wrong = bytes.clone();
    for at in (0..bytes.len().min(4000)).step_by(7) {
        wrong[at] = 0xff;
        let _ = read(&wrong);
        wrong[at] = bytes[at];
    }
}

/// A session on a thread of its own, of which only bytes are known.
struct Elsewhere {
    worker: Worker,
    packer: Packer,
    told: Arc<Shown>,
    lines: Rc<RefCell<Vec<String>>>,
}

impl Remote for Elsewhere {
    fn give(&mut self, line: String) {
        assert!(self.worker.send(Command::parse(&line).unwrap()));
        self.lines.borrow_mut().push(line);
    }

    fn news(&mut self) -> Vec<Vec<u8>> {
        let latest = self.worker.latest();
        if Arc::ptr_eq(&latest, &self.told) {
            return Vec::new();
        }
        self.told = latest;
        vec![self.packer.pack(&self.told)]
    }
}

#[test]
fn a_session_elsewhere_is_commanded_and_seen_from_here() {
    let lines = Rc::new(RefCell::new(Vec::new()));
    let mut worker = Worker::start_there(Box::new(Elsewhere {
        worker: Worker::start(false, None),
        packer: Packer::default(),
        told: Arc::default(),
        lines: Rc::clone(&lines),
    }));
    let path = common::scene_file("wire-elsewhere");
    let began = Instant::now();
    for line in [&format!("open {}", path.display()), "step 500"] {
        assert!(worker.send(Command::parse(line).unwrap()));
        while !worker.is_done(&worker.latest()) {
            worker.advance();
            assert!(!worker.is_dead() && began.elapsed() < Duration::from_secs(300));
            std::thread::sleep(Duration::from_millis(2));
        }
    }
    let shown = worker.latest();
    assert_eq!(shown.steps, 500);
    assert_eq!(
        shown.blow.as_ref().unwrap().masses,
        common::masses(&broken("wire-here").shown())
    );
    assert_eq!(lines.borrow().len(), 2);
}
