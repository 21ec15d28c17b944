//! A session in a host, as in a page: bodies are brought, files are given and taken, nothing is baked here.

use std::cell::RefCell;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use crate::common::{self, bits, masses, scene_file};
use frangible_scenes::{BakedBody, Scene, SceneError, bake, scene_of_file};
use frangible_view::{Command, Delivery, Host, Session, ViewError, Worker, same_bakes};

/// Files, and bodies that were asked for.
#[derive(Default)]
struct Kept {
    files: Vec<(PathBuf, usize)>,
    orders: Vec<(Scene, Delivery)>,
}

/// Has one scene.
struct OneScene(PathBuf, Rc<RefCell<Kept>>);

impl OneScene {
    fn new(test: &str) -> (Self, Rc<RefCell<Kept>>) {
        let kept = Rc::new(RefCell::new(Kept::default()));
        (Self(scene_file(test), Rc::clone(&kept)), kept)
    }

    fn bodies(&self) -> Vec<BakedBody> {
        bake(&scene_of_file(&self.0).unwrap()).unwrap()
    }
}

impl Host for OneScene {
    fn scene(&self, name: &str) -> Result<Scene, ViewError> {
        match name {
            "pane" => Ok(scene_of_file(&self.0)?),
            _ => Err(ViewError::NotNow(format!("there is no `{name}` here"))),
        }
    }

    fn open(&self, path: &Path) -> Result<Scene, ViewError> {
        match path == self.0 {
            true => Ok(scene_of_file(path)?),
            false => Err(ViewError::NotNow(format!(
                "`{}` was not given",
                path.display()
            ))),
        }
    }

    fn bring(&self, scene: &Scene, delivery: Delivery) {
        assert_eq!(scene.name, "small-pane");
        delivery.tell("fetching", 0.5);
        self.1.borrow_mut().orders.push((scene.clone(), delivery));
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
    let (_, order) = kept.borrow_mut().orders.pop().unwrap();
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
fn the_host_is_asked_for_another_bake_only_where_knobs_need_one() {
    let (host, kept) = OneScene::new("host-knobs");
    let bodies = host.bodies();
    let mut session = Session::in_host(Box::new(host));
    apply(&mut session, "scene pane").unwrap();
    let (own, order) = kept.borrow_mut().orders.pop().unwrap();
    order.finish(Ok(bodies));
    session.finish_jobs();
    apply(&mut session, "step 500").unwrap();
    apply(&mut session, "knob strength 20").unwrap();
    apply(&mut session, "hit-again").unwrap();
    session.finish_jobs();
    let compared = session.shown().compared.unwrap();
    assert!(compared.blows[1].pieces > compared.blows[0].pieces);
    assert!(kept.borrow().orders.is_empty(), "one bake serves both");

    let before = session.shown().steps;
    apply(&mut session, "knob poisson 0.3").unwrap();
    apply(&mut session, "hit-again").unwrap();
    let (wanted, order) = kept.borrow_mut().orders.pop().unwrap();
    assert!(!same_bakes(&own, &wanted));
    order.finish(bake(&wanted));
    session.finish_jobs();
    let shown = session.shown();
    assert_eq!(shown.steps, before, "the scene was not begun again");
    assert_eq!(shown.compared.unwrap().differences.len(), 2);
}

#[test]
fn a_file_that_was_given_runs_and_another_is_refused_by_its_name() {
    let (host, kept) = OneScene::new("host-open");
    let (file, bodies) = (host.0.clone(), host.bodies());
    let mut session = Session::in_host(Box::new(host));
    let refused = apply(&mut session, "open teapot.obj").unwrap_err();
    assert!(refused.to_string().contains("teapot.obj"));
    apply(&mut session, &format!("open {}", file.display())).unwrap();
    let (_, order) = kept.borrow_mut().orders.pop().unwrap();
    order.finish(Ok(bodies));
    session.finish_jobs();
    assert_eq!(session.shown().whole, 1);
}

#[test]
fn bodies_that_do_not_come_are_a_complaint() {
    let (host, kept) = OneScene::new("host-failure");
    let mut session = Session::in_host(Box::new(host));
    apply(&mut session, "scene pane").unwrap();
    let (_, order) = kept.borrow_mut().orders.pop().unwrap();
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
        if let Some((_, order)) = kept.borrow_mut().orders.pop() {
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
