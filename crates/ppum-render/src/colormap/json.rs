//! Colour maps as JSON: ParaView's presets, Plotly's colour scales, plain lists of colours.

use serde_json::{Map, Value};

use super::paint::{numbers, word};
use super::space::Space;
use super::stops::{ColorFileError, ColorStop, Paint, Stops};
use crate::image::Rgba;

const FORMS: &str = "write a list of [red, green, blue] or \"#rrggbb\", of [position, \"#rrggbb\"], \
    or a preset of ParaView with RGBPoints";

/// Keys under which services put their lists.
const LISTS: [&str; 3] = ["colors", "colours", "colorscale"];

/// Reads a map of any of the forms.
pub(super) fn read(text: &str) -> Result<Stops, ColorFileError> {
    let value: Value = serde_json::from_str(text).map_err(|error| {
        let place = format!("line {}, column {}", error.line(), error.column());
        ColorFileError::new(place, format!("this is not JSON: {error}"))
    })?;
    match &value {
        Value::Object(map) => object(map, ""),
        Value::Array(items) if items.iter().any(Value::is_object) => presets(items),
        Value::Array(items) => list(items, ""),
        _ => Err(ColorFileError::new("the whole file", format!("holds no colours; {FORMS}"))),
    }
}

/// ParaView writes a list of presets, most often of one.
fn presets(items: &[Value]) -> Result<Stops, ColorFileError> {
    match items {
        [Value::Object(map)] => object(map, "[0]"),
        _ => {
            let mistake = format!("there are {} maps; keep the one you want", items.len());
            Err(ColorFileError::new("the whole file", mistake))
        }
    }
}

fn object(map: &Map<String, Value>, place: &str) -> Result<Stops, ColorFileError> {
    if let Some(points) = map.get("RGBPoints") {
        return preset(map, points, place);
    }
    let list_of = |key| Some((key, map.get(key)?.as_array()?));
    match LISTS.into_iter().find_map(list_of) {
        Some((key, items)) => list(items, &format!("{place}.{key}")),
        None if map.contains_key("IndexedColors") => {
            let mistake =
                "IndexedColors are colours of categories, not of values; take a map with RGBPoints";
            Err(ColorFileError::new(place_of(place), mistake))
        }
        None => Err(ColorFileError::new(place_of(place), format!("holds no colours; {FORMS}"))),
    }
}

fn place_of(place: &str) -> &str {
    if place.is_empty() { "the whole file" } else { place }
}

fn list(items: &[Value], place: &str) -> Result<Stops, ColorFileError> {
    let stop = |(k, item): (usize, &Value)| stop(item, format!("{place}[{k}]"));
    Ok(items.iter().enumerate().map(stop).collect::<Result<Vec<_>, _>>()?.into())
}

/// A colour, or `[position, colour]`.
fn stop(item: &Value, place: String) -> Result<ColorStop, ColorFileError> {
    let found = match item.as_array().map(Vec::as_slice) {
        Some([at, paint]) => at.as_f64().zip(color(paint)).map(|(at, paint)| (Some(at), paint)),
        _ => color(item).map(|paint| (None, paint)),
    };
    match found {
        Some((at, paint)) => Ok(ColorStop { at, paint, place }),
        None => {
            let text: String = item.to_string().chars().take(60).collect();
            Err(ColorFileError::new(place, format!("{text} is not a colour; {FORMS}")))
        }
    }
}

fn color(value: &Value) -> Option<Paint> {
    match value {
        Value::String(text) => word(text),
        Value::Array(items) => {
            let values: Option<Vec<f64>> = items.iter().map(Value::as_f64).collect();
            numbers(values?.try_into().ok()?)
        }
        _ => None,
    }
}

/// A preset of ParaView: `RGBPoints` holds position, red, green, blue, again and again. What is
/// about opacity and logarithms is left out, and so is `NanColor`: here pixels without a value lie
/// outside the domain.
fn preset(map: &Map<String, Value>, points: &Value, place: &str) -> Result<Stops, ColorFileError> {
    let place = format!("{place}.RGBPoints");
    let flat: Option<Vec<f64>> =
        points.as_array().and_then(|items| items.iter().map(Value::as_f64).collect());
    let flat = flat.ok_or_else(|| ColorFileError::new(&place, "is no list of numbers"))?;
    let (quads, rest) = flat.as_chunks::<4>();
    if !rest.is_empty() {
        let mistake = "ends within a point; a point is position, red, green, blue";
        return Err(ColorFileError::new(format!("{place}[{}]", 4 * quads.len()), mistake));
    }
    let stop = |(k, &[at, r, g, b]): (usize, &[f64; 4])| {
        let place = format!("{place}[{}]", 4 * k);
        match unit([r, g, b]) {
            Some(color) => Ok(ColorStop { at: Some(at), paint: Paint::Bytes(color), place }),
            None => {
                Err(ColorFileError::new(place, "red, green and blue of ParaView lie within 0 to 1"))
            }
        }
    };
    let stops = quads.iter().enumerate().map(stop).collect::<Result<_, _>>()?;
    let (below, above) = (beyond(map, "Below")?, beyond(map, "Above")?);
    Ok(Stops { stops, space: space(map)?, below, above })
}

/// Bytes of a colour of ParaView.
fn unit(color: [f64; 3]) -> Option<[f64; 3]> {
    color.iter().all(|c| (0.0..=1.0).contains(c)).then(|| color.map(|c| 255.0 * c))
}

/// The colour of values beyond the range, if it is to be used.
fn beyond(map: &Map<String, Value>, which: &str) -> Result<Option<Rgba>, ColorFileError> {
    let used = map.get(&format!("Use{which}RangeColor"));
    if !used.is_some_and(|used| used.as_bool().unwrap_or(used.as_f64().is_some_and(|n| n != 0.0))) {
        return Ok(None);
    }
    let key = format!("{which}RangeColor");
    let values: Option<Vec<f64>> =
        map.get(&key).and_then(Value::as_array).and_then(|v| v.iter().map(Value::as_f64).collect());
    let color = values.and_then(|values| unit(values.try_into().ok()?));
    let [r, g, b] = color
        .ok_or_else(|| {
            ColorFileError::new(key, "is to be used, but is not three numbers within 0 to 1")
        })?
        .map(|c| c.round() as u8);
    Ok(Some([r, g, b, 255]))
}

fn space(map: &Map<String, Value>) -> Result<Space, ColorFileError> {
    let Some(name) = map.get("ColorSpace") else { return Ok(Space::Rgb) };
    let wraps = map.get("HSVWrap").is_some_and(|wraps| wraps != 0 && wraps != false);
    match name.as_str().unwrap_or_default().to_lowercase().as_str() {
        "rgb" => Ok(Space::Rgb),
        "hsv" if !wraps => Ok(Space::Hsv),
        "lab" => Ok(Space::Lab),
        "diverging" => Ok(Space::Diverging),
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
