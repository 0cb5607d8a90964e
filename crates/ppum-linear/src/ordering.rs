//! Orders of elimination that keep a factor small.

use super::neighbours::Neighbours;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMat;
use faer::sparse::linalg::amd;

/// The blocks by approximate minimum degree: always one next that is coupled to few.
pub(super) fn minimum_degree_order(neighbours: &Neighbours) -> Vec<u32> {
    let n = neighbours.len();
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for i in 0..n {
        let row = neighbours.of(i).iter().map(|entry| entry.column as usize);
        rows.extend(row.filter(|&j| j >= i));
        starts.push(rows.len());
    }
    let mut buffer = MemBuffer::new(amd::order_scratch::<usize>(n, rows.len()));
    let lower = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
    let (mut order, mut places) = (vec![0; n], vec![0; n]);
    let stack = MemStack::new(&mut buffer);
    let done = amd::order(&mut order, &mut places, lower.as_ref(), Default::default(), stack);
    match done {
        Ok(_) => order.into_iter().map(|block| block as u32).collect(),
        Err(_) => (0..n as u32).collect(),
    }
}
