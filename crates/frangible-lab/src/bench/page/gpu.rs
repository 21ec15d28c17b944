//! Batches of impacts on the CPU and on a GPU.

use std::fmt::Write;

use super::{ms, table};
use crate::bench::gpu::{Cost, Everywhere, Findings, OfBody};

/// Table of the times per impact by the size of the batch, with the choice.
#[must_use]
pub fn gpu(found: &Findings) -> String {
    let mut text = match &found.adapter {
        Ok(adapter) if adapter.software => format!(
            "Adapter: {}, **in software**: it computes on the same processor as the column beside it, so these times say that the path works, and \
             nothing of a graphics card.\n",
            adapter.name
        ),
        Ok(adapter) => format!("Adapter: {}.\n", adapter.name),
        Err(problem) => format!("**No GPU was measured**: {problem}.\n"),
    };
    let _ = write!(
        text,
        "\nOne steel ball of 60 g per impact, each on a body of its own, as fast as it takes to come near the strength; {} modes, our cracks \
         under given half-sines (`with_given_impulses`), 16 samples per period. The GPU finds which impacts held, and from which time step the CPU has to look at the others; the outcomes are the \
         same bits. The CPU computes on all its threads in both. ms per impact: wall clock, and in brackets CPU time of the whole process, the \
         fastest of three runs. Passes alone: what the GPU's own clock counts.\n",
        found.modes
    );
    for body in &found.bodies {
        of_body(&mut text, body, found.adapter.is_ok());
    }
    if let Some(everywhere) = &found.everywhere {
        of_everywhere(&mut text, everywhere, found.modes);
    }
    text
}

/// Steps that the goal of [`of_everywhere`] is stated for.
const GOAL_STEPS: f64 = 64.0;

fn of_everywhere(text: &mut String, found: &Everywhere, modes: usize) {
    let share = GOAL_STEPS / found.steps as f64;
    let _ = write!(
        text,
        "\n### Stress everywhere: {}, {} tetrahedra, all of them weak points, {} analysis nodes, {modes} modes\n\nEvery tetrahedron is looked \
         at in each of {} time steps. The GPU's own clock times its passes; `all` is wall clock with what comes and goes, the fastest of some \
         runs. One thread of the CPU takes {} ms. The peaks differ by {:.1e}. Goal for 64 steps on a card: 1 ms.\n\n",
        found.name,
        found.tets,
        found.analysis_nodes,
        found.steps,
        ms(found.cpu),
        found.difference,
    );
    let passes = found.passes.iter().map(|&(pass, seconds)| (pass, seconds));
    let sum = ("passes together", found.passes.iter().map(|p| p.1).sum());
    let rows: Vec<Vec<String>> = passes
        .chain([sum, ("all", found.gpu)])
        .map(|(pass, seconds)| vec![pass.into(), ms(seconds), ms(share * seconds)])
        .collect();
    text.push_str(&table(&["pass", "ms", "per 64 steps, ms"], &rows));
}

fn of_body(text: &mut String, body: &OfBody, gpu: bool) {
    let _ = write!(
        text,
        "\n### {}: {} tetrahedra, {} weak points, {} analysis nodes, {} time steps per impact\n\n",
        body.name, body.tets, body.weak_points, body.analysis_nodes, body.steps
    );
    let mut header = vec!["impacts", "with cracks", "CPU, ms"];
    if gpu {
        header.extend(["GPU, ms", "passes alone", "CPU / GPU"]);
    }
    header.push("chosen");
    let rows: Vec<Vec<String>> = (body.batches.iter())
        .map(|batch| {
            let mut cells = vec![
                batch.impacts.to_string(),
                batch.cracked.to_string(),
                cost(&batch.cpu),
            ];
            if let Some(of_gpu) = &batch.gpu {
                cells.push(cost(of_gpu));
                cells.push(batch.passes.map_or_else(String::new, ms));
                cells.push(super::digits(batch.cpu.wall / of_gpu.wall));
            }
            cells.push(batch.auto.into());
            cells
        })
        .collect();
    text.push_str(&table(&header, &rows));
    let _ = write!(text, "\nThe choice: {}.\n", body.why);
}

fn cost(cost: &Cost) -> String {
    match cost.cpu {
        Some(cpu) => format!("{} ({})", ms(cost.wall), ms(cpu)),
        None => ms(cost.wall),
    }
}
