//! Cracks, and the functions that belong to them.

use super::edges::check_edges;
use super::errors::{CheckResult, check_index, check_names, check_number, check_points, require};
use crate::crack::{Crack, SegmentId};
use crate::function::{Cut, CutBranch, Frame, Function, FunctionKind};

pub(super) fn check_crack(crack: &Crack) -> CheckResult {
    require(crack.points.len() >= 2, "", || {
        format!("has {} points, a crack needs two or more", crack.points.len())
    })?;
    check_edges(&crack.points, &crack.bulges, false)
}

pub(super) fn check_function(function: &Function, cracks: &[Crack]) -> CheckResult {
    let count = cracks.len();
    match &function.kind {
        FunctionKind::One => Ok(()),
        FunctionKind::Side { crack } => check_index("crack", *crack as usize, count, "cracks"),
        FunctionKind::Component { cuts } => check_cuts(cuts, cracks),
        FunctionKind::Level { .. } => Ok(()),
        FunctionKind::Formula { frame, parameters, declared, .. } => {
            check_names("parameters", parameters.iter().map(|(name, _)| name))?;
            for (name, value) in parameters {
                check_number(&format!("parameters `{name}`"), *value)?;
            }
            check_points("declared.kinks", declared.kinks.as_flattened())?;
            check_points("declared.singular", &declared.singular)?;
            check_frame(frame, count)
        }
    }
}

/// Each cut is by a segment of a crack, and all that follow from it stand behind it.
fn check_cuts(cuts: &[Cut], cracks: &[Crack]) -> CheckResult {
    require(!cuts.is_empty(), "cuts", || "a component needs at least one".into())?;
    for (k, cut) in cuts.iter().enumerate() {
        let SegmentId { crack, segment } = cut.segment;
        check_index(&format!("cuts[{k}].crack"), crack as usize, cracks.len(), "cracks")?;
        let segments = cracks[crack as usize].points.len().saturating_sub(1);
        check_index(&format!("cuts[{k}].segment"), segment as usize, segments, "segments")?;
        for (name, part) in [("left", cut.left), ("right", cut.right)] {
            let CutBranch::Cut(next) = part else { continue };
            let place = format!("cuts[{k}].{name}");
            check_index(&place, next as usize, cuts.len(), "cuts")?;
            require(next as usize > k, &place, || {
                format!("cut {next} follows from cut {k} and must stand behind it")
            })?;
        }
    }
    Ok(())
}

fn check_frame(frame: &Frame, cracks: usize) -> CheckResult {
    match *frame {
        Frame::World | Frame::Levels(_) => Ok(()),
        Frame::Fixed { origin, angle } => {
            check_points("frame.origin", &[origin])?;
            check_number("frame.angle", angle)
        }
        Frame::Tip(tip) => check_index("frame.crack", tip.crack as usize, cracks, "cracks"),
    }
}
