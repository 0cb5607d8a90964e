//! Options of exact values along lines, cracks and circles: what `sample` writes and `plot` draws.

use std::path::Path;

use anyhow::{Context as _, anyhow, ensure};
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum::sample::SidedPoint;
use ppum::vec2::Vec2;
use ppum_scene::arguments::{circle, degrees, ends, positive};
use ppum_scene::notice::undefined;
use ppum_scene::profile::{self, COUNT, MOST, ProfileCurve, ProfileError, Variable};
use ppum_scene::region::numbered_tip;
use ppum_scene::table::NumberTable;

use crate::output::tell;
use crate::progress::ProgressLine;
use crate::target::{self, FileFormat};

/// Options of places along a curve.
#[derive(Debug, clap::Args)]
pub(crate) struct ProfileArgs {
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
    /// Around a crack tip, numbered from 0 as in `ppum sif`, against the angle θ from the crack's
    /// extension in degrees; with --angle away from it, against the distance r
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

impl ProfileArgs {
    /// True if a curve was asked for.
    pub(crate) fn is_given(&self) -> bool {
        self.along().is_some()
    }

    /// True if the curve is a crack, seen from both sides.
    pub(crate) fn is_crack(&self) -> bool {
        self.crack.is_some()
    }

    /// The variable of the curve that was asked for.
    pub(crate) fn variable(&self) -> Variable {
        self.along().map_or(Variable::Length, |along| along.variable())
    }

    /// One row for each place: the variable, position, side, quantities; of a crack those of both
    /// sides, jumps and opening.
    pub(crate) fn table(
        &self,
        field: &Field<'_>,
        quantities: &profile::NamedQuantities,
    ) -> anyhow::Result<NumberTable> {
        let (along, count) = self.checked(field)?;
        self.reported_table(along.table(field, quantities, count, &ProgressLine::new()))
    }

    /// The table of a curve that is drawn, see [`ProfileCurve::drawn`].
    pub(crate) fn drawn(
        &self,
        field: &Field<'_>,
        quantities: &profile::NamedQuantities,
    ) -> anyhow::Result<NumberTable> {
        let (along, count) = self.checked(field)?;
        self.reported_table(along.drawn(field, quantities, count, &ProgressLine::new()))
    }

    /// The curve.
    fn along(&self) -> Option<ProfileCurve> {
        let anchor = [0.0; 2];
        let line = |[a, b]: [Vec2; 2]| ProfileCurve::Line { anchor, from: a.into(), to: b.into() };
        let circle =
            |(center, radius): (Vec2, f64)| ProfileCurve::Circle { center: center.into(), radius };
        let near = |tip: usize| match self.angle {
            Some(angle) => ProfileCurve::Ray { tip, angle, far: self.radius },
            None => ProfileCurve::Around { tip, radius: self.radius },
        };
        let crack = self.crack.map(|index| ProfileCurve::Crack { index });
        let others = self.circle.map(circle).or_else(|| self.tip.map(near));
        crack.or(self.line.map(line)).or(others)
    }

    /// The curve and the number of its points.
    fn checked(&self, field: &Field<'_>) -> anyhow::Result<(ProfileCurve, usize)> {
        // clap does not ask for `--tip` where something else of its group is given
        let is_at_tip = self.tip.is_some() || (self.radius.is_none() && self.angle.is_none());
        ensure!(is_at_tip, "--radius and --angle belong to --tip");
        if let Some(number) = self.tip {
            numbered_tip(field, number)?;
        }
        let along = self.along().context("give --line, --crack, --circle or --tip")?;
        Ok((along, self.count.unwrap_or(COUNT)))
    }

    /// The table, after a note on the quantities that have no value.
    fn reported_table(
        &self,
        found: Result<profile::Profile, ProfileError>,
    ) -> anyhow::Result<NumberTable> {
        let found = found.map_err(|error| match (&error, self.count) {
            (ProfileError::Crack { index, .. }, _) => anyhow!("--crack {index}: {error}"),
            (ProfileError::Point, _) => anyhow!("--line: {error}"),
            (ProfileError::FewPoints | ProfileError::ManyPoints, Some(count)) => {
                anyhow!("--count {count}: {error}")
            }
            (ProfileError::Cancelled(cancelled), _) => (*cancelled).into(),
            _ => error.into(),
        })?;
        tell_undefined(&found);
        Ok(found.table)
    }
}

/// One row for each place: position, side, quantities.
pub(crate) fn listed(
    field: &Field<'_>,
    quantities: &[(String, Quantity)],
    places: Vec<SidedPoint>,
) -> anyhow::Result<NumberTable> {
    let found = profile::listed(field, quantities, places, &ProgressLine::new())?;
    tell_undefined(&found);
    Ok(found.table)
}

/// Tells which quantities have no value at places of the plate.
fn tell_undefined(found: &profile::Profile) {
    for (name, counts) in &found.undefined {
        tell(&format!("warning: {}", undefined(name, *counts, "points")));
    }
}

/// Writes a table to a file, of numpy if its extension says so.
pub(crate) fn save(table: &NumberTable, path: &Path) -> anyhow::Result<()> {
    target::save(path, |out| match FileFormat::of(path) {
        Some(FileFormat::Npy) => table.write_npy(out),
        _ => table.write_csv(out),
    })
}

/// Refuses a grid of more points than a table has.
pub(crate) fn check_grid([nx, ny]: [u32; 2]) -> anyhow::Result<()> {
    let points = nx as usize * ny as usize;
    ensure!(nx > 0 && ny > 0, "--grid {nx}x{ny}: has no points");
    ensure!(points <= MOST, "--grid {nx}x{ny}: at most {MOST} points at a time");
    Ok(())
}
