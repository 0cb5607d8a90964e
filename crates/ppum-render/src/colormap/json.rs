//! Colour maps as JSON: presets of ParaView.

use serde_json::{Map, Value};

use super::space::ColorSpace;
use super::stops::{ColorFileError, ColorStop, Stops};
use crate::image::Rgba;

/// Reads a preset, or a list of one.
pub(super) fn read(text: &str) -> Result<Stops, ColorFileError> {
    let value: Value = serde_json::from_str(text).map_err(|error| {
        let place = format!("line {}, column {}", error.line(), error.column());
        ColorFileError::new(place, format!("this is not JSON: {error}"))
    })?;
    let (items, place) = match &value {
        Value::Array(items) => (&items[..], "[0]"),
        one => (std::slice::from_ref(one), ""),
    };
    let map = match items {
        [Value::Object(map)] => map,
        [Value::Object(_), ..] => {
            return Err(fault(format!("there are {} maps; keep the one you want", items.len())));
        }
        _ => return Err(fault(FORMS)),
    };
    match map.get("RGBPoints") {
        Some(points) => preset(map, points, place),
        None if map.contains_key("IndexedColors") => Err(fault(
            "IndexedColors are colours of categories, not of values; take a map with RGBPoints",
        )),
        None => Err(fault(FORMS)),
    }
}

const FORMS: &str = "holds no preset of ParaView with RGBPoints, which is all that is read of JSON; \
    write other maps as red, green and blue on each line, with or without a position in front";

fn fault(text: impl Into<String>) -> ColorFileError {
    ColorFileError::new("the whole file", text)
}

/// A preset of ParaView: `RGBPoints` holds position, red, green, blue, again and again. Keys about
/// opacity and logarithms are left out, and so is `NanColor`: here pixels without a value lie
/// outside the domain.
fn preset(map: &Map<String, Value>, points: &Value, place: &str) -> Result<Stops, ColorFileError> {
    let place = format!("{place}.RGBPoints");
    let flat = numbers(points);
    let flat = flat.ok_or_else(|| ColorFileError::new(&place, "is no list of numbers"))?;
    let (quads, rest) = flat.as_chunks::<4>();
    if !rest.is_empty() {
        let mistake = "ends within a point; a point is position, red, green, blue";
        return Err(ColorFileError::new(format!("{place}[{}]", 4 * quads.len()), mistake));
    }
    let stop = |(k, &[at, r, g, b]): (usize, &[f64; 4])| {
        let place = format!("{place}[{}]", 4 * k);
        match unit([r, g, b]) {
            Some(color) => Ok(ColorStop { at: Some(at), color, place }),
            None => {
                Err(ColorFileError::new(place, "red, green and blue of ParaView lie within 0 to 1"))
            }
        }
    };
    let stops = quads.iter().enumerate().map(stop).collect::<Result<_, _>>()?;
    let (below, above) = (beyond(map, "Below")?, beyond(map, "Above")?);
    Ok(Stops { stops, space: space(map)?, below, above })
}

fn numbers(value: &Value) -> Option<Vec<f64>> {
    value.as_array()?.iter().map(Value::as_f64).collect()
}

/// A colour of ParaView.
fn unit(color: [f64; 3]) -> Option<[f64; 3]> {
    color.iter().all(|c| (0.0..=1.0).contains(c)).then_some(color)
}

/// The colour of values beyond the range, if it is to be used.
fn beyond(map: &Map<String, Value>, which: &str) -> Result<Option<Rgba>, ColorFileError> {
    let used = map.get(&format!("Use{which}RangeColor"));
    if !used.is_some_and(|used| used.as_bool().unwrap_or(used.as_f64().is_some_and(|n| n != 0.0))) {
        return Ok(None);
    }
    let key = format!("{which}RangeColor");
    let color = map.get(&key).and_then(numbers).and_then(|values| unit(values.try_into().ok()?));
    let mistake = "is to be used, but is not three numbers within 0 to 1";
    let color = color.ok_or_else(|| ColorFileError::new(key, mistake))?;
    let [r, g, b] = color.map(|c| (255.0 * c).round() as u8);
    Ok(Some([r, g, b, 255]))
}

fn space(map: &Map<String, Value>) -> Result<ColorSpace, ColorFileError> {
    let Some(name) = map.get("ColorSpace") else { return Ok(ColorSpace::Rgb) };
    let wraps = map.get("HSVWrap").is_some_and(|wraps| wraps != 0 && wraps != false);
    match name.as_str().unwrap_or_default().to_lowercase().as_str() {
        "rgb" => Ok(ColorSpace::Rgb),
        "hsv" if !wraps => Ok(ColorSpace::Hsv),
        "lab" => Ok(ColorSpace::Lab),
        "diverging" => Ok(ColorSpace::Diverging),
        "hsv" => Err(ColorFileError::new(
            "HSVWrap",
            "is not supported; export the map with more points in RGB",
        )),
        _ => {
            let mistake = format!(
                "{name} is not supported; there are RGB, HSV, Lab and Diverging, or export more points in RGB"
            );
            Err(ColorFileError::new("ColorSpace", mistake))
        }
    }
}
