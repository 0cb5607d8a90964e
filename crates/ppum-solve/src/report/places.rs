//! Names of records of which there are many: of iterations and of levels.

/// The prefix of records of the iterations' residuals: `iteration 7`, `iteration 7 level 2`.
pub(super) const ITERATION: &str = "iteration ";

/// The prefix of records of levels: `level 2`.
pub(super) const LEVEL: &str = "level ";

/// The iteration that a name tells, and the level if it tells one.
pub(super) fn course_place(name: &str) -> Option<(usize, Option<usize>)> {
    let place = name.strip_prefix(ITERATION)?;
    match place.split_once(" level ") {
        Some((step, level)) => Some((step.parse().ok()?, Some(level.parse().ok()?))),
        None => Some((place.parse().ok()?, None)),
    }
}

/// The level that a name tells.
pub(super) fn level_place(name: &str) -> Option<usize> {
    name.strip_prefix(LEVEL)?.parse().ok()
}
