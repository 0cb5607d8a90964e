//! Arguments of options that are more than a word or a number, as people write them.

use ppum::vec2::{Rect, Vec2};

/// `N` finite numbers apart by commas.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let number = |part: &str| part.trim().parse().ok().filter(|v: &f64| v.is_finite());
    let all: Option<Vec<f64>> = text.split(',').map(number).collect();
    all?.try_into().ok()
}

/// `X,Y`.
///
/// # Errors
/// Anything else.
pub fn point(text: &str) -> Result<Vec2, String> {
    numbers(text).map(Vec2::from).ok_or_else(|| "write two finite numbers: X,Y".into())
}

/// `X0,Y0,X1,Y1`: two opposite corners.
///
/// # Errors
/// Anything else.
pub fn corners(text: &str) -> Result<Rect, String> {
    let [a, b] = ends(text)?;
    Ok(Rect::new(a.min(b), a.max(b)))
}

/// `X0,Y0,X1,Y1`: two points.
///
/// # Errors
/// Anything else.
pub fn ends(text: &str) -> Result<[Vec2; 2], String> {
    let [x0, y0, x1, y1] = numbers(text).ok_or("write four finite numbers: X0,Y0,X1,Y1")?;
    Ok([Vec2::from([x0, y0]), Vec2::from([x1, y1])])
}

/// `X,Y,R`: centre and radius of a circle.
///
/// # Errors
/// Anything else; a radius that is not above zero.
pub fn circle(text: &str) -> Result<(Vec2, f64), String> {
    let [x, y, r] = numbers(text).ok_or("write three finite numbers: X,Y,R")?;
    if r > 0.0 { Ok((Vec2::from([x, y]), r)) } else { Err("the radius is not above zero".into()) }
}

/// An angle in degrees, from −180 to 180.
///
/// # Errors
/// Anything else.
pub fn degrees(text: &str) -> Result<f64, String> {
    let value = numbers(text).map(|[v]| v).filter(|v| (-180.0..=180.0).contains(v));
    value.ok_or_else(|| "write an angle from -180 to 180 degrees".into())
}

/// `WxH`: columns and rows.
///
/// # Errors
/// Anything else.
pub fn size(text: &str) -> Result<[u32; 2], String> {
    let parts = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    parts.ok_or_else(|| "write two whole numbers: WIDTHxHEIGHT, e.g. 1024x768".into())
}

/// `CxR`: columns and rows of panels.
///
/// # Errors
/// Anything else.
pub fn layout(text: &str) -> Result<[u32; 2], String> {
    size(text).map_err(|_| "write the numbers of columns and rows: CxR, e.g. 2x2".into())
}

/// Most pixels of a page of plots and panels: a quarter of a gigabyte.
pub const MOST_OF_PAGE: u64 = 1 << 26;

/// `WxH` of a page, which is drawn whatever is on it.
///
/// # Errors
/// Anything else; more pixels than [`MOST_OF_PAGE`].
pub fn page(text: &str) -> Result<[u32; 2], String> {
    let [columns, rows] = size(text)?;
    if u64::from(columns) * u64::from(rows) > MOST_OF_PAGE {
        return Err(format!("at most {MOST_OF_PAGE} pixels, such as 8192x8192"));
    }
    Ok([columns, rows])
}

/// A finite number above zero.
///
/// # Errors
/// Anything else.
pub fn positive(text: &str) -> Result<f64, String> {
    let value = numbers(text).map(|[v]| v).filter(|&v| v > 0.0);
    value.ok_or_else(|| "write a finite number above zero".into())
}

/// `NAME=TEXT`.
///
/// # Errors
/// Anything else; an empty name or text.
pub fn assignment(text: &str) -> Result<(String, String), String> {
    let parts = text.split_once('=').map(|(name, value)| (name.trim(), value.trim()));
    let [name, value] = parts
        .filter(|(name, value)| !name.is_empty() && !value.is_empty())
        .map(|(name, value)| [name, value].map(str::to_owned))
        .ok_or("write a name, = and what it stands for")?;
    Ok((name, value))
}

/// `NAME=VALUE`; the value may be infinite.
///
/// # Errors
/// Anything else.
pub fn value(text: &str) -> Result<(String, f64), String> {
    let (name, value) = assignment(text).map_err(|_| "write NAME=VALUE".to_owned())?;
    value.parse().map(|value| (name, value)).map_err(|_| format!("`{value}` is not a number"))
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;

    use super::*;

    #[test]
    fn points_and_corners() {
        assert_eq!(point("-0.5,1e-3"), Ok(vec2(-0.5, 1e-3)));
        assert_eq!(point(" 1 , 2"), Ok(vec2(1.0, 2.0)));
        for wrong in ["", "1", "1,2,3", "1,", "1,x", "inf,0", "1,nan", "1;2"] {
            assert!(point(wrong).is_err(), "{wrong}");
        }
        assert_eq!(corners("1,2,-1,0"), Ok(Rect::new(vec2(-1.0, 0.0), vec2(1.0, 2.0))));
        assert!(corners("1,2,3").is_err());
    }

    #[test]
    fn names_and_what_they_stand_for() {
        let pair = |a: &str, b: &str| Ok((a.to_owned(), b.to_owned()));
        assert_eq!(assignment("westergaard 1 = x == y"), pair("westergaard 1", "x == y"));
        assert_eq!(value("x=-1e-3"), Ok(("x".to_owned(), -1e-3)));
        for wrong in ["", "x", "=1", "x=", " = "] {
            assert!(assignment(wrong).is_err() && value(wrong).is_err(), "{wrong}");
        }
        assert!(value("x=y").is_err());
    }

    #[test]
    fn sizes_and_positive_numbers() {
        assert_eq!(size("1024x768"), Ok([1024, 768]));
        for wrong in ["1024", "1024x", "x768", "-1x5", "1.5x2", "1024*768"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
        assert_eq!(positive("1e-12"), Ok(1e-12));
        assert!(positive("0").is_err() && positive("-1").is_err() && positive("inf").is_err());
    }
}
