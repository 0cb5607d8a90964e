//! The order in which the blocks of a symmetric matrix are eliminated, and the tree that it makes
//! of them.
//!
//! Blocks that are eliminated together are the *pivots* of a front; the later blocks that they
//! couple are *below* them. The contribution block of a front goes to its parent, the front of the
//! first block below. So fronts of different subtrees know nothing of each other, and each front is
//! a dense matrix. Columns of blocks are joined to fronts with more zeros in them where that is
//! faster than to take them one after the other.

use super::block_matrix::{BlockPattern, running_sum};
use super::front::{Front, runs};
use super::neighbours::Neighbours;
use super::ordering::minimum_degree_order;
use std::cmp::Reverse;
use std::ops::Range;

/// The cost of a value of a front in operations, to write, read and add it to the parent's.
const TRAFFIC: f64 = 12.0;

/// The cost of a front in operations, however small it is.
const FRONT: f64 = 1e5;

/// Subtrees with at most this part of all work are done by one thread. Enough of them that threads
/// are busy until the end, and few fronts that are left: these are divided among threads.
const SUBTREE: f64 = 1.0 / 32.0;

/// An order of elimination with its tree.
#[derive(Debug)]
pub(super) struct Elimination {
    /// The blocks in their order.
    pub(super) order: Vec<u32>,
    /// The position of each block in the order.
    pub(super) places: Vec<u32>,
    /// The first unknown of each place, and their number.
    pub(super) offsets: Vec<usize>,
    /// The fronts in the order of their pivots, children before parents.
    pub(super) fronts: Vec<Front>,
    /// Subtrees of fronts; what is left of the fronts comes behind them all.
    pub(super) subtrees: Vec<Range<usize>>,
    /// Values of the factor.
    pub(super) fill: f64,
}

/// The number of values in the factor of a matrix with `sizes[i]` unknowns in block i.
pub fn fill(pattern: &BlockPattern, sizes: &[usize]) -> f64 {
    Elimination::new(&Neighbours::new(pattern), sizes).fill
}

impl Elimination {
    /// The elimination of a matrix with `sizes[i]` unknowns in block i.
    pub(super) fn new(neighbours: &Neighbours, sizes: &[usize]) -> Self {
        let ranked = minimum_degree_order(neighbours);
        let symbolic = symbolic(neighbours, sizes, &ranked);
        let (sequence, subtrees) = sequence(&symbolic);
        let pivots = sequence.iter().flat_map(|&number| &symbolic[number].pivots);
        let order: Vec<u32> = pivots.map(|&rank| ranked[rank as usize]).collect();
        let places = inverse(order.iter().map(|&block| block as usize), order.len());
        let numbers = inverse(sequence.iter().copied(), symbolic.len());
        let offsets = running_sum(order.iter().map(|&block| sizes[block as usize]));
        let front = |&number: &usize| {
            let SymbolicFront { pivots, below, children, .. } = &symbolic[number];
            let place = |&rank: &u32| places[ranked[rank as usize] as usize];
            let first = pivots.first().map_or(0, |rank| place(rank) as usize);
            let mut below: Vec<u32> = below.iter().map(place).collect();
            below.sort_unstable();
            let children = children.iter().map(|&child| numbers[child] as usize).collect();
            Front::new(first..first + pivots.len(), below, children, &offsets)
        };
        let mut fronts: Vec<Front> = sequence.iter().map(front).collect();
        for parent in 0..fronts.len() {
            for child in fronts[parent].children.clone() {
                fronts[child].runs = runs(&fronts[child], &fronts[parent]);
            }
        }
        let fill = sequence.iter().map(|&number| symbolic[number].shape.values()).sum();
        Self { order, places, offsets, fronts, subtrees, fill }
    }

    /// The unknowns of the pivots of some fronts, counted in the order of elimination.
    pub(super) fn unknowns(&self, fronts: Range<usize>) -> Range<usize> {
        let fronts = &self.fronts[fronts];
        let ends = fronts.first().zip(fronts.last());
        ends.map_or(0..0, |(a, b)| self.offsets[a.pivots.start]..self.offsets[b.pivots.end])
    }

    /// The fronts in no subtree.
    pub(super) fn top(&self) -> Range<usize> {
        self.subtrees.last().map_or(0, |last| last.end)..self.fronts.len()
    }
}

/// The place of each number below `n` in a list of them.
fn inverse(list: impl Iterator<Item = usize>, n: usize) -> Vec<u32> {
    let mut places = vec![0; n];
    (0..).zip(list).for_each(|(place, number)| places[number] = place);
    places
}

/// The unknowns of a front: its pivots and those below them.
#[derive(Clone, Copy, Debug, Default)]
struct FrontSize {
    pivots: f64,
    below: f64,
}

impl FrontSize {
    fn all(self) -> f64 {
        self.pivots + self.below
    }

    /// Values of its part of the factor.
    fn values(self) -> f64 {
        self.pivots * (0.5 * (self.pivots + 1.0) + self.below)
    }

    /// Multiplications and additions: the squares of the lengths of its columns.
    fn operations(self) -> f64 {
        let sum = |n: f64| n * (n + 1.0) * (2.0 * n + 1.0) / 6.0;
        sum(self.all()) - sum(self.below)
    }

    fn cost(self) -> f64 {
        self.operations() + TRAFFIC * self.all() * self.all() + FRONT
    }
}

/// A front while blocks have ranks only, not the places of the last order.
#[derive(Debug, Default)]
struct SymbolicFront {
    /// Empty once they belong to another front.
    pivots: Vec<u32>,
    below: Vec<u32>,
    children: Vec<usize>,
    shape: FrontSize,
}

/// The fronts of a ranking, each with the number of its last pivot.
fn symbolic(neighbours: &Neighbours, sizes: &[usize], ranked: &[u32]) -> Vec<SymbolicFront> {
    let n = ranked.len();
    let ranks = inverse(ranked.iter().map(|&block| block as usize), n);
    let size = |rank: u32| sizes[ranked[rank as usize] as usize] as f64;
    let mut symbolic: Vec<SymbolicFront> = Vec::with_capacity(n);
    let mut waiting: Vec<Vec<usize>> = vec![Vec::new(); n];
    let mut seen = vec![u32::MAX; n];
    for (k, &block) in (0..n as u32).zip(ranked) {
        let children = std::mem::take(&mut waiting[k as usize]);
        let own = neighbours.of(block as usize).iter().map(|entry| ranks[entry.column as usize]);
        let inherited = children.iter().flat_map(|&child| symbolic[child].below.iter().copied());
        let mut below = Vec::new();
        for rank in own.chain(inherited).filter(|&rank| rank > k) {
            if std::mem::replace(&mut seen[rank as usize], k) != k {
                below.push(rank);
            }
        }
        below.sort_unstable();
        if let Some(&parent) = below.first() {
            waiting[parent as usize].push(k as usize);
        }
        let shape =
            FrontSize { pivots: size(k), below: below.iter().map(|&rank| size(rank)).sum() };
        let front = SymbolicFront { pivots: vec![k], below, children: Vec::new(), shape };
        let front = front.with_children(children, &mut symbolic);
        symbolic.push(front);
    }
    symbolic
}

impl SymbolicFront {
    /// Takes children, and the pivots of those with which it is faster to be one front.
    fn with_children(mut self, mut children: Vec<usize>, symbolic: &mut [Self]) -> Self {
        children.sort_by_key(|&child| Reverse(symbolic[child].pivots.len()));
        for number in children {
            let child = &mut symbolic[number];
            let joined = FrontSize { pivots: self.shape.pivots + child.shape.pivots, ..self.shape };
            if joined.cost() > self.shape.cost() + child.shape.cost() {
                self.children.push(number);
                continue;
            }
            let child = std::mem::take(child);
            let own = std::mem::replace(&mut self.pivots, child.pivots);
            self.pivots.extend(own);
            self.children.extend(child.children);
            self.shape = joined;
        }
        self
    }
}

/// The fronts, children before parents: those of subtrees of little work, subtree by subtree, and
/// then all others.
fn sequence(symbolic: &[SymbolicFront]) -> (Vec<usize>, Vec<Range<usize>>) {
    let fronts = || (0..symbolic.len()).filter(|&number| !symbolic[number].pivots.is_empty());
    let (mut work, mut parents) = (vec![0.0; symbolic.len()], vec![None; symbolic.len()]);
    for number in fronts() {
        work[number] += symbolic[number].shape.cost();
        for &child in &symbolic[number].children {
            work[number] += work[child];
            parents[child] = Some(number);
        }
    }
    let all: f64 = fronts().map(|number| symbolic[number].shape.cost()).sum();
    let is_small = |number: usize| work[number] <= SUBTREE * all;
    let is_root = |number: &usize| {
        is_small(*number) && parents[*number].is_none_or(|parent| !is_small(parent))
    };
    let (mut sequence, mut subtrees) = (Vec::new(), Vec::new());
    for root in fronts().filter(is_root) {
        let first = sequence.len();
        // parents first, and turned round
        let mut open = vec![root];
        while let Some(number) = open.pop() {
            sequence.push(number);
            open.extend(&symbolic[number].children);
        }
        sequence[first..].reverse();
        subtrees.push(first..sequence.len());
    }
    sequence.extend(fronts().filter(|&number| !is_small(number)));
    (sequence, subtrees)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::test_matrices::grid_matrix;
    use ppum_testkit::random::Random;

    /// The rows below a front are in its parent, where its runs say.
    #[test]
    fn fronts_hand_on_to_their_parents() {
        let matrix = grid_matrix(23, 17, &mut Random(3));
        let sizes: Vec<_> = (0..matrix.n_blocks()).map(|i| matrix.unknowns(i).len()).collect();
        let tree = Elimination::new(&Neighbours::new(matrix.pattern()), &sizes);
        let mut order = tree.order.clone();
        order.sort_unstable();
        assert!(order.into_iter().eq(0..sizes.len() as u32), "each block once");
        assert!(tree.subtrees.len() > 4, "{}", tree.subtrees.len());
        let mut has_parent = vec![false; tree.fronts.len()];
        for (number, front) in tree.fronts.iter().enumerate() {
            for &number_of_child in &front.children {
                assert!(number_of_child < number);
                has_parent[number_of_child] = true;
                let child = &tree.fronts[number_of_child];
                let starts = &child.starts[child.pivots.len()..];
                for (row, &place) in starts.iter().zip(&child.below) {
                    let below = row - child.n_pivots();
                    let run = child.runs.iter().find(|run| (run.from..run.end()).contains(&below));
                    let run = run.expect("a run for each row");
                    let local = front.local(place as usize);
                    assert_eq!(run.to + below - run.from, front.starts[local]);
                    let mut places =
                        front.pivots.clone().chain(front.below.iter().map(|&p| p as usize));
                    assert_eq!(places.nth(local), Some(place as usize));
                }
            }
        }
        let roots = tree.fronts.iter().zip(has_parent).filter(|(_, has_parent)| !has_parent);
        assert!(roots.into_iter().all(|(front, _)| front.below.is_empty()));
    }

    /// Neighbours meet in a front: the later one is below the earlier one, or both are pivots.
    #[test]
    fn neighbours_meet_in_a_front() {
        let matrix = grid_matrix(14, 14, &mut Random(8));
        let sizes: Vec<_> = (0..matrix.n_blocks()).map(|i| matrix.unknowns(i).len()).collect();
        let neighbours = Neighbours::new(matrix.pattern());
        let tree = Elimination::new(&neighbours, &sizes);
        for (i, front) in tree
            .fronts
            .iter()
            .flat_map(|front| front.pivots.clone().map(move |place| (place, front)))
        {
            for entry in neighbours.of(tree.order[i] as usize) {
                let other = tree.places[entry.column as usize];
                let is_there = front.pivots.contains(&(other as usize))
                    || front.below.binary_search(&other).is_ok();
                assert!(is_there || (other as usize) < i);
            }
        }
    }
}
