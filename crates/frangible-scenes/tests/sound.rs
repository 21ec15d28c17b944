//! Energy and level of the sound of whole scenes.

use frangible_scenes::{
    BakedBody, LiveScene, LiveSound, Run, Scene, Sources, bake, energy_lost, energy_radiated, play,
    scene, sound, sound_config, sound_of,
};
use frangible_sound::{SPEED_OF_SOUND, TARGET};

const NONE: Sources = Sources {
    blows: false,
    cracks: false,
    touches: false,
    slides: false,
};

/// A glass and its pieces, coarse.
fn glass() -> (Scene, Run, Vec<BakedBody>) {
    let mut scene = scene("glass").expect("a scene");
    for body in &mut scene.bodies {
        body.resolution = Some(12_000);
        body.modes = 60;
    }
    // Until nearly all pieces lie.
    scene.duration = 2.5;
    let baked = bake(&scene).expect("a glass");
    let run = play(&scene, &baked, &mut |_| {}).expect("a run");
    (scene, run, baked)
}

#[test]
fn a_scene_sends_a_small_part_of_the_energy_that_it_lost() {
    let (scene, run, _) = glass();
    assert!(run.breaks.len() == 1 && !run.recording.touches.is_empty());
    let lost = energy_lost(&run);
    let mass: f64 = run.breaks[0].masses.iter().sum();
    // The fall of 1.2 m; the glass ends lower by half its height, and pieces may still be on their way.
    let fall = mass * 9.81 * 1.2;
    assert!((0.8..1.15).contains(&(lost / fall)), "{lost} of {fall}");
    let of = |sources| energy_radiated(&run, &scene, sources).expect("a sound");
    let all = of(Sources::ALL);
    // Of impacts 1e-4 to 1e-2 becomes sound.
    assert!((1e-5..1e-2).contains(&(all / lost)), "{all} J of {lost} J");
    let parts = [
        Sources {
            blows: true,
            ..NONE
        },
        Sources {
            cracks: true,
            ..NONE
        },
        Sources {
            touches: true,
            ..NONE
        },
        Sources {
            slides: true,
            ..NONE
        },
    ]
    .map(of);
    assert!(parts.iter().all(|&part| part > 0.0), "{parts:?}");
    // They come at different times and add up in the mean; tones that are masked in the whole are heard alone.
    let sum: f64 = parts.iter().sum();
    assert!((0.7..1.3).contains(&(sum / all)), "{parts:?} of {all}");
    // Cracks cannot send more than they were given: a share of their cost.
    let paid: f64 = run.recording.blows.iter().map(|b| b.fracture_energy).sum();
    assert!(parts[1] < 0.03 * paid, "{} of {paid}", parts[1]);
    // Slides cannot either: a share of what friction took.
    let slides = run.recording.slides.iter();
    let rubbed: f64 = slides.map(|slide| slide.power * slide.duration).sum();
    assert!(rubbed < lost, "friction took {rubbed} J of {lost} J");
    assert!(parts[3] < 1e-3 * rubbed, "{} of {rubbed}", parts[3]);
    assert_eq!(of(NONE), 0.0);
}

#[test]
fn touches_bring_no_more_energy_than_there_is() {
    let (_, run, _) = glass();
    let fastest = (2.0_f64 * 9.81 * 1.2).sqrt();
    let touches = &run.recording.touches;
    let mut energy = 0.0;
    for touch in touches {
        // Pieces spin, so that an edge is faster than the piece.
        assert!((0.0..4.0 * fastest).contains(&touch.speed), "{touch:?}");
        energy += 0.5 * touch.impulse * touch.speed;
    }
    // Half of impulse times speed is the energy of an approach that ends in one push; what passes impulses on counts more than once.
    let lost = energy_lost(&run);
    assert!(energy < 2.0 * lost, "{energy} J of {lost} J");
    // Spread over the steps, and never two in the same instant by the clock of the steps.
    let mut times: Vec<f64> = touches.iter().map(|touch| touch.time).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    assert!(times.len() as f64 > 0.99 * touches.len() as f64);
}

#[test]
fn a_scene_on_the_move_sounds_as_its_recording_does() {
    let (scene, run, baked) = glass();
    let camera = run.recording.camera;
    let mut live = LiveScene::new(&scene, &baked).expect("a scene");
    let mut ear = LiveSound::new(&live, &scene, &camera).expect("an ear");
    let mut heard = Vec::new();
    let mut longest = 0.0_f64;
    while live.time() < run.simulated {
        live.step().expect("a step");
        let clock = std::time::Instant::now();
        ear.step(&live, &mut heard).expect("a sound");
        longest = longest.max(clock.elapsed().as_secs_f64());
    }
    println!("the longest step took {:.1} ms to hear", 1e3 * longest);
    let recorded = sound(&run, &scene, &sound_config(&run, &scene)).expect("a sound");
    // Sound after the last step was not asked for.
    let known = &recorded.samples[..heard.len().min(recorded.samples.len())];
    let onset = |samples: &[f32]| {
        samples
            .iter()
            .position(|s| s.abs() > 0.02)
            .expect("a sound")
    };
    let apart = onset(&heard).abs_diff(onset(known)) as f64 / 2.0 / 48_000.0;
    // A step of the recording is 1/240 s where nothing is about to break.
    assert!(apart < 5e-3, "{apart} s");
    let energy = |samples: &[f32]| samples.iter().map(|s| f64::from(s * s)).sum::<f64>();
    // The blow is the same, and is all that is heard for 5 ms.
    let blow = |samples: &[f32]| {
        let from = onset(samples);
        energy(&samples[from..from + 2 * 240])
    };
    let ratio = blow(&heard) / blow(known);
    assert!((0.8..1.25).contains(&ratio), "{ratio}");
    // Afterwards the pieces fly by steps of another length and land elsewhere: when and how the largest ones land decides the energy of all.
    let ratio = energy(&heard) / energy(known);
    assert!((0.1..10.0).contains(&ratio), "{ratio}");
}

/// Level of 20 ms of both channels from a time on, dB over 1.
fn short_time(samples: &[f32], rate: f64, from: f64) -> f64 {
    let first = 2 * (from * rate) as usize;
    let part = samples.iter().skip(first).take(2 * (0.02 * rate) as usize);
    let power: f64 = part.clone().map(|&s| f64::from(s).powi(2)).sum();
    10.0 * (power / part.count().max(1) as f64).max(1e-30).log10()
}

#[test]
fn a_crash_and_the_shards_that_land_are_heard_at_one_loudness() {
    let (scene, run, _) = glass();
    let config = sound_config(&run, &scene);
    let sounded = sound(&run, &scene, &config).expect("a sound");
    let levelled = sounded.levelled(TARGET).expect("a level");
    let loudness = levelled.loudness.integrated.expect("loud enough");
    assert!((loudness - TARGET).abs() < 0.5, "{loudness} LUFS");
    assert!(levelled.loudness.true_peak.expect("a peak") < -0.99);
    let broke = run.recording.blows.iter().find(|b| !b.pieces.is_empty());
    let broke = broke.expect("it breaks").time;
    let below = |samples: &[f32]| {
        let crash = (0..10).map(|i| short_time(samples, config.rate, broke + 0.01 * f64::from(i)));
        let crash = crash.fold(f64::NEG_INFINITY, f64::max);
        let landings = run
            .recording
            .touches
            .iter()
            .filter(|t| t.time > broke + 0.15);
        let mut below: Vec<f64> = landings
            .map(|touch| {
                let way = (touch.point.as_dvec3() - config.listener.place).length();
                crash - short_time(samples, config.rate, touch.time + way / SPEED_OF_SOUND)
            })
            .collect();
        below.sort_by(f64::total_cmp);
        below[below.len() / 2]
    };
    let (before, after) = (below(&sounded.samples), below(&levelled.samples));
    println!("landings are {before:.1} dB below the crash before, {after:.1} after");
    assert!((0.0..30.0).contains(&after) && after < before - 3.0);
}

#[test]
fn the_pieces_of_a_glass_ring_on_with_what_it_had() {
    let (scene, run, _) = glass();
    let config = sound_config(&run, &scene);
    let blows = Sources {
        blows: true,
        ..NONE
    };
    let heard = sound_of(&run, &scene, &config, blows).expect("a sound");
    let broke = run.recording.blows.iter().find(|b| !b.pieces.is_empty());
    let broke = broke.expect("it breaks").time;
    // The blow and the body that broke are over after some milliseconds and their way.
    let [crash, rings, late] =
        [0.0, 0.03, 0.3].map(|after| short_time(&heard.samples, config.rate, broke + after));
    println!("{crash:.0}, {rings:.0}, {late:.0} dB");
    assert!((3.0..40.0).contains(&(crash - rings)), "{crash} {rings}");
    assert!(rings - late > 20.0, "{rings} {late}");
}
