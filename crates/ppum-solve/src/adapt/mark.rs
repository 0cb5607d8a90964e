//! The cells that make up most of an error.

/// Indicators that differ by no more than this part are equal: a symmetric body stays symmetric.
const SAME: f64 = 1e-6;

/// The fewest cells that make up a part of the sum of the squares η_j² (Dörfler 1996), and all that
/// are as large as the smallest of them, ascending.
pub fn mark(squares: &[f64], fraction: f64) -> Vec<usize> {
    let mut order: Vec<usize> = (0..squares.len()).collect();
    order.sort_by(|&a, &b| squares[b].total_cmp(&squares[a]).then(a.cmp(&b)));
    let wanted = fraction * squares.iter().sum::<f64>();
    let (mut sum, mut least) = (0.0, f64::INFINITY);
    let mut marked: Vec<usize> = order
        .into_iter()
        .take_while(|&cell| {
            let square = squares[cell];
            let is_in = square > 0.0 && (sum < wanted || square >= least * (1.0 - SAME));
            if is_in && sum < wanted {
                (sum, least) = (sum + square, square);
            }
            is_in
        })
        .collect();
    marked.sort_unstable();
    marked
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// Against all subsets of a few cells: none with fewer of them makes up the part.
    #[test]
    fn no_fewer_cells_would_do() {
        let mut random = Random(7);
        for _ in 0..50 {
            let squares: Vec<f64> = (0..8).map(|_| random.between(0.0, 1.0).powi(3)).collect();
            let fraction = random.between(0.1, 0.95);
            let marked = mark(&squares, fraction);
            let wanted = fraction * squares.iter().sum::<f64>();
            let of =
                |set: u32| (0..8).filter(|k| set >> k & 1 == 1).map(|k| squares[k]).sum::<f64>();
            let enough = (0u32..256).filter(|&set| of(set) >= wanted);
            let fewest = enough.map(u32::count_ones).min().expect("all cells are enough");
            assert_eq!(marked.len(), fewest as usize, "{squares:?}");
            assert!(marked.iter().map(|&k| squares[k]).sum::<f64>() >= wanted);
        }
    }

    /// Four cells of a symmetric body are marked together, whatever the last digits say.
    #[test]
    fn equal_cells_are_marked_together() {
        let squares = [0.1, 1.0, 1.0 + 1e-12, 0.2, 1.0 - 1e-12, 1.0];
        assert_eq!(mark(&squares, 0.3), [1, 2, 4, 5]);
        assert_eq!(mark(&[0.0; 3], 0.5), [] as [usize; 0]);
    }
}
