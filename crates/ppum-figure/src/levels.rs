//! Levels of isolines: round numbers, or so many.

use ppum_render::scale::{Normalization, Scale};

use crate::ticks::{TickStep, decades};

/// About `most` round values within the range of a colour bar, rising: multiples of 1, 2 or 5 ×
/// 10^k on a linear scale; powers of ten, with 2 and 5 times them if there is room, on a
/// logarithmic one, of both signs on a symmetric one. At most `most` values; none if `most` is 0.
#[must_use]
pub fn automatic(norm: &Normalization, most: usize) -> Vec<f64> {
    let (min, max) = (norm.min(), norm.max());
    if most == 0 {
        return Vec::new();
    }
    let found = match norm.scale() {
        Scale::Linear => Vec::new(),
        Scale::Log => thinned(&|digits| decades([min, max], digits), most),
        Scale::SymLog => thinned(&|digits| both_signs(norm, digits), most),
    };
    if found.len() < 2 { linear(min, max, most) } else { found }
}

/// Round values as [`automatic`] has them, as near to `count` of them as round steps allow.
#[must_use]
pub fn about(norm: &Normalization, count: usize) -> Vec<f64> {
    let lists = (count..=3 * count).map(|most| automatic(norm, most));
    let off = |list: &Vec<f64>| (list.len().max(1) as f64 / count.max(1) as f64).ln().abs();
    lists.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or_default()
}

/// `count` values that divide the range into equal parts, on the scale of the colour bar; its ends
/// are not among them.
#[must_use]
pub fn counted(norm: &Normalization, count: usize) -> Vec<f64> {
    let part = |k: usize| (k + 1) as f64 / (count + 1) as f64;
    (0..count).map(|k| norm.value(part(k))).collect()
}

fn linear(min: f64, max: f64, most: usize) -> Vec<f64> {
    let mut size = (max - min) / (most + 1) as f64;
    loop {
        let step = TickStep::at_least(size);
        let found = step.multiples(min, max);
        if found.len() <= most {
            return found;
        }
        size = 1.5 * step.size();
    }
}

/// The values of the finest list with at most so many, or every n-th power of ten.
fn thinned(list: &dyn Fn(&[i64]) -> Vec<f64>, most: usize) -> Vec<f64> {
    let lists = [list(&[1, 2, 5]), list(&[1, 3]), list(&[1])];
    let coarse = lists[2].clone();
    let stride = coarse.len().div_ceil(most);
    let fine = lists.into_iter().find(|list| list.len() <= most);
    fine.unwrap_or_else(|| coarse.into_iter().step_by(stride).collect())
}

/// The decades of both signs beyond the linear part, and zero.
fn both_signs(norm: &Normalization, digits: &[i64]) -> Vec<f64> {
    let (min, max, least) = (norm.min(), norm.max(), norm.threshold());
    let negative = decades([least, -min], digits).into_iter().rev().map(|v| -v);
    let zero = [0.0].into_iter().filter(|_| min < 0.0 && max > 0.0);
    negative.chain(zero).chain(decades([least, max], digits)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_render::range::RangeChoice;
    use ppum_render::raster::Raster;

    fn norm(scale: Scale, min: f64, max: f64) -> Normalization {
        let empty = Raster::<f64>::new([0, 0], vec![]);
        RangeChoice::Fixed(min, max)
            .span(scale, false, &empty, None)
            .normalization(scale)
            .expect("a range")
    }

    #[test]
    fn linear_levels_are_round_and_inside() {
        assert_eq!(
            automatic(&norm(Scale::Linear, 0.0, 1.0), 10),
            [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9]
        );
        assert_eq!(automatic(&norm(Scale::Linear, -3.7, 8.2), 6), [-2.0, 0.0, 2.0, 4.0, 6.0, 8.0]);
        assert_eq!(automatic(&norm(Scale::Linear, 1e-13, 3.1e-13), 2), [2e-13, 3e-13]);
        for k in 0..400 {
            let (min, span) =
                ((f64::from(k) * 0.77).sin() * 5.0, (f64::from(k) * 0.31).exp() * 1e-9);
            for most in [1, 2, 5, 10, 23] {
                let found = automatic(&norm(Scale::Linear, min, min + span), most);
                assert!(found.len() <= most && found.iter().all(|&v| v > min && v < min + span));
                assert!(most < 5 || 3 * found.len() >= most, "{min} {span} {most}: {found:?}");
            }
        }
    }

    #[test]
    fn as_many_as_round_steps_allow() {
        let signed = norm(Scale::Linear, -0.747, 0.747);
        assert_eq!(about(&signed, 12).len(), 15);
        assert_eq!(about(&signed, 7).len(), 7);
        for count in 1..100 {
            let found = about(&signed, count).len() as f64 / count as f64;
            // steps are 2 or 2.5 times each other
            assert!((0.6..1.6).contains(&found), "{count}: {found}");
        }
        assert_eq!(about(&norm(Scale::Log, 5e-4, 2e3), 6).len(), 7);
        assert!(about(&signed, 0).is_empty());
    }

    #[test]
    fn levels_of_other_scales() {
        let log = norm(Scale::Log, 0.3, 4e4);
        assert_eq!(automatic(&log, 6), [1.0, 10.0, 100.0, 1e3, 1e4]);
        assert_eq!(automatic(&log, 3), [1.0, 100.0, 1e4]);
        assert_eq!(automatic(&norm(Scale::Log, 0.3, 30.0), 9), [0.5, 1.0, 2.0, 5.0, 10.0, 20.0]);
        let sym = norm(Scale::SymLog, -150.0, 150.0);
        let found = automatic(&sym, 40);
        assert!(
            found.contains(&0.0) && found.contains(&-100.0) && found.contains(&100.0),
            "{found:?}"
        );
        assert!(found.windows(2).all(|w| w[0] < w[1]));
    }

    #[test]
    fn counted_levels_divide_the_range() {
        assert_eq!(counted(&norm(Scale::Linear, 0.0, 4.0), 3), [1.0, 2.0, 3.0]);
        let log = counted(&norm(Scale::Log, 1.0, 1e4), 3);
        assert!(log.iter().zip([10.0, 100.0, 1e3]).all(|(a, b)| (a / b - 1.0).abs() < 1e-12));
        assert!(counted(&norm(Scale::Linear, 0.0, 4.0), 0).is_empty());
    }
}
