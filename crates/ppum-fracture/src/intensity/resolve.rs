//! Integrals over parts that are divided until that changes nothing.

use super::sums::Integrals;
use ppum::vec2::Vec2;
use ppum_solve::quadrature::QuadratureErrorEstimate;

/// Change of the integrals by a division that is nothing, in parts of their size.
const ACCURACY: f64 = 1e-11;

/// Most divisions, one in another.
const DEEPEST: usize = 14;

/// An integral over parts that are divided until that changes nothing.
pub(super) struct Integration<'i, P> {
    pub(super) integral: &'i dyn Fn(&P) -> Integrals,
    /// The sizes of the integrals.
    pub(super) scale: &'i Integrals,
    /// The place of what is not resolved.
    pub(super) at: Vec2,
    /// Most divisions.
    pub(super) most: usize,
}

impl<P> Integration<'_, P> {
    /// The integral over a part, of which one is known.
    pub(super) fn resolve<const N: usize>(
        &self,
        (part, whole): (P, Integrals),
        divide: impl Fn(&P) -> [P; N],
    ) -> Integrals {
        let (mut open, mut sum) = (vec![(part, whole, 0.0)], Integrals::default());
        let mut divisions = 0;
        for _ in 0..DEEPEST {
            divisions += open.len();
            for (part, whole, _) in std::mem::take(&mut open) {
                let inner = divide(&part).map(|part| {
                    let integral = (self.integral)(&part);
                    (part, integral)
                });
                let all = inner.iter().fold(Integrals::default(), |sum, (_, part)| sum.plus(*part));
                let change = all.plus(whole.times(-1.0)).part_of(self.scale);
                if change <= ACCURACY {
                    sum = sum.plus(all);
                } else {
                    open.extend(inner.into_iter().map(|(part, whole)| (part, whole, change)));
                }
            }
            if divisions + open.len() > self.most {
                break;
            }
        }
        for (_, whole, change) in open {
            sum = sum.plus(whole);
            sum.doubt.add(&QuadratureErrorEstimate::of_functions(change, self.at));
        }
        sum
    }
}
