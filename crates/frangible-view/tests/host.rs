//! A session in a host, as in a page: bodies are brought, files are taken, nothing is baked.

mod common;

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use common::{bits, masses, scene_file};
use frangible_scenes::{BakedBody, Scene, SceneError, bake, scene_of_file};
use frangible_view::{Command, Delivery, Host, Session, ViewError, Worker};

/// Files, and bodies that were asked for.
#[derive(Default)]
struct Kept {
    files: Vec<(PathBuf, usize)>,
    orders: Vec<Delivery>,
}

/// Has one scene.
struct OneScene(PathBuf, Rc<RefCell<Kept>>);

impl OneScene {
    fn new(test: &str) -> (Self, Rc<RefCell<Kept>>) {
        let kept = Rc::new(RefCell::new(Kept::default()));
        (Self(scene_file(test), Rc::clone(&kept)), kept)
    }

    fn bodies(&self) -> Vec<BakedBody> {
        bake(&scene_of_file(&self.0).unwrap(), &mut |_| {}).unwrap()
    }
}

impl Host for OneScene {
    fn scene(&self, name: &str) -> Result<Scene, ViewError> {
        match name {
            "pane" => Ok(scene_of_file(&self.0)?),
            _ => Err(ViewError::NotNow(format!("there is no `{name}` here"))),
        }
    }

    fn bring(&self, scene: &Scene, delivery: Delivery) {
        assert_eq!(scene.name, "small-pane");
        delivery.tell("fetching", 0.5);
        self.1.borrow_mut().orders.push(delivery);
    }

    fn save(&self, name: &Path, bytes: &[u8]) -> Result<(), ViewError> {
        let file = (name.to_path_buf(), bytes.len());
        self.1.borrow_mut().files.push(file);
        Ok(())
    }
}

fn apply(session: &mut Session, line: &str) -> Result<(), ViewError> {
    session.apply(Command::parse(line).unwrap())
}

#[test]
fn bodies_that_were_brought_break_as_those_baked_here() {
    let (host, kept) = OneScene::new("host");
    let bodies = host.bodies();
    let mut session = Session::in_host(Box::new(host));
    assert!(apply(&mut session, "scene vase").is_err());
    apply(&mut session, "scene pane").unwrap();
    session.poll();
    let shown = session.shown();
    assert!(shown.busy && shown.whole == 0);
    assert_eq!(shown.bake.map(|bake| bake.share), Some(0.5));
    let order = kept.borrow_mut().orders.pop().unwrap();
    assert!(!order.is_unwanted());
    order.finish(Ok(bodies));
    session.finish_jobs();
    apply(&mut session, "step 500").unwrap();
    let baked_here = common::broken("host");
    assert_eq!(bits(&session), bits(&baked_here));
    assert!(masses(&session.shown()).len() > 3);

    apply(&mut session, "save glb pieces.glb").unwrap();
    let files = &kept.borrow().files;
    assert_eq!(files.len(), 1);
    assert_eq!(files[0].0, Path::new("pieces.glb"));
    assert!(files[0].1 > 1000);
}

#[test]
fn what_would_need_a_bake_is_refused_and_the_rest_is_not() {
    let (host, kept) = OneScene::new("host-knobs");
    let bodies = host.bodies();
    let mut session = Session::in_host(Box::new(host));
    apply(&mut session, "scene pane").unwrap();
    kept.borrow_mut().orders.pop().unwrap().finish(Ok(bodies));
    session.finish_jobs();
    apply(&mut session, "step 500").unwrap();
    apply(&mut session, "knob poisson 0.3").unwrap();
    let refused = apply(&mut session, "hit-again").unwrap_err().to_string();
    assert!(refused.contains("another bake"), "{refused}");
    apply(&mut session, "reset-knob poisson").unwrap();
    apply(&mut session, "knob strength 20").unwrap();
    apply(&mut session, "hit-again").unwrap();
    session.finish_jobs();
    let compared = session.shown().compared.unwrap();
    assert!(compared.blows[1].pieces > compared.blows[0].pieces);
    assert!(kept.borrow().orders.is_empty(), "one bake serves both");
}

#[test]
fn bodies_that_do_not_come_are_a_complaint() {
    let (host, kept) = OneScene::new("host-failure");
    let mut session = Session::in_host(Box::new(host));
    apply(&mut session, "scene pane").unwrap();
    let order = kept.borrow_mut().orders.pop().unwrap();
    order.finish(Err(SceneError::NoBake {
        body: "pane".into(),
    }));
    session.finish_jobs();
    let message = session.shown().message.unwrap();
    assert!(message.1 && message.0.contains("pane"), "{message:?}");
}

#[test]
fn a_session_without_a_thread_goes_on_when_it_is_told_to() {
    let (host, kept) = OneScene::new("host-worker");
    let bodies = host.bodies();
    let mut worker = Worker::start_here(false, Box::new(host), None);
    for line in ["scene pane", "step 500"] {
        worker.send(Command::parse(line).unwrap());
        worker.advance();
        if let Some(order) = kept.borrow_mut().orders.pop() {
            order.finish(Ok(bodies.clone()));
        }
        // Each call does some milliseconds of the work.
        while !worker.is_done(&worker.latest()) {
            worker.advance();
        }
    }
    let shown = worker.latest();
    assert_eq!(shown.steps, 500);
    assert!(shown.pieces > 3 && !worker.is_dead());
}
