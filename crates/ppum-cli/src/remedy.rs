//! Errors of the libraries with their remedies in the words of problem files, which libraries do
//! not know.

use std::error::Error;

use ppum::quantity::QuantityError;
use ppum_format::WriteError;
use ppum_fracture::solve::{LinearError, SolveError};
use ppum_render::RasterError;
use ppum_scene::error::{ImageError, ImageErrorKind};
use ppum_scene::region::PlaceError;
use ppum_solve::space::{InspectError, SpaceError};

/// The text of an error, with its remedy if there is one.
pub(crate) fn error_text(error: &(dyn Error + 'static)) -> String {
    let remedy = match error.downcast_ref() {
        Some(error) => of_solution(error),
        None => of_quantity(error).or_else(|| of_file(error)).or_else(|| of_place(error)),
    };
    remedy.map_or_else(|| error.to_string(), |remedy| format!("{error}; {remedy}"))
}

fn of_quantity(error: &(dyn Error + 'static)) -> Option<&'static str> {
    let quantity = match error.downcast_ref() {
        Some(RasterError::Quantity(quantity)) => quantity,
        _ => error.downcast_ref()?,
    };
    matches!(quantity, QuantityError::NoExact(_))
        .then_some("give it as [exact] in the problem file")
}

fn of_place(error: &(dyn Error + 'static)) -> Option<&'static str> {
    let place = match error.downcast_ref().map(|ImageError(kind)| &**kind) {
        Some(ImageErrorKind::Place(place)) => place,
        _ => error.downcast_ref()?,
    };
    matches!(place, PlaceError::Outside).then_some("`ppum info` says where that is")
}

fn of_file(error: &(dyn Error + 'static)) -> Option<&'static str> {
    matches!(error.downcast_ref()?, WriteError::TooLong { .. })
        .then_some("choose fewer cells or a lower order")
}

fn of_solution(error: &SolveError) -> Option<&'static str> {
    match error {
        SolveError::Basis(_) => Some("look at the formulas of [[enrichment]]"),
        SolveError::Singular { error, .. } | SolveError::Factor(error) => of_system(error),
        SolveError::Space(SpaceError::Function(InspectError::Nowhere { .. })) => {
            Some("give it a larger `radius`, or a condition in `where` that holds somewhere")
        }
        _ => None,
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
    use ppum_fracture::solve::Vicinity;

    #[test]
    fn remedies_end_the_sentence() {
        let around = Vicinity { center: vec2(0.5, 0.25), reach: vec2(0.125, 0.125) };
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
            assert_eq!(error_text(&error), said);
        }
        let error = QuantityError::NoExact("error".into());
        for error in [&error as &dyn Error, &RasterError::Quantity(error.clone())] {
            assert_eq!(
                error_text(error),
                "`error` needs the exact solution, which this dataset does not hold; give it as [exact] in the \
                 problem file"
            );
        }
        for error in [&PlaceError::Outside as &dyn Error, &ImageError::from(PlaceError::Outside)] {
            assert_eq!(
                error_text(error),
                "the view shows nothing of the domain; `ppum info` says where that is"
            );
        }
        assert_eq!(
            error_text(&WriteError::TooLong {
                length: 5_000_000_000,
                most: ppum_format::MAX_LENGTH
            }),
            "the file would have 5000000000 bytes, at most 4294967296 are read; choose fewer cells or a lower order"
        );
    }
}
