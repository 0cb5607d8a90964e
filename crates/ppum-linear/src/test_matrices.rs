//! Matrices for the tests of solvers.

use super::{BlockMatrix, BlockPattern};
use faer::Mat;
use ppum_testkit::random::Random;

/// n × m blocks of one to three unknowns, each coupled to its eight neighbours, with a
/// dominant diagonal.
pub(crate) fn grid_matrix(n: usize, m: usize, random: &mut Random) -> BlockMatrix {
    let (mut starts, mut columns) = (vec![0], Vec::new());
    for (y, x) in (0..m).flat_map(|y| (0..n).map(move |x| (y, x))) {
        let right = [(0, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];
        for (dx, dy) in right {
            let (x, y) = (x as i32 + dx, y as i32 + dy);
            if (0..n as i32).contains(&x) && (0..m as i32).contains(&y) {
                columns.push((y * n as i32 + x) as u32);
            }
        }
        starts.push(columns.len());
    }
    let sizes: Vec<usize> = (0..n * m).map(|k| 1 + k % 3).collect();
    let mut matrix = BlockMatrix::new(&sizes, BlockPattern::new(starts, columns));
    let pairs: Vec<_> = matrix.pattern().pairs().collect();
    for (i, j) in pairs {
        let off = Mat::from_fn(sizes[i], sizes[j], |_, _| random.between(-1.0, 1.0));
        let block = match i == j {
            true => {
                &off + off.transpose()
                    + Mat::<f64>::identity(sizes[i], sizes[i]) * faer::Scale(30.0)
            }
            false => off,
        };
        matrix.add_block(i, j, block.as_ref());
    }
    matrix
}
