//! Compares the pipeline of `frangible` with the reference. For the first difference, tells how near the reference's deciding test was.

use frangible::ImpactReport;
use frangible::internals::CrackTrace;

use crate::reference::initiation::{Break, StartTest};

/// A mismatch counts against the pipeline unless the reference's own deciding test was this close, relative.
pub const MARGIN: f64 = 1e-4;

/// Starts of one element this near, in steps, are one: where the stress hardly rises the time it passes the strength at is
/// rounding.
const SAME_TIME: f64 = 0.05;

/// The first difference between the pipeline and the reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Mismatch {
    /// Description of the difference.
    pub what: String,
    /// Relative change of the deciding quantity that would have made the reference decide the same; infinite where no
    /// test of the reference decides it.
    pub margin: f64,
}

fn mismatch(what: String, margin: f64) -> Result<(), Mismatch> {
    Err(Mismatch { what, margin })
}

/// Compares steps, cracks, the order of their elements, and the sets of nodes.
///
/// # Errors
/// The first difference.
pub fn compare(
    report: &ImpactReport,
    trace: &CrackTrace,
    reference: &Break,
) -> Result<(), Mismatch> {
    compare_steps(report, reference)?;
    for k in 0..trace.cracks.len().max(reference.cracks.len()) {
        compare_start(trace, reference, k)?;
        compare_elements(trace, reference, k)?;
    }
    compare_fragments(trace, reference)
}

/// Compares steps and where the first crack starts, or that none does.
///
/// # Errors
/// The first difference.
pub fn compare_first_start(
    report: &ImpactReport,
    trace: &CrackTrace,
    reference: &Break,
) -> Result<(), Mismatch> {
    compare_steps(report, reference)?;
    compare_start(trace, reference, 0)
}

/// Contact duration and number of steps.
fn compare_steps(report: &ImpactReport, reference: &Break) -> Result<(), Mismatch> {
    if report.time_steps != reference.steps {
        let what = format!("{} steps, not {}", report.time_steps, reference.steps);
        return mismatch(what, reference.steps_margin);
    }
    let relative = (report.contact_duration / reference.duration - 1.0).abs();
    if relative > MARGIN {
        let what = format!("contact duration {relative:.1e} off");
        return mismatch(what, reference.steps_margin);
    }
    Ok(())
}

/// Compares the place and time at which crack `k` starts.
fn compare_start(trace: &CrackTrace, reference: &Break, k: usize) -> Result<(), Mismatch> {
    let theirs = trace.cracks.get(k).map(|c| {
        let time = c[0].time / reference.time_step;
        (time, c[0].tet)
    });
    let own = reference.cracks.get(k).map(|c| (c.time, c.elements[0].tet));
    match (theirs, own) {
        (None, None) => return Ok(()),
        (Some(p), Some(r)) if p.1 == r.1 && (p.0 - r.0).abs() < SAME_TIME => return Ok(()),
        _ => {}
    }
    let test = |(time, tet): (f64, u32)| {
        let of_tet = reference.starts.iter().filter(|s| s.tet == tet);
        of_tet.min_by(|a, b| (a.time - time).abs().total_cmp(&(b.time - time).abs()))
    };
    let strength = |at: Option<_>| at.and_then(test).map_or(f64::INFINITY, |s| s.margin);
    let margin = match (theirs, own) {
        // Both above strength in one step: their order decided, or one of the two was not above it.
        (Some(p), Some(r)) if test(p).map(|t| t.step) == test(r).map(|t| t.step) => {
            let order = match (test(p), test(r)) {
                (Some(a), Some(b)) => order_margin(a, b),
                _ => f64::INFINITY,
            };
            order.min(strength(theirs)).min(strength(own))
        }
        // The earlier one alone was above strength.
        (Some(p), Some(r)) => strength(Some(if p.0 < r.0 { p } else { r })),
        _ => strength(theirs.or(own)),
    };
    mismatch(
        format!("crack {k} starts at {theirs:?}, not {own:?}"),
        margin,
    )
}

/// Relative change of the stresses that would swap the order of two starts of one step: of the time they pass the strength
/// at, or, of instant cracks, of the stress.
fn order_margin(a: &StartTest, b: &StartTest) -> f64 {
    if a.time == b.time {
        (a.stress / b.stress - 1.0).abs()
    } else {
        (a.time - b.time).abs() / (1.0 / a.rise + 1.0 / b.rise)
    }
}

/// The order in which crack `k` fractures its elements.
fn compare_elements(trace: &CrackTrace, reference: &Break, k: usize) -> Result<(), Mismatch> {
    let (theirs, own) = (&trace.cracks[k], &reference.cracks[k]);
    for j in 0..theirs.len().max(own.elements.len()) {
        let p = theirs.get(j).map(|e| e.tet);
        let r = own.elements.get(j).map(|e| e.tet);
        if p == r {
            continue;
        }
        // The first look, after the j elements they share, whose outcome must have been another.
        let decided = own.visits.iter().find(|v| {
            v.elements == j && ((v.joined && Some(v.tet) == r) || (!v.joined && Some(v.tet) == p))
        });
        let margin = decided.map_or(f64::INFINITY, |v| v.margin);
        return mismatch(
            format!("element {j} of crack {k} is {p:?}, not {r:?}"),
            margin.min(own.frame_margin),
        );
    }
    Ok(())
}

/// Compares the fragments that the nodes belong to.
fn compare_fragments(trace: &CrackTrace, reference: &Break) -> Result<(), Mismatch> {
    // The pipeline numbers fragments by size, the reference by first node.
    let mut number: Vec<Option<u32>> = Vec::new();
    let mut count = 0;
    let mut same = trace.fragment_of_node.len() == reference.fragment_of_node.len();
    for (&theirs, &own) in trace
        .fragment_of_node
        .iter()
        .zip(&reference.fragment_of_node)
    {
        if number.len() <= theirs as usize {
            number.resize(theirs as usize + 1, None);
        }
        let name = number[theirs as usize].get_or_insert_with(|| {
            count += 1;
            count - 1
        });
        same &= *name == own;
    }
    if same {
        return Ok(());
    }
    let mut margin = f64::INFINITY;
    for (theirs, own) in trace.cracks.iter().zip(&reference.cracks) {
        for (a, b) in theirs.iter().zip(&own.elements) {
            for k in 0..4 {
                if (a.values[k] < 0.0) != (b.values[k] < 0.0) {
                    margin = margin.min(b.sign_margins[k]).min(own.frame_margin);
                }
            }
        }
    }
    mismatch("the same cracks part the nodes otherwise".into(), margin)
}
