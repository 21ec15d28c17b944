//! Prints where the energy of every built-in scene's breaks goes: the page `docs/energy.md`. Takes names of scenes, or all.
//! Fails when a break makes energy.

use std::error::Error;

use frangible::Contact;
use frangible_rapier::BreakCause;
use frangible_scenes::{BreakRecord, SCENE_NAMES, bake, play, scene};

/// All of them break sooner, s.
const LONGEST: f64 = 2.0;

fn main() -> Result<(), Box<dyn Error>> {
    let asked: Vec<String> = std::env::args().skip(1).collect();
    let wanted = |name: &&&str| asked.is_empty() || asked.iter().any(|a| a == **name);
    println!("{HEAD}");
    let (mut problems, mut blows, mut shares) = (Vec::new(), Vec::new(), Vec::new());
    for name in SCENE_NAMES.iter().filter(wanted) {
        let mut scene = scene(name)?;
        scene.duration = scene.duration.min(LONGEST);
        let baked = bake(&scene)?;
        let run = play(&scene, &baked, &mut |_| {})?;
        let (mut again, mut count) = (Row::default(), 0);
        for record in &run.breaks {
            let problem = record.energy_created();
            problems.extend(problem.map(|problem| format!("{name}: {problem}")));
            if record.generation == 0 {
                println!("{}", Row::of(record).text(name, cause(record)));
                blows.extend(blow(name, record));
                shares.extend(share(name, record));
            } else {
                again.add(&Row::of(record));
                count += 1;
            }
        }
        if count > 0 {
            println!("{}", again.text(name, &format!("{count} pieces again")));
        }
        if run.breaks.is_empty() {
            println!("| {name} | held | | | | | | | | | | | |");
        }
    }
    println!("\n{FOOT}\n\n{BLOWS}\n{}", blows.join("\n"));
    println!("\n{SHARES}\n{}", shares.join("\n"));
    if problems.is_empty() {
        Ok(())
    } else {
        Err(problems.join("\n").into())
    }
}

const HEAD: &str = "# Energy of the built-in scenes' breaks

Written by `cargo run --release -p frangible-scenes --example energy > docs/energy.md`, which fails where energy is made;
`crates/frangible-scenes/tests/energy.rs` checks the same of some scenes. Energies in J.

| scene | cause | pieces | approach | peak strain | cracks | cracks / strain | kinetic before | work | kinetic after | paid by motion | lost to contacts | crushing, by the blow |
|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|";

const FOOT: &str = "*Approach*: the most kinetic energy that the contacts can take from the bodies' motion against each other along their normals. *Peak
strain*: largest strain energy of the vibration at a time step. *Cracks*: fracture energy Σ A G_c, at most the peak strain and at most the
approach. *Kinetic before* and *after*: of the body, or its pieces, and of all that it pushed in the step of the break, directly or
through others. *Work*: of gravity in that step. *Paid by motion*: what of the cracks' energy was taken from the motion. *Lost to
contacts*: the rest, before + work − after − paid; restitution and friction took it, and cracks of others that broke in the same step.
*Crushing, by the blow*: what the blow put into crushing the weaker body where it was touched. The blow and the rigid bodies count apart, so it
may exceed what was lost to contacts. *Pieces again*: sums over all pieces of the scene that broke again.

So cracks ≤ approach ≤ before + work, and after + all cracks of the step ≤ before + work. Without friction the peak strain is at most the
approach too. Friction follows the normal force and does not change it. What it adds to the vibration comes from the sliding motion,
which is not followed in the blow: there the strain may be larger than the approach, and cracks are not given what is above. A load that
rests has no approach: its strain energy is the work it does on the body.";

const BLOWS: &str = "## The blows

What became of the contact with the largest force in each of those breaks of whole bodies that came from an impact. Nothing of it was given: striker and body were
integrated together. *Hertz*: how long the same contact would last on a rigid, free body. *Departure over approach*: the coefficient of
restitution; negative where cracks cut the wall out and the striker went on into it.

| scene | approach, m/s | lasted, µs | Hertz, µs | force, N | impulse, N·s | departure over approach |
|---|---:|---:|---:|---:|---:|---:|";

const SHARES: &str = "## The blows' energy

Energy that the contacts of these blows brought into the body, and what became of it, until they parted.

- *Into the body*: work of the contacts on its vibration and its pieces, friction included: force times displacement, summed over the substeps.
- *Damped*: taken by the material's damping.
- *Faces*: lost where faces of pieces closed and pressed on each other.
- *Partings*: lost when pieces parted. Pieces that are too small to move on their own lose their motion.
- *Pieces*: kinetic energy of the pieces against the rigid motion of the whole body, in the end.
- *Ringing*: the rest of the energy when the contacts parted, as vibration and strain. Cracks are paid from it.
- *Not closed*: the work less all of these. Each of them is found on its own, so this is the error of the integration and of the sums.

| scene | approach, J | crushing, J | into the body, J | damped | faces | partings | pieces | ringing | not closed |
|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|";

/// Row of the energy balance of a blow.
fn share(name: &str, b: &BreakRecord) -> Option<String> {
    let r = &b.report;
    let energy = r.blow_energy;
    let crushing: f64 = r.contacts.iter().map(|c| c.crushing_energy).sum();
    let of_work =
        |energy: f64, digits: usize| format!("{:.digits$} %", 100.0 * energy / r.blow_energy.work);
    (energy.work > 0.0).then(|| {
        format!(
            "| {name} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
            short(r.approach_energy),
            short(crushing),
            short(energy.work),
            of_work(energy.damped, 1),
            of_work(energy.faces, 1),
            of_work(energy.released, 1),
            of_work(energy.pieces, 1),
            of_work(energy.kept - energy.pieces, 1),
            of_work(
                energy.work - energy.damped - energy.faces - energy.released - energy.kept,
                2
            ),
        )
    })
}

/// The blow of a break, if it was one.
fn blow(name: &str, b: &BreakRecord) -> Option<String> {
    let r = &b.report;
    let outcomes = r.contacts.iter();
    let hardest = outcomes.max_by(|a, b| a.peak_force.total_cmp(&b.peak_force))?;
    let distance = |contact: &&Contact| contact.point.distance(hardest.point);
    let given = b.contacts.iter();
    let given = given.min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
    let speed = f64::from(given.approach_speed);
    Some(format!(
        "| {name} | {} | {} | {} | {} | {} | {:.2} |",
        short(speed),
        short(1e6 * hardest.duration),
        short(1e6 * r.unadjusted_duration),
        short(hardest.peak_force),
        short(hardest.impulse),
        hardest.departure_speed / speed,
    ))
}

fn cause(b: &BreakRecord) -> &'static str {
    match b.cause {
        BreakCause::Impact => "impact",
        BreakCause::Rest => "load",
        BreakCause::Blast => "blast",
        _ => "script",
    }
}

/// Row of the table for a break, or for several together.
#[derive(Default)]
struct Row {
    pieces: usize,
    approach: f64,
    strain: f64,
    cracks: f64,
    before: f64,
    work: f64,
    after: f64,
    paid: f64,
    crushing: f64,
}

impl Row {
    fn of(b: &BreakRecord) -> Self {
        let r = &b.report;
        Self {
            pieces: b.masses.len(),
            approach: r.approach_energy,
            strain: r.peak_strain_energy,
            cracks: r.fracture_energy,
            before: b.kinetic_before,
            work: b.work,
            after: b.kinetic_after,
            paid: b.energy_paid,
            crushing: r.contacts.iter().map(|c| c.crushing_energy).sum(),
        }
    }

    fn add(&mut self, other: &Self) {
        self.pieces += other.pieces;
        self.approach += other.approach;
        self.strain += other.strain;
        self.cracks += other.cracks;
        self.before += other.before;
        self.work += other.work;
        self.after += other.after;
        self.paid += other.paid;
        self.crushing += other.crushing;
    }

    fn text(&self, name: &str, cause: &str) -> String {
        let lost = self.before + self.work - self.after - self.paid;
        let numbers = [
            short(self.before),
            short(self.work),
            short(self.after),
            short(self.paid),
            short(lost),
            short(self.crushing),
        ];
        format!(
            "| {name} | {cause} | {} | {} | {} | {} | {:.0} % | {} |",
            self.pieces,
            short(self.approach),
            short(self.strain),
            short(self.cracks),
            100.0 * self.cracks / self.strain,
            numbers.join(" | ")
        )
    }
}

/// Writes a number with three digits.
fn short(x: f64) -> String {
    if x.abs() < 5e-5 {
        return "0".into();
    }
    let digits = (2.0 - x.abs().log10().floor()).clamp(0.0, 5.0);
    format!("{x:.*}", digits as usize)
}
