//! Errors of the libraries with what to change in a problem file.

use ppum_format::WriteError;
use ppum_solve::solve::{LinearError, SolveError};
use ppum_solve::space::{InspectError, SpaceError};

/// The error, and its remedy in the words of problem files where the solver does not know one.
pub(crate) fn with_remedy(error: SolveError) -> anyhow::Error {
    match remedy(&error) {
        Some(remedy) => anyhow::anyhow!("{error}; {remedy}"),
        None => error.into(),
    }
}

fn remedy(error: &SolveError) -> Option<&'static str> {
    match error {
        SolveError::Basis(_) => Some("look at the formulas of [[enrichment]]"),
        SolveError::Singular { error, .. } | SolveError::Factor(error) => of_system(error),
        SolveError::Space(SpaceError::Function(InspectError::Nowhere { .. })) => {
            Some("give it a larger `radius`, or a condition in `where` that holds somewhere")
        }
        _ => None,
    }
}

/// The same for a dataset that is not written.
pub(crate) fn with_smaller(error: WriteError) -> anyhow::Error {
    match error {
        WriteError::TooLong { .. } => {
            anyhow::anyhow!("{error}; choose fewer cells or a lower order")
        }
        error => error.into(),
    }
}

fn of_system(error: &LinearError) -> Option<&'static str> {
    matches!(error, LinearError::NotPositiveDefinite { .. })
        .then_some("if functions of [[enrichment]] depend on each other, leave one out")
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;
    use ppum_solve::solve::Around;

    #[test]
    fn remedies_end_the_sentence() {
        let around = Around { center: vec2(0.5, 0.25), reach: vec2(0.125, 0.125) };
        let singular = LinearError::NotPositiveDefinite { patch: 3, unknown: 1 };
        let nowhere = InspectError::Nowhere { name: "sqrt(x)".into() };
        for (error, said) in [
            (
                SolveError::Basis(around),
                "a function of the local spaces is not finite, or too large to compute with, around (0.5, 0.25), \
                 up to 0.125 away; look at the formulas of [[enrichment]]",
            ),
            (
                SolveError::Singular { around, error: singular },
                "around (0.5, 0.25), up to 0.125 away: the solution is not unique there: hold the plate by \
                 displacements if a part of it can move freely; if cracks or holes leave thin strips of material \
                 between them, use smaller cells; if functions of [[enrichment]] depend on each other, leave one out",
            ),
            (
                SpaceError::Function(nowhere).into(),
                "no patch has the enrichment `sqrt(x)`; give it a larger `radius`, or a condition in `where` that \
                 holds somewhere",
            ),
            (SpaceError::Nothing.into(), "the holes swallow the whole domain; make them smaller"),
        ] {
            assert_eq!(with_remedy(error).to_string(), said);
        }
        assert_eq!(
            with_smaller(WriteError::TooLong { length: 5_000_000_000 }).to_string(),
            "the file would have 5000000000 bytes, at most 4294967296 are read; choose fewer cells or a lower order"
        );
    }
}
