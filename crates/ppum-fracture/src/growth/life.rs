//! The life of cracks: cycles, and what tips grow in them, by a law of growth.
//!
//! All tips share the cycles. Along an increment of the fastest one, of the length h, let λ run
//! from 0 to 1. Then, with the factors K_j(λ) of the tips on the way,
//!
//! ```text
//! dN/dλ = h / rate(K_f(λ))      da_j/dλ = rate(K_j(λ)) dN/dλ
//! ```
//!
//! which Gauss's rule integrates piece by piece; pieces end with blocks of loads. ln K is the
//! polynomial in the logarithm of the crack's length through up to four steps around the increment,
//! so that powers of the length are exact. With each step the last increments are integrated again,
//! as one more step behind them is known. Behind overloads the reach of the largest plastic zone is
//! a state of each tip (Wheeler 1972).
//!
//! Everything follows from the steps so far, so that a series that goes on has the same bits.

use ppum::crack::TipId;
use ppum::text::{short, trimmed};
use ppum_problem::{GrowthLaw, LoadBlock, TipState, WrongRate};
use std::collections::BTreeMap;

/// Points and weights of Gauss's rule on 0 to 1.
const GAUSS: [[f64; 2]; 3] = [
    [0.112_701_665_379_258_3, 5.0 / 18.0],
    [0.5, 8.0 / 18.0],
    [0.887_298_334_620_741_7, 5.0 / 18.0],
];

/// Largest piece of an increment, and of the way that is left in the zone of an overload.
const PIECE: f64 = 0.125;
const OF_ZONE: f64 = 0.25;

/// Most pieces of an increment.
const MOST_PIECES: usize = 1_000_000;

/// Part of a zone that is rounding.
const ROUNDING: f64 = 1e-9;

/// Steps that a polynomial of ln K goes through, and those of one that is continued.
const STENCIL: usize = 4;
const CONTINUED: usize = 2;

/// Rounds in which the part of a piece is found that a block leaves, and what may be left of it.
const ROUNDS: usize = 30;
const LEFT: f64 = 1e-12;

/// The reasons why a law of growth gives no life.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LifeError {
    /// A rate that is none.
    #[error(
        "the rate of growth is {rate} at the tip ({x}, {y}), with ΔK = {range}, but must be finite and not negative: \
         mend the formula `rate`",
        rate = short(.0.rate), x = trimmed(.0.at.x), y = trimmed(.0.at.y), range = short(.0.range)
    )]
    Rate(WrongRate),
    /// Loads that change too often.
    #[error(
        "an increment takes more than {0} blocks of `cycles`: write longer blocks, or a smaller `increment`"
    )]
    Blocks(usize),
}

/// A solved step: the lengths of its cracks, its tips, and what these grow from it.
#[derive(Clone, Debug, Default)]
pub(super) struct LifeStep {
    pub(super) lengths: Vec<f64>,
    pub(super) tips: BTreeMap<TipId, TipState>,
    pub(super) increments: BTreeMap<TipId, f64>,
}

/// The life up to a step.
#[derive(Clone, Debug, Default)]
struct LifeState {
    cycles: f64,
    /// The block of loads, and how many of its cycles are over.
    block: usize,
    over: f64,
    tips: BTreeMap<TipId, TipLife>,
}

/// The growth of a tip by the law, and the reach of the largest plastic zone before it, from where
/// the tip was in the first step.
#[derive(Clone, Copy, Debug, Default)]
struct TipLife {
    growth: f64,
    reach: f64,
}

/// The life of the cracks of a series.
#[derive(Debug, Default)]
pub(super) struct Life {
    steps: Vec<LifeStep>,
    states: Vec<LifeState>,
}

impl Life {
    /// Adds a step, with the increments that led to it.
    pub(super) fn add(
        &mut self,
        law: &GrowthLaw,
        step: LifeStep,
        increments: BTreeMap<TipId, f64>,
    ) -> Result<(), LifeError> {
        if let Some(last) = self.steps.last_mut() {
            last.increments = increments;
        }
        self.steps.push(step);
        let last = self.steps.len() - 1;
        self.states.resize_with(last + 1, LifeState::default);
        for from in last.saturating_sub(STENCIL - 2)..last {
            let first = from.saturating_sub(1);
            let around = &self.steps[first..(first + STENCIL).min(last + 1)];
            self.states[from + 1] = advance(law, around, from - first, &self.states[from])?;
        }
        Ok(())
    }

    /// Cycles up to the last step.
    pub(super) fn cycles(&self) -> f64 {
        self.states.last().map_or(0.0, |state| state.cycles)
    }

    /// The length that a tip has grown by the law up to the last step.
    pub(super) fn growth(&self, tip: TipId) -> f64 {
        let state = self.states.last().and_then(|state| state.tips.get(&tip));
        state.map_or(0.0, |tip| tip.growth)
    }

    /// The logarithms of the tips' mean rates in the last step.
    pub(super) fn ln_rates(&self, law: &GrowthLaw) -> Result<BTreeMap<TipId, f64>, LifeError> {
        let (Some(step), Some(state)) = (self.steps.last(), self.states.last()) else {
            return Ok(BTreeMap::new());
        };
        let rate = |(tip, row): (&TipId, &TipState)| Ok((*tip, mean_rate(law, row, state, *tip)?));
        step.tips.iter().map(rate).collect()
    }

    /// The growth of the tips in the cycles in which the fastest one grows by an increment, as far
    /// as it can be told before these are solved.
    pub(super) fn forecast(
        &self,
        law: &GrowthLaw,
        increments: BTreeMap<TipId, f64>,
    ) -> Result<BTreeMap<TipId, f64>, LifeError> {
        let (Some(last), Some(state)) = (self.steps.last(), self.states.last()) else {
            return Ok(increments);
        };
        let mut steps = self.steps[self.steps.len().saturating_sub(CONTINUED)..].to_vec();
        let mut lengths = last.lengths.clone();
        increments.iter().for_each(|(tip, length)| lengths[tip.crack as usize] += length);
        let at = steps.len() - 1;
        steps[at].increments = increments;
        steps.push(LifeStep { lengths, ..LifeStep::default() });
        let after = advance(law, &steps, at, state)?;
        let before = |tip| state.tips.get(tip).map_or(0.0, |tip| tip.growth);
        Ok(after.tips.iter().map(|(tip, row)| (*tip, row.growth - before(tip))).collect())
    }
}

/// The logarithm of a tip's mean rate over all blocks of loads.
fn mean_rate(
    law: &GrowthLaw,
    tip: &TipState,
    state: &LifeState,
    id: TipId,
) -> Result<f64, LifeError> {
    let life = state.tips.get(&id).copied().unwrap_or_default();
    let tip = TipState { extension: life.growth, ..*tip };
    let rate = |block: &LoadBlock| ln_rate(law, block, &tip, state.cycles, life);
    if let [block] = &law.blocks[..] {
        return rate(block);
    }
    let rates = law.blocks.iter().map(rate).collect::<Result<Vec<_>, _>>()?;
    let most = rates.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if most.is_infinite() {
        return Ok(most);
    }
    let parts =
        law.blocks.iter().zip(&rates).map(|(block, rate)| block.cycles * (rate - most).exp());
    let all: f64 = law.blocks.iter().map(|block| block.cycles).sum();
    Ok(most + (parts.sum::<f64>() / all).ln())
}

/// The logarithm of a tip's rate in a block, retarded by what was before.
fn ln_rate(
    law: &GrowthLaw,
    block: &LoadBlock,
    tip: &TipState,
    cycles: f64,
    life: TipLife,
) -> Result<f64, LifeError> {
    let rate = law.ln_rate(block, tip, cycles).map_err(LifeError::Rate)?;
    let Some(wheeler) = law.wheeler else { return Ok(rate) };
    let zone = wheeler.zone(block.max * tip.strength);
    let left = life.reach - tip.extension;
    Ok(if zone < left { rate + wheeler.exponent * (zone / left).ln() } else { rate })
}

/// The life behind the increment from one of some steps to the next.
fn advance(
    law: &GrowthLaw,
    steps: &[LifeStep],
    from: usize,
    state: &LifeState,
) -> Result<LifeState, LifeError> {
    let step = &steps[from];
    let mut fastest = None;
    for (id, length) in step.increments.iter().filter(|(_, length)| **length > 0.0) {
        let Some(tip) = step.tips.get(id) else { continue };
        let rate = mean_rate(law, tip, state, *id)?;
        if fastest.is_none_or(|(_, _, most)| rate > most) {
            fastest = Some((*id, *length, rate));
        }
    }
    let Some((fastest, length, _)) = fastest else { return Ok(state.clone()) };
    let mut state = state.clone();
    for id in step.tips.keys() {
        state.tips.entry(*id).or_default();
    }
    IncrementPath { law, steps, from, fastest, length }.integrate(state)
}

/// The way from one step to the next.
struct IncrementPath<'a> {
    law: &'a GrowthLaw,
    steps: &'a [LifeStep],
    from: usize,
    fastest: TipId,
    /// The increment of the fastest tip.
    length: f64,
}

/// A piece of the way: cycles, and growth of the tips.
struct PieceLife {
    cycles: f64,
    growth: BTreeMap<TipId, f64>,
}

impl IncrementPath<'_> {
    fn integrate(&self, mut state: LifeState) -> Result<LifeState, LifeError> {
        let (mut at, mut idle) = (0.0, 0);
        let blocks = &self.law.blocks;
        for _ in 0..MOST_PIECES {
            let block = &blocks[state.block];
            let rates = self.rates(at, block, &state)?;
            if rates.get(&self.fastest).is_none_or(|rate| *rate == f64::NEG_INFINITY) {
                idle += 1;
                if idle > blocks.len() || block.cycles.is_infinite() {
                    // the tip has stopped on the way
                    return Ok(state);
                }
                state.cycles += block.cycles - state.over;
                next_block(&mut state, blocks);
                continue;
            }
            idle = 0;
            let most = (1.0 - at).min(self.largest_piece(at, &rates, &state));
            let (part, piece) = self.piece(at, most, &rates, &state)?;
            at += part;
            self.take(at, piece, &mut state);
            if at >= 1.0 - f64::EPSILON {
                return Ok(state);
            }
        }
        Err(LifeError::Blocks(MOST_PIECES))
    }

    /// The largest piece along which rates are smooth.
    fn largest_piece(&self, at: f64, rates: &BTreeMap<TipId, f64>, state: &LifeState) -> f64 {
        let most = rates[&self.fastest];
        let in_zone = rates.iter().filter_map(|(id, rate)| {
            let life = state.tips.get(id)?;
            let left = life.reach - life.growth;
            let speed = growth_ratio(*rate, most) * self.length;
            let is_retarded = self.zone(*id, at, state)? < left * (1.0 - ROUNDING);
            (is_retarded && speed > 0.0).then(|| OF_ZONE * left / speed)
        });
        in_zone.fold(PIECE, f64::min)
    }

    /// The plastic zone of a tip, if a law asks for it.
    fn zone(&self, id: TipId, at: f64, state: &LifeState) -> Option<f64> {
        let wheeler = self.law.wheeler?;
        let strength = self.value(id, at, |tip| tip.strength.ln())?.exp();
        Some(wheeler.zone(self.law.blocks[state.block].max.max(0.0) * strength))
    }

    /// A piece that ends with its block at the latest, and its part of the increment.
    fn piece(
        &self,
        at: f64,
        most: f64,
        rates: &BTreeMap<TipId, f64>,
        state: &LifeState,
    ) -> Result<(f64, PieceLife), LifeError> {
        let left = self.law.blocks[state.block].cycles - state.over;
        let mut part = most;
        let mut piece = self.along(at, part, rates, state)?;
        for _ in 0..ROUNDS {
            if piece.cycles <= left * (1.0 + LEFT)
                && (part == most || piece.cycles >= left * (1.0 - LEFT))
            {
                break;
            }
            part = (part * left / piece.cycles).min(most);
            piece = self.along(at, part, rates, state)?;
        }
        Ok((part, piece))
    }

    /// Cycles and growth along a part of the increment.
    fn along(
        &self,
        at: f64,
        part: f64,
        rates: &BTreeMap<TipId, f64>,
        state: &LifeState,
    ) -> Result<PieceLife, LifeError> {
        let block = &self.law.blocks[state.block];
        let first = rates[&self.fastest];
        let mut piece = PieceLife { cycles: 0.0, growth: BTreeMap::new() };
        for [point, weight] in GAUSS {
            let way = part * point * self.length;
            // growth and cycles on the way there, by the rates at the start
            let mut there = state.clone();
            there.cycles += way * (-first).exp();
            for (id, tip) in &mut there.tips {
                tip.growth += rates.get(id).map_or(0.0, |rate| growth_ratio(*rate, first)) * way;
            }
            let rates = self.rates(at + part * point, block, &there)?;
            let most = rates.get(&self.fastest).copied().unwrap_or(f64::NEG_INFINITY);
            if most == f64::NEG_INFINITY {
                continue;
            }
            piece.cycles += weight * part * self.length * (-most).exp();
            for (id, rate) in rates {
                *piece.growth.entry(id).or_default() +=
                    weight * part * self.length * growth_ratio(rate, most);
            }
        }
        Ok(piece)
    }

    /// Adds a piece to the life, up to a part of the increment.
    fn take(&self, at: f64, piece: PieceLife, state: &mut LifeState) {
        let blocks = &self.law.blocks;
        let block = blocks[state.block];
        for (id, growth) in piece.growth {
            let tip = state.tips.entry(id).or_default();
            tip.growth += growth;
        }
        for id in self.steps[self.from].tips.keys() {
            if let (Some(zone), Some(tip)) = (self.zone(*id, at, state), state.tips.get_mut(id)) {
                tip.reach = tip.reach.max(tip.growth + zone);
            }
        }
        state.cycles += piece.cycles;
        state.over += piece.cycles;
        if state.over >= block.cycles * (1.0 - 2.0 * LEFT) {
            next_block(state, blocks);
        }
    }

    /// The logarithms of the rates of all tips at a part of the increment.
    fn rates(
        &self,
        at: f64,
        block: &LoadBlock,
        state: &LifeState,
    ) -> Result<BTreeMap<TipId, f64>, LifeError> {
        let mut rates = BTreeMap::new();
        for id in self.steps[self.from].tips.keys() {
            let life = state.tips.get(id).copied().unwrap_or_default();
            if let Some(tip) = self.tip(*id, at, life.growth) {
                rates.insert(*id, ln_rate(self.law, block, &tip, state.cycles, life)?);
            }
        }
        Ok(rates)
    }
}

fn next_block(state: &mut LifeState, blocks: &[LoadBlock]) {
    (state.block, state.over) = ((state.block + 1) % blocks.len(), 0.0);
}

/// Growth in parts of that of the fastest tip; none where a law knows no rate any more.
pub(super) fn growth_ratio(rate: f64, most: f64) -> f64 {
    match rate {
        rate if rate == most => 1.0,
        f64::INFINITY => 0.0,
        rate => (rate - most).exp(),
    }
}

impl IncrementPath<'_> {
    /// A tip on the way; none if nothing drives it where the way begins.
    fn tip(&self, id: TipId, at: f64, growth: f64) -> Option<TipState> {
        let before = self.steps[self.from].tips.get(&id).filter(|tip| tip.strength > 0.0)?;
        let after = self.steps.get(self.from + 1).and_then(|step| step.tips.get(&id));
        let strength = self.value(id, at, |tip| tip.strength.ln())?.exp();
        let factor = |k: usize| {
            let part = self.value(id, at, |tip| tip.factors[k] / tip.strength);
            part.map_or(f64::NAN, |part| part * strength)
        };
        let factors = [factor(0), factor(1), factor(2)];
        let end = after.unwrap_or(before);
        let toughness = match before.toughness {
            toughness if toughness.is_infinite() => toughness,
            toughness => toughness + at * (end.toughness - toughness),
        };
        let place = before.at + (end.at - before.at) * at;
        Some(TipState { at: place, strength, factors, extension: growth, toughness })
    }

    /// A value of a tip at a part of the increment: the polynomial through the steps around it in
    /// the logarithm of the length of the fastest tip's crack.
    fn value(&self, id: TipId, at: f64, value: impl Fn(&TipState) -> f64) -> Option<f64> {
        let crack = self.fastest.crack as usize;
        let length = |step: &LifeStep| step.lengths.get(crack).copied();
        let [from, to] = [self.from, self.from + 1].map(|k| self.steps.get(k).and_then(length));
        let (from, to) = (from?, to?);
        let x = (from + at * (to - from)).ln();
        let mut nodes: Vec<(usize, f64, f64)> = Vec::with_capacity(STENCIL);
        for (k, step) in self.steps.iter().enumerate() {
            let Some(tip) = step.tips.get(&id).filter(|tip| tip.strength > 0.0) else { continue };
            let node = (k, length(step)?.ln(), value(tip));
            // a step in which the crack has not grown says nothing of how K changes with it
            match nodes.last_mut() {
                Some(last) if last.1 >= node.1 => *last = node,
                _ => nodes.push(node),
            }
        }
        if nodes.iter().all(|node| node.0 <= self.from) {
            nodes.drain(..nodes.len().saturating_sub(CONTINUED));
        }
        let factor = |k: usize| {
            let others = nodes.iter().enumerate().filter(|(j, _)| *j != k);
            others.map(|(_, node)| (x - node.1) / (nodes[k].1 - node.1)).product::<f64>()
        };
        (!nodes.is_empty()).then(|| (0..nodes.len()).map(|k| factor(k) * nodes[k].2).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::End;
    use ppum::vec2::vec2;
    use ppum_problem::Wheeler;
    use ppum_testkit::random::Random;
    use std::f64::consts::PI;

    const TIP: TipId = TipId { crack: 0, end: End::Last };

    /// A step of a crack from 0 to a whose K is known.
    fn step(a: f64, strength: f64) -> LifeStep {
        let factors = [strength, 0.0, 0.0];
        let toughness = f64::INFINITY;
        let tip = TipState { at: vec2(a, 0.0), strength, factors, extension: 0.0, toughness };
        LifeStep { lengths: vec![a], tips: [(TIP, tip)].into(), increments: BTreeMap::new() }
    }

    /// Cycles from one length to another in so many increments, with the exact K at their ends.
    fn cycles(law: &GrowthLaw, ends: [f64; 2], n: usize, k: &dyn Fn(f64) -> f64) -> f64 {
        let at = |j: usize| ends[0] + (ends[1] - ends[0]) * j as f64 / n as f64;
        let mut life = Life::default();
        for j in 0..=n {
            let before = if j == 0 { BTreeMap::new() } else { [(TIP, at(j) - at(j - 1))].into() };
            life.add(law, step(at(j), k(at(j))), before).expect("a life");
        }
        assert!((life.growth(TIP) - (ends[1] - ends[0])).abs() < 1e-12);
        life.cycles()
    }

    fn infinite(a: f64) -> f64 {
        (PI * a).sqrt()
    }

    fn in_strip(a: f64) -> f64 {
        (PI * a / (PI * a).cos()).sqrt()
    }

    /// In an infinite plate lives are exact, whatever the increments: (1/a₀ − 1/a₁)/(cπ²σ⁴) for
    /// m = 4, ln(a₁/a₀)/(cπσ²) for m = 2.
    #[test]
    fn lives_in_an_infinite_plate() {
        for (m, wanted) in [(4.0, (10.0 - 1.0 / 0.3) / PI.powi(2)), (2.0, 3.0_f64.ln() / PI)] {
            for n in [1, 2, 4, 16] {
                let found = cycles(&GrowthLaw::paris(1e-3, m), [0.1, 0.3], n, &infinite);
                let error = found / wanted * 1e-3 - 1.0;
                println!("{m} {n}: {error:.1e}");
                assert!(error.abs() < if n == 1 { 1e-6 } else { 1e-8 });
            }
        }
    }

    /// In a strip the error falls with the fourth power of the increments; 373.363 is the integral
    /// by mpmath. Rates that are exponentials along an increment were off by 1e-2 with four.
    #[test]
    fn lives_in_a_strip() {
        let law = GrowthLaw::paris(1e-3, 3.0);
        let error =
            |n| (cycles(&law, [0.1, 0.3], n, &in_strip) / 373.362_902_791_170_77 - 1.0).abs();
        let errors = [4, 8, 16, 32].map(error);
        println!("{errors:?}");
        assert!(errors[0] < 3e-3 && errors[3] < 1e-6);
        assert!(errors.windows(2).all(|pair| pair[1] < pair[0] / 8.0));
    }

    /// The laws of Walker, Forman and NASGRO against integrals over 100,000 pieces.
    #[test]
    fn lives_by_other_laws() {
        let named = |name: &str, values: &[f64]| {
            let law = ppum_problem::NAMED_LAWS.iter().find(|law| law.name == name).expect("a law");
            GrowthLaw::named(law, values.to_vec())
        };
        let closure = ppum_problem::Closure { alpha: 2.0, stress: 0.3 };
        let nasgro = named("nasgro", &[1e-3, 3.0, 0.5, 0.5, 0.2]).with_closure(Some(closure));
        for mut law in
            [named("walker", &[1e-3, 3.0, 0.4, 0.0]), named("forman", &[1e-3, 3.0, 0.0]), nasgro]
        {
            law.blocks = vec![LoadBlock::constant(0.2)];
            let rate = |a: f64| {
                let LifeStep { tips, .. } = step(a, in_strip(a));
                let tip = TipState { toughness: 3.0, ..tips[&TIP] };
                law.ln_rate(&law.blocks[0], &tip, 0.0).expect("a rate").exp()
            };
            let n = 100_000;
            let middle = |k: usize| 0.1 + 0.2 * (k as f64 + 0.5) / n as f64;
            let wanted = (0..n).map(|k| 0.2 / n as f64 / rate(middle(k))).sum::<f64>();
            let mut life = Life::default();
            for j in 0..=16 {
                let a = 0.1 + 0.2 * f64::from(j) / 16.0;
                let mut step = step(a, in_strip(a));
                step.tips.get_mut(&TIP).expect("a tip").toughness = 3.0;
                let before = if j == 0 { BTreeMap::new() } else { [(TIP, 0.0125)].into() };
                life.add(&law, step, before).expect("a life");
            }
            println!("{:.1e}", life.cycles() / wanted - 1.0);
            assert!((life.cycles() / wanted - 1.0).abs() < 2e-5);
        }
    }

    /// Overloads slow growth as an independent integration in Python says; without Wheeler's law
    /// the order of blocks matters to the length of a program only, with it more.
    #[test]
    fn overloads() {
        let wheeler = Some(Wheeler { yield_stress: 100.0, exponent: 1.3, constraint: 1.0 });
        let block = |cycles: f64, max: f64| LoadBlock { cycles, max, min: 0.0 };
        let life = |order: [usize; 2], wheeler, end: f64| {
            let mut law = GrowthLaw::paris(1e-9, 3.0);
            law.blocks = order.map(|k| [block(1000.0, 1.0), block(10.0, 2.0)][k]).to_vec();
            law.wheeler = wheeler;
            cycles(&law, [0.1, end], 8, &|a| 10.0 * infinite(a))
        };
        for (order, wheeler, end, wanted) in [
            ([0, 1], wheeler, 0.3, 1_967_479.99),
            ([0, 1], None, 0.3, 448_969.24),
            ([0, 1], wheeler, 0.12, 403_328.83),
            ([1, 0], wheeler, 0.12, 406_471.36),
            ([0, 1], None, 0.12, 92_591.96),
            ([1, 0], None, 0.12, 92_521.96),
        ] {
            let found = life(order, wheeler, end);
            println!("{order:?} {end}: {found:.2} {wanted} {:.1e}", found / wanted - 1.0);
            assert!((found / wanted - 1.0).abs() < 1e-6);
        }
    }

    /// Scales of the law are scales of the life; growth per time may depend on the time.
    #[test]
    fn scales_and_time() {
        let mut random = Random(5);
        for _ in 0..50 {
            let (c, scale, m) =
                (random.between(0.1, 2.0), random.between(0.1, 9.0), random.between(0.0, 5.0));
            let life = |c| cycles(&GrowthLaw::paris(c, m), [0.1, 0.3], 5, &in_strip);
            assert!((life(c * scale) * scale / life(c) - 1.0).abs() < 1e-12);
        }
        let law = GrowthLaw::formula("1e-3*(1 + n)", &[]).expect("a scope").expect("a formula");
        // a = 1e-3 (t + t²/2)
        let wanted = (1.0 + 2.0 * 0.2 / 1e-3_f64).sqrt() - 1.0;
        let found = cycles(&law, [0.1, 0.3], 64, &infinite);
        println!("{found} {wanted}");
        assert!((found / wanted - 1.0).abs() < 1e-4);
    }

    /// Two tips share the cycles: with K = √(πa) of the first and a^1.5 of the second, m = 2, the
    /// second grows by (a₁³ − a₀³)/(3π), which is known beforehand, too.
    #[test]
    fn slower_tips() {
        let slow = TipId { crack: 1, end: End::Last };
        let law = GrowthLaw::paris(1e-3, 2.0);
        let mut life = Life::default();
        for j in 0..3 {
            let a = 0.1 + 0.1 * f64::from(j);
            let mut step = step(a, infinite(a));
            step.lengths.push(0.5);
            let tip = TipState { strength: a.powf(1.5), ..step.tips[&TIP] };
            step.tips.insert(slow, tip);
            let before = if j == 0 { BTreeMap::new() } else { [(TIP, 0.1), (slow, 0.0)].into() };
            life.add(&law, step, before).expect("a life");
        }
        let growth = |to: f64, from: f64| (to.powi(3) - from.powi(3)) / (3.0 * PI);
        assert!((life.growth(slow) - growth(0.3, 0.1)).abs() < 1e-12);
        let next = life.forecast(&law, [(TIP, 0.05), (slow, 0.01)].into()).expect("a forecast");
        println!("{next:?}");
        assert!((next[&TIP] - 0.05).abs() < 1e-12);
        assert!((next[&slow] - growth(0.35, 0.3)).abs() < 1e-12);
    }

    /// A tip whose K falls to the threshold stops there, and cycles are counted up to it.
    #[test]
    fn tips_stop_on_the_way() {
        let law = GrowthLaw::formula("if(dk > 1, 1, 0)", &[]).expect("a scope").expect("a formula");
        let mut life = Life::default();
        life.add(&law, step(0.5, 1.5), BTreeMap::new()).expect("a step");
        life.add(&law, step(1.0, 0.75), [(TIP, 0.5)].into()).expect("a step");
        assert_eq!(life.ln_rates(&law).expect("rates")[&TIP], f64::NEG_INFINITY);
        // K = 0.75/a is 1 at a = 0.75
        println!("{}", life.cycles());
        assert!((life.cycles() - 0.25).abs() < 0.5 * PIECE);
    }
}
