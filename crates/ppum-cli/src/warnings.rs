//! Warnings of the solver as the commands show them.

use ppum_scene::facts::WarningFacts;

use crate::output::tell;

/// Writes warnings to standard error.
pub(crate) fn warn(warnings: &[WarningFacts]) {
    for warning in warnings {
        tell(&format!("warning: {}", warning.message));
    }
}

/// Writes warnings of the steps of a series: those of a kind in full for the first step that has
/// them, and the numbers of all others.
pub(crate) fn warn_of_steps(warnings: &[WarningFacts]) {
    let mut steps: Vec<(&str, Vec<usize>)> = Vec::new();
    for WarningFacts { step, kind, message, .. } in warnings {
        let known = steps.iter().position(|(known, _)| known == kind);
        let of_kind = known.unwrap_or(steps.len());
        if known.is_none() {
            steps.push((kind, vec![*step]));
        }
        let all = &mut steps[of_kind].1;
        if *step == all[0] {
            tell(&format!("warning: step {step}: {message}"));
        } else if all.last() != Some(step) {
            all.push(*step);
        }
    }
    for (kind, all) in steps.iter().filter(|(_, all)| all.len() > 1) {
        let runs = runs(&all[1..]);
        tell(&format!(
            "warning: {runs}: {kind} too; `ppum info` and `ppum sif --json` have the words"
        ));
    }
}

/// Rising numbers of steps in words: `steps 3, 5 to 7`.
fn runs(steps: &[usize]) -> String {
    let runs = steps.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, .., last] => format!("{first} to {last}"),
        all => all.iter().map(usize::to_string).collect(),
    });
    let name = if steps.len() == 1 { "step" } else { "steps" };
    format!("{name} {}", runs.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_told_as_runs() {
        assert_eq!(runs(&[3]), "step 3");
        assert_eq!(runs(&[3, 5, 6, 7, 9, 10]), "steps 3, 5 to 7, 9 to 10");
    }
}
