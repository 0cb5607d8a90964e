//! Reduces curves to the points that pixels can distinguish.

use ppum::vec2::Vec2;

/// Columns per pixel in which points are distinguished, since vector pages may be enlarged.
const PER_PIXEL: f64 = 4.0;

/// The points of a line. For each run of points within one column, only the first, last, highest
/// and lowest are kept: the line looks the same, peaks included.
pub(super) fn thinned(points: impl Iterator<Item = Vec2>) -> Vec<Vec2> {
    let mut kept = Vec::new();
    let mut run: Option<ColumnRun> = None;
    for (index, point) in points.enumerate() {
        let column = (PER_PIXEL * point.x).floor();
        match &mut run {
            Some(run) if run.column == column => run.add(index, point),
            _ => {
                run.replace(ColumnRun::new(index, point, column))
                    .iter()
                    .for_each(|r| r.put(&mut kept));
            }
        }
    }
    run.iter().for_each(|run| run.put(&mut kept));
    kept
}

/// Consecutive points in one column, with their numbers.
struct ColumnRun {
    column: f64,
    first: (usize, Vec2),
    lowest: (usize, Vec2),
    highest: (usize, Vec2),
    last: (usize, Vec2),
}

impl ColumnRun {
    fn new(index: usize, point: Vec2, column: f64) -> Self {
        let only = (index, point);
        Self { column, first: only, lowest: only, highest: only, last: only }
    }

    fn add(&mut self, index: usize, point: Vec2) {
        self.last = (index, point);
        if point.y < self.lowest.1.y {
            self.lowest = self.last;
        }
        if point.y > self.highest.1.y {
            self.highest = self.last;
        }
    }

    /// Appends the points to keep, in order and each once.
    fn put(&self, kept: &mut Vec<Vec2>) {
        let mut all = [self.first, self.lowest, self.highest, self.last];
        all.sort_by_key(|(index, _)| *index);
        let mut last = None;
        for (index, point) in all {
            if last.replace(index) != Some(index) {
                kept.push(point);
            }
        }
    }
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
