//! `ppum probe`: exact values at points.

use std::io::{self, Write};

use ppum::field::Field;
use ppum::quantity::{Quantity, face_names};
use ppum::sample::SidedPoint;
use ppum::sides::Segments;
use ppum::vec2::Vec2;
use serde::Serialize;
use serde::ser::Serializer;

use crate::dataset::quantities;
use crate::number::{JsonNumber, json};
use crate::subject::StepArgs;
use ppum_scene::arguments::point;

/// Print exact values at points
///
/// On a crack the values of both sides are printed: `above` is the left of the crack's direction.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ProbeArgs {
    /// Point; may be given more than once
    #[arg(long, value_name = "X,Y", required = true, allow_hyphen_values = true, value_parser = point)]
    at: Vec<Vec2>,
    /// Offset added to every point without rounding, for points at any distance from a tip
    #[arg(long, value_name = "DX,DY", allow_hyphen_values = true, value_parser = point)]
    offset: Option<Vec2>,
    /// Quantities: von-mises, s1, sxx, ux or others of `ppum info`, formulas of them, or @FILE
    /// [default: the components; for elasticity also the stresses]
    #[arg(short, long, value_name = "Q,…", allow_hyphen_values = true)]
    quantity: Vec<String>,
    #[command(flatten)]
    step: StepArgs,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum probe plate.h5 --at 0.25,-0.1
  ppum probe plate.h5 --at -0.5,0 --at 0.5,0 -q ux,uy,von-mises
  ppum probe plate.h5 --at 0,0                         on the crack: both sides
  ppum probe plate.h5 --at 0,0 -q normal-traction,shear-traction,opening,sliding,closed
  ppum probe plate.h5 --at 0.2,0.1 -q 'sxx + syy,max(s1, 0)'
  ppum probe plate.h5 --at 0,0 --part jump            only the blocks of sides of cracks
  ppum probe plate.h5 --at 0.5,0 --offset 1e-12,1e-13  near a tip";

/// Least and largest width of the column of names; longer ones push their values aside.
const NAME: usize = 12;
const LONG_NAME: usize = 40;

#[derive(Debug, Serialize)]
struct ProbeReport {
    points: Vec<ProbeRow>,
}

/// The values at one point, on one side of a crack if it lies on one.
#[derive(Debug, Serialize)]
struct ProbeRow {
    at: [f64; 2],
    #[serde(skip_serializing_if = "Option::is_none")]
    offset: Option<[f64; 2]>,
    side: Option<&'static str>,
    /// True on an interface of the material: the values are those of one side.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    interface: bool,
    values: NamedValues,
    #[serde(skip)]
    is_inside: bool,
}

/// Names and values in the order asked for; an object in JSON.
#[derive(Debug)]
struct NamedValues(Vec<(String, JsonNumber)>);

impl Serialize for NamedValues {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl ProbeArgs {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let dataset = self.step.open()?;
        let field = self.step.field(&dataset)?;
        let quantities = quantities(&field, &self.quantity)?;
        let faces = self.faces(&field)?;
        let segments = Segments::new(&field.step.cracks);
        let offset = self.offset.unwrap_or_default();
        let places = self.at.iter().flat_map(|&at| SidedPoint::sides(&segments, at, offset));
        let row = |place: SidedPoint| {
            let faces = faces.iter().filter(|_| place.on.is_some());
            let all: Vec<_> = quantities.iter().chain(faces).collect();
            self.row(&field, &all, &place)
        };
        let points: Vec<_> = places.map(row).collect();
        if self.json {
            json(out, &ProbeReport { points })?;
        } else {
            points.iter().try_for_each(|row| row.write(out))?;
        }
        Ok(())
    }

    /// The quantities of faces, which points of cracks have where none are asked for.
    fn faces(&self, field: &Field<'_>) -> anyhow::Result<Vec<(String, Quantity)>> {
        let names: Vec<_> = face_names(field).map(str::to_owned).collect();
        match names[..] {
            [] => Ok(Vec::new()),
            _ if !self.quantity.is_empty() => Ok(Vec::new()),
            _ => quantities(field, &names),
        }
    }

    /// The values at a point on a side.
    fn row(
        &self,
        field: &Field<'_>,
        quantities: &[&(String, Quantity)],
        place: &SidedPoint,
    ) -> ProbeRow {
        let mut local = place.seen(field);
        let value = |(name, quantity): &&(String, Quantity)| {
            (name.clone(), JsonNumber(quantity.at(&mut local, place.offset, place.side)))
        };
        let values = NamedValues(quantities.iter().map(value).collect());
        ProbeRow {
            at: place.anchor.into(),
            offset: self.offset.map(Vec2::into),
            side: place.on.map(|_| place.side.name()),
            // an offset says the side
            interface: self.offset.is_none() && is_on_interface(field, place.anchor),
            values,
            is_inside: local.contains(place.offset),
        }
    }
}

/// True where a constant of the material jumps, except for the rounding of the place.
fn is_on_interface(field: &Field<'_>, at: Vec2) -> bool {
    let size = field.domain.bounds.size();
    let step = ROUNDING * size.x.max(size.y);
    let around = [[step, 0.0], [-step, 0.0], [0.0, step], [0.0, -step]];
    let mut formulas = field.equation.constants().filter(|(_, e)| e.constant().is_none());
    formulas.any(|(_, expression)| {
        let value = |[dx, dy]: [f64; 2]| expression.formula().evaluate(&[at.x + dx, at.y + dy]);
        let values = around.map(value);
        let [low, high] = [f64::min, f64::max].map(|f| values.into_iter().reduce(f).unwrap_or(0.0));
        high - low > JUMP * high.abs().max(low.abs())
    })
}

/// Rounding of a place, in parts of the plate, and the least relative jump: smooth formulas do not
/// change so much within so little.
const ROUNDING: f64 = 1e-13;
const JUMP: f64 = 1e-6;

impl ProbeRow {
    fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let [x, y] = self.at;
        write!(out, "({x:?}, {y:?})")?;
        if let Some([dx, dy]) = self.offset {
            write!(out, " + ({dx:?}, {dy:?})")?;
        }
        if let Some(side) = self.side {
            write!(out, ", {side} the crack")?;
        }
        if self.interface {
            write!(out, ", on a material interface: values of one side, --offset takes the other")?;
        }
        if !self.is_inside {
            return writeln!(out, ": outside the domain");
        }
        writeln!(out)?;
        let longest = self.values.0.iter().map(|(name, _)| name.chars().count()).max();
        let width = longest.unwrap_or(0).clamp(NAME, LONG_NAME);
        for (name, value) in &self.values.0 {
            match value.0 {
                v if v.is_nan() => writeln!(out, "  {name:width$}  nan (not defined here)")?,
                v if v.is_sign_negative() => writeln!(out, "  {name:width$} {v:?}")?,
                v => writeln!(out, "  {name:width$}  {v:?}")?,
            }
        }
        Ok(())
    }
}
