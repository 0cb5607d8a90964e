//! Exact values along lines, cracks and circles: what `sample` writes and `plot` draws.

mod along;
mod table;

use std::sync::atomic::{AtomicUsize, Ordering};

use anyhow::{Context as _, ensure};
use ppum::field::Field;
use ppum::progress::{Phase, Progress, Watcher};
use ppum::quantity::Quantity;
use ppum::sample::{self, Curve, Place};
use ppum::vec2::Vec2;
use rayon::prelude::*;

use crate::arguments::{circle, degrees, ends, positive};
use crate::output::tell;
use crate::progress::Bar;
use crate::tips;
use crate::undefined;
pub(crate) use table::{Column, Table};

/// Options of places along a curve.
#[derive(Debug, clap::Args)]
pub(crate) struct Profile {
    /// Along the line between two points
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = ends)]
    #[arg(group = "where")]
    line: Option<[Vec2; 2]>,
    /// Along a crack, numbered from 0: both sides, jumps and opening
    #[arg(long, value_name = "K", group = "where")]
    crack: Option<usize>,
    /// Around a circle by its centre and radius, against the angle from the x axis in degrees
    #[arg(long, value_name = "X,Y,R", allow_hyphen_values = true, value_parser = circle, group = "where")]
    circle: Option<(Vec2, f64)>,
    /// Around a crack tip, numbered from 0 as in `ppum sif`, against the angle θ from the crack's extension in
    /// degrees; with --angle away from it, against the distance r
    #[arg(long, value_name = "K", group = "where")]
    tip: Option<usize>,
    /// Distance from --tip [default: a hundredth of its crack's length]; with --angle the largest
    #[arg(long, value_name = "R", requires = "tip", value_parser = positive)]
    radius: Option<f64>,
    /// Direction away from --tip, degrees from the crack's extension; ±180 are the faces
    #[arg(long, value_name = "DEGREES", requires = "tip", allow_hyphen_values = true, value_parser = degrees)]
    angle: Option<f64>,
    /// Number of points along the curve [default: 201]
    #[arg(long, value_name = "N")]
    count: Option<usize>,
}

/// The variable that values along a curve belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Variable {
    /// Arc length.
    Length,
    /// Angle, degrees.
    Angle,
    /// Distance from a tip, in steps of its logarithm.
    Distance,
}

impl Variable {
    /// Name of its column.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Length => "s",
            Self::Angle => "theta",
            Self::Distance => "r",
        }
    }

    fn unit(self) -> &'static str {
        if self == Self::Angle { "deg" } else { "" }
    }
}

/// Points along a curve if nothing is said.
const COUNT: usize = 201;

/// Most points at a time: their table takes some gigabytes.
pub(crate) const MOST: usize = 20_000_000;

/// Values of a curve's variable that are the same but for rounding, in parts of its range.
const SAME: f64 = 1e-12;

/// The smallest distance of a ray from its tip, in parts of the largest.
const NEAREST: f64 = 1e-6;

impl Profile {
    /// True if a curve was asked for.
    pub(crate) fn is_given(&self) -> bool {
        self.line.is_some() || self.crack.is_some() || self.circle.is_some() || self.tip.is_some()
    }

    /// True if the curve is a crack, seen from both sides.
    pub(crate) fn is_crack(&self) -> bool {
        self.crack.is_some()
    }

    /// The variable of the curve that was asked for.
    pub(crate) fn variable(&self) -> Variable {
        match (self.tip.is_some(), self.angle.is_some(), self.circle.is_some()) {
            (true, true, _) => Variable::Distance,
            (true, false, _) | (_, _, true) => Variable::Angle,
            _ => Variable::Length,
        }
    }

    /// One row for each place: the variable, position, side, quantities; of a crack those of both sides, jumps and
    /// opening.
    pub(crate) fn table(
        &self,
        field: &Field<'_>,
        quantities: &[(String, Quantity)],
    ) -> anyhow::Result<Table> {
        let count = self.checked_count()?;
        if let Some(crack) = self.crack {
            return along::table(field, quantities, crack, count);
        }
        self.listed(field, quantities, self.places(field, count)?)
    }

    /// The table of a curve that is drawn: a line or a circle has both sides of the cracks that it passes through,
    /// first that from which it comes; at its ends that alone which it runs on.
    pub(crate) fn drawn(
        &self,
        field: &Field<'_>,
        quantities: &[(String, Quantity)],
    ) -> anyhow::Result<Table> {
        let count = self.checked_count()?;
        let Some(curve) = self.curve() else { return self.table(field, quantities) };
        let mut places = self.places(field, count)?;
        let [Some((start, _)), Some((end, _))] =
            [places.first(), places.last()].map(|p| p.copied())
        else {
            return self.listed(field, quantities, places);
        };
        let is_same = |a: f64, b: f64| (a - b).abs() <= SAME * (end - start);
        for passage in sample::passages(&field.step.cracks, curve) {
            let at = if self.circle.is_some() { passage.at.to_degrees() } else { passage.at };
            let [before, after] = passage.places;
            let is_seam = self.circle.is_some() && is_same(at.abs(), end);
            let sides = match () {
                () if is_seam => vec![(start, after), (end, before)],
                () if is_same(at, start) => vec![(start, after)],
                () if is_same(at, end) => vec![(end, before)],
                () => vec![(at, before), (at, after)],
            };
            let is_replaced = |v: f64| sides.iter().any(|(at, _)| is_same(v, *at));
            places.retain(|(v, place)| place.on.is_none() || !is_replaced(*v));
            for (at, place) in sides {
                let next = places.partition_point(|(v, _)| *v <= at);
                places.insert(next, (at, place));
            }
        }
        self.listed(field, quantities, places)
    }

    /// The line or the circle.
    fn curve(&self) -> Option<Curve> {
        let circle = self.circle.map(|(center, radius)| Curve::Circle(center, radius));
        self.line.map(Curve::Line).or(circle)
    }

    fn checked_count(&self) -> anyhow::Result<usize> {
        // clap does not ask for `--tip` where something else of its group is given
        let is_at_tip = self.tip.is_some() || (self.radius.is_none() && self.angle.is_none());
        ensure!(is_at_tip, "--radius and --angle belong to --tip");
        let count = self.count.unwrap_or(COUNT);
        ensure!(count >= 2, "--count {count}: a line has two points or more");
        ensure!(count <= MOST, "--count {count}: at most {MOST} points at a time");
        Ok(count)
    }

    fn listed(
        &self,
        field: &Field<'_>,
        quantities: &[(String, Quantity)],
        places: Vec<(f64, Place)>,
    ) -> anyhow::Result<Table> {
        let (variables, mut places): (Vec<_>, Vec<_>) = places.into_iter().unzip();
        if self.tip.is_none() {
            sample::settle(field.domain, &mut places);
        }
        let variable = self.variable();
        let first = Column::new(variable.name(), variable.unit());
        Ok(listed(field, quantities, &places)?.with_first(first, variables))
    }

    /// The places of a line, a circle or a tip with the variable.
    fn places(&self, field: &Field<'_>, count: usize) -> anyhow::Result<Vec<(f64, Place)>> {
        let cracks = &field.step.cracks;
        let in_degrees = |places: Vec<(f64, Place)>| {
            places.into_iter().map(|(t, p)| (t.to_degrees(), p)).collect()
        };
        if let Some((center, radius)) = self.circle {
            return Ok(in_degrees(sample::circle(cracks, center, radius, count)));
        }
        if let Some(number) = self.tip {
            let tip = tips::numbered(field, number)?;
            let length = cracks[tip.crack as usize].length();
            let missing = || format!("--tip {number}: its crack has no segment");
            return match self.angle {
                Some(angle) => {
                    let far = self.radius.unwrap_or(0.1 * length);
                    let angle = if angle.abs() == 180.0 {
                        angle.signum() * std::f64::consts::PI
                    } else {
                        angle.to_radians()
                    };
                    sample::ray(cracks, tip, angle, [NEAREST * far, far], count)
                        .with_context(missing)
                }
                None => {
                    let radius = self.radius.unwrap_or(0.01 * length);
                    sample::around(cracks, tip, radius, count).map(in_degrees).with_context(missing)
                }
            };
        }
        let [a, b] = self.line.context("give --line, --crack, --circle or --tip")?;
        ensure!(a != b, "--line: its two points are equal");
        let places = sample::line(cracks, a, b, count).into_iter();
        Ok(places.map(|place| ((place.point - a).length(), place)).collect())
    }
}

/// The quantities at all places, one row for each, on all cores.
fn evaluate(
    field: &Field<'_>,
    quantities: &[Quantity],
    places: &[Place],
) -> anyhow::Result<Vec<f64>> {
    let (bar, done, total) = (Bar::new(), AtomicUsize::new(0), places.len());
    let watcher: &dyn Watcher = &bar;
    let values = |batch: &&[Place]| {
        let done = done.fetch_add(batch.len(), Ordering::Relaxed);
        watcher.report(Progress::new(Phase::Evaluation, done, total))?;
        Ok(sample::evaluate_batch(field, quantities, batch))
    };
    let batches: Vec<_> = sample::batches(places).collect();
    let rows = batches.par_iter().map(values).collect::<anyhow::Result<Vec<_>>>()?;
    Ok(rows.concat())
}

/// One row for each place: position, side, quantities.
pub(crate) fn listed(
    field: &Field<'_>,
    quantities: &[(String, Quantity)],
    places: &[Place],
) -> anyhow::Result<Table> {
    let wanted: Vec<_> = quantities.iter().map(|(_, quantity)| quantity.clone()).collect();
    let values = evaluate(field, &wanted, places)?;
    tell_undefined(field, quantities, places, &values);
    let of = |(name, quantity): &(String, Quantity)| Column::new(name, quantity.unit(field));
    let head = ["x", "y", "side"].map(|name| Column::new(name, ""));
    let columns = head.into_iter().chain(quantities.iter().map(of)).collect();
    let mut rows = Vec::with_capacity(places.len() * (3 + quantities.len()));
    for (place, values) in places.iter().zip(values.chunks(quantities.len())) {
        rows.extend([place.point.x, place.point.y, place.mark()]);
        rows.extend(values);
    }
    Ok(Table::new(columns, rows))
}

/// Tells which quantities have no value at places of the plate.
fn tell_undefined(
    field: &Field<'_>,
    quantities: &[(String, Quantity)],
    places: &[Place],
    values: &[f64],
) {
    let width = quantities.len();
    let is_inside = |k: usize| field.domain.at(places[k].anchor).contains(places[k].offset);
    for (column, (name, _)) in quantities.iter().enumerate() {
        let is_undefined = |k: &usize| values[k * width + column].is_nan() && is_inside(*k);
        let count = (0..places.len()).filter(is_undefined).count();
        if count > 0 {
            let inside = (0..places.len()).filter(|&k| is_inside(k)).count();
            tell(&format!("warning: {}", undefined::message(name, [count, inside], "points")));
        }
    }
}
