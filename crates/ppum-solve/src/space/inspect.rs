//! Makes sure that the functions of a step have finite values and energies on their patches.

use crate::smoothness::divergence;
use ppum::crack::Side;
use ppum::dataset::Step;
use ppum::domain::Domain;
use ppum::formula::Table;
use ppum::function::{Function, FunctionError, FunctionTable, GROUP, LocalFunctions, Role, Slot};
use ppum::jet::Jet;
use ppum::text::trimmed;
use ppum::vec2::{Rect, Vec2, vec2};
use std::sync::Arc;

/// Places in each direction of a patch at which its functions are looked at, in parts of its width.
/// They are not on lines that somebody would choose.
const LOOKS: [f64; 4] = [0.0717, 0.3129, 0.6483, 0.9271];

/// A function that the local space of a patch cannot hold.
#[derive(Debug, thiserror::Error)]
pub enum InspectError {
    /// It does not compile.
    #[error(transparent)]
    Compile(#[from] FunctionError),
    /// It has no finite value or gradient.
    #[error(
        "the enrichment `{name}` is {} at [{}, {}], with the gradient [{}, {}]; keep its patches away \
         from there, or change the formula so that it and its square are finite",
        trimmed(*.value), trimmed(.point.x), trimmed(.point.y), trimmed(.gradient.x), trimmed(.gradient.y)
    )]
    NotFinite {
        /// Name of the function.
        name: String,
        /// The place.
        point: Vec2,
        /// The value there.
        value: f64,
        /// The gradient there.
        gradient: Vec2,
    },
    /// The integral of the square of its gradient is infinite.
    #[error(
        "the enrichment `{name}` has infinite energy around [{}, {}]: the square of its gradient has no \
         integral there; powers of r need a positive exponent",
        trimmed(.point.x), trimmed(.point.y)
    )]
    Diverges {
        /// Name of the function.
        name: String,
        /// The place.
        point: Vec2,
    },
    /// No patch has it.
    #[error("no patch has the enrichment `{name}`")]
    Nowhere {
        /// Name of the function.
        name: String,
    },
}

/// Looks at all user-defined functions, at some points of their patches.
///
/// # Errors
/// The first that is not finite, or that no patch has.
pub(crate) fn inspect(
    step: &Step,
    domain: &Domain,
    tables: &[Arc<Table>],
) -> Result<(), InspectError> {
    let is_own = |(_, f): &(u32, &Function)| f.kind.role() == Some(Role::User);
    let own: Vec<_> = (0..).zip(&step.functions).filter(is_own).collect();
    if own.is_empty() {
        return Ok(());
    }
    let table = FunctionTable::new(&step.functions, step.cracks.len(), tables)?;
    let mut divergent = vec![None; step.functions.len()];
    for &(index, function) in &own {
        divergent[index as usize] = divergence(function, step, tables)?;
    }
    let data = &step.fields[0];
    if let Some((_, function)) = own.iter().find(|(i, _)| !data.block_function.contains(i)) {
        return Err(InspectError::Nowhere { name: function.name.clone() });
    }
    for patch in 0..step.partition.len() {
        let part = step.partition.support(patch).intersection(&domain.bounds);
        let seen = table.at(&step.cracks, part.center());
        for block in data.blocks(patch) {
            let index = data.block_function[block];
            let function = &step.functions[index as usize];
            if let Some(point) =
                divergent[index as usize].filter(|&p| part.contains(p) && domain.contains(p))
            {
                return Err(InspectError::Diverges { name: function.name.clone(), point });
            }
            if own.iter().any(|(own, _)| *own == index) {
                look(&seen, index, &function.name, &part, domain)?;
            }
        }
    }
    Ok(())
}

fn look(
    seen: &LocalFunctions<'_>,
    function: u32,
    name: &str,
    part: &Rect,
    domain: &Domain,
) -> Result<(), InspectError> {
    let Slot::Jet { group, entry } = seen.table().of(function) else { return Ok(()) };
    let size = part.size();
    for (s, t) in LOOKS.into_iter().flat_map(|s| LOOKS.map(|t| (s, t))) {
        let point = part.min + vec2(s * size.x, t * size.y);
        if !domain.contains(point) {
            continue;
        }
        let offset = point - part.center();
        let mut jets = [Jet::constant(0.0); GROUP];
        seen.evaluate::<f64, 1>(group as usize, [offset.x, offset.y], Side::Above, &mut jets);
        let Jet { v: value, x, y, .. } = jets[entry as usize];
        // integrals are of squares
        if ![value, x, y].iter().all(|v| (v * v).is_finite()) {
            let (name, gradient) = (name.to_owned(), vec2(x, y));
            return Err(InspectError::NotFinite { name, point, value, gradient });
        }
    }
    Ok(())
}
