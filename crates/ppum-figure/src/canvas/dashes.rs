//! Dashes along lines.

use ppum::vec2::Vec2;

/// The dashes of a line: polylines of one length with gaps of another between them, the first at
/// its start.
pub(super) fn dashes(points: &[Vec2], [dash, gap]: [f64; 2]) -> Vec<Vec<Vec2>> {
    let (mut all, mut is_dash, mut left) = (Vec::new(), true, dash);
    let mut current: Vec<Vec2> = points.first().copied().into_iter().collect();
    for ends in points.windows(2) {
        let (length, unit) = ((ends[1] - ends[0]).length(), (ends[1] - ends[0]).unit());
        let mut done = 0.0;
        while length - done > left {
            done += left;
            current.push(ends[0] + unit * done);
            if is_dash {
                all.push(std::mem::take(&mut current));
            } else {
                current = vec![ends[0] + unit * done];
            }
            is_dash = !is_dash;
            left = if is_dash { dash } else { gap };
        }
        left -= length - done;
        current.push(ends[1]);
    }
    if is_dash && current.len() > 1 {
        all.push(current);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    #[test]
    fn dashes_run_around_corners() {
        let line = [vec2(0.0, 0.0), vec2(3.0, 0.0), vec2(3.0, 4.0)];
        let found = dashes(&line, [2.0, 0.5]);
        let expected = [
            vec![vec2(0.0, 0.0), vec2(2.0, 0.0)],
            vec![vec2(2.5, 0.0), vec2(3.0, 0.0), vec2(3.0, 1.5)],
            vec![vec2(3.0, 2.0), vec2(3.0, 4.0)],
        ];
        assert_eq!(found, expected);
        assert_eq!(dashes(&line, [100.0, 1.0]), [line.to_vec()]);
        assert!(dashes(&[], [1.0, 1.0]).is_empty());
    }
}
