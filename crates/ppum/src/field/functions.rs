//! The functions of a step at one point, each group evaluated once.

use std::collections::BTreeMap;

use crate::crack::Side;
use crate::function::{GROUP, LocalFunctions, Slot};
use crate::jet::Jet;
use ppum_formula::real::Real;

/// Groups that have a place of their own, more than meet in the patches of one point in practice.
const PLACES: usize = 6;

/// The functions at one point: a group is evaluated when it is first asked for, and once.
pub(super) struct FunctionJets<'a, 'f, R> {
    functions: &'a LocalFunctions<'f>,
    offset: [R; 2],
    side: Side,
    groups: [u32; PLACES],
    jets: [[Jet<R>; GROUP]; PLACES],
    next: usize,
    /// Groups that have lost their places to others.
    others: BTreeMap<u32, [Jet<R>; GROUP]>,
}

impl<'a, 'f, R: Real> FunctionJets<'a, 'f, R> {
    #[inline(always)]
    pub(super) fn new(functions: &'a LocalFunctions<'f>, offset: [R; 2], side: Side) -> Self {
        let zero = Jet::constant(offset[0].broadcast(0.0));
        let (groups, jets) = ([u32::MAX; PLACES], [[zero; GROUP]; PLACES]);
        Self { functions, offset, side, groups, jets, next: 0, others: BTreeMap::new() }
    }

    #[inline(always)]
    pub(super) fn jet<const D: usize>(&mut self, slot: Slot) -> Jet<R> {
        let Slot::Jet { group, entry } = slot else {
            return Jet::constant(self.offset[0].broadcast(1.0));
        };
        let mut place = 0;
        while place < PLACES && self.groups[place] != group {
            place += 1;
        }
        if place == PLACES {
            place = self.next;
            self.next = (self.next + 1) % PLACES;
            if self.groups[place] != u32::MAX {
                self.others.insert(self.groups[place], self.jets[place]);
            }
            self.groups[place] = group;
            let jets = &mut self.jets[place];
            match self.others.get(&group) {
                Some(known) => *jets = *known,
                None => {
                    self.functions.evaluate::<R, D>(group as usize, self.offset, self.side, jets);
                }
            }
        }
        self.jets[place][entry as usize]
    }
}
