//! Reduces curves to the points that pixels can distinguish.

use ppum::vec2::Vec2;

/// Columns per pixel in which points are distinguished, since vector pages may be enlarged.
const PER_PIXEL: f64 = 4.0;

/// The points of a line. For each run of points within one column, only the first, last, highest
/// and lowest are kept: the line looks the same, peaks included.
pub(super) fn thinned(points: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let points: Vec<Vec2> = points.collect();
    let column = |p: &Vec2| (PER_PIXEL * p.x).floor();
    points.chunk_by(|a, b| column(a) == column(b)).flat_map(outermost).collect()
}

/// The first, lowest, highest and last of some points, in order and each once.
fn outermost(run: &[Vec2]) -> Vec<Vec2> {
    let (mut lowest, mut highest) = (0, 0);
    for (k, point) in run.iter().enumerate() {
        lowest = if point.y < run[lowest].y { k } else { lowest };
        highest = if point.y > run[highest].y { k } else { highest };
    }
    let mut kept = vec![0, lowest, highest, run.len() - 1];
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|k| run[k]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    /// Few points stay as they are; of many each column keeps its least and greatest height, and
    /// its ends.
    #[test]
    fn peaks_stay() {
        let few: Vec<_> = (0..50).map(|k| vec2(f64::from(k), f64::from(k * k % 17))).collect();
        assert_eq!(thinned(few.iter().copied()), few);
        let height = |k: u32| 100.0 * (f64::from(k) * 12.9898).sin() * 43758.5453 % 1.0;
        let many: Vec<_> = (0..100_000).map(|k| vec2(f64::from(k) * 1e-3, height(k))).collect();
        let kept = thinned(many.iter().copied());
        assert!(kept.len() <= 4 * 401, "{}", kept.len());
        assert_eq!((kept[0], kept[kept.len() - 1]), (many[0], many[many.len() - 1]));
        assert!(kept.windows(2).all(|pair| pair[0].x < pair[1].x));
        for column in 0..100 {
            let is_in = |p: &&Vec2| p.x.floor() == f64::from(column);
            let ends = |points: &[Vec2]| {
                let heights = || points.iter().filter(is_in).map(|p| p.y);
                [heights().fold(f64::MAX, f64::min), heights().fold(f64::MIN, f64::max)]
            };
            assert_eq!(ends(&many), ends(&kept), "{column}");
        }
    }
}
