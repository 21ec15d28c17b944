//! Checks of lists, row by row.

use glam::Vec3;

/// Result of a check; the error is a clause that says what is wrong.
pub(crate) type Check = Result<(), String>;

pub(super) fn all<T>(
    rows: &[T],
    sound: impl Fn(&T) -> bool,
    problem: impl Fn(usize) -> String,
) -> Check {
    match rows.iter().position(|row| !sound(row)) {
        Some(at) => Err(problem(at)),
        None => Ok(()),
    }
}

pub(super) fn finite(what: &str, points: &[Vec3]) -> Check {
    all(
        points,
        |p| p.is_finite(),
        |i| format!("{what} {i} is not finite"),
    )
}

pub(super) fn below<const N: usize>(
    what: &str,
    rows: &[[u32; N]],
    limit: usize,
    named: &str,
) -> Check {
    all(
        rows,
        |row| row.iter().all(|&v| (v as usize) < limit),
        |i| format!("{what} {i} refers to a {named} beyond the {limit} that exist"),
    )
}

pub(super) fn one_each(of: &str, wanted: usize, what: &str, found: usize) -> Check {
    if found == wanted {
        return Ok(());
    }
    Err(format!(
        "it needs one {what} per {of}: {wanted}, not {found}"
    ))
}

pub(super) fn none_or_one_each(of: &str, wanted: usize, what: &str, found: usize) -> Check {
    if found == 0 {
        Ok(())
    } else {
        one_each(of, wanted, what, found)
    }
}
