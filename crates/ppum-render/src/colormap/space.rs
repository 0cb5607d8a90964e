//! Interpolation in other colour spaces than sRGB, as in VTK: HSV, CIELAB and Moreland's Msh.

use std::f64::consts::FRAC_PI_3;

/// The space in which colours between two given ones are found. Colours are sRGB, 0 to 1,
/// everywhere else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ColorSpace {
    Rgb,
    Hsv,
    Lab,
    /// Msh, polar coordinates of CIELAB, through white where two saturated colours differ in hue
    /// (Moreland 2009).
    Diverging,
}

type Color = [f64; 3];

/// D65's reference white in XYZ.
const WHITE: Color = [0.95047, 1.0, 1.08883];

/// Magnitude of the white in the middle of a diverging map, unless an end is lighter.
const MIDDLE: f64 = 88.0;

/// Saturation below which a colour of Msh counts as grey.
const GREY: f64 = 0.05;

impl ColorSpace {
    /// The colour at `share` ∈ \[0, 1\] between two.
    pub(super) fn between(self, a: Color, b: Color, share: f64) -> Color {
        match self {
            Self::Rgb => mixed(a, b, share),
            Self::Hsv => rgb_of_hsv(mixed(hsv(a), hsv(b), share)),
            Self::Lab => rgb_of_lab(mixed(lab(a), lab(b), share)),
            Self::Diverging => rgb_of_lab(lab_of_msh(diverging(msh(a), msh(b), share))),
        }
    }
}

fn mixed(a: Color, b: Color, share: f64) -> Color {
    std::array::from_fn(|k| a[k] + share * (b[k] - a[k]))
}

fn diverging(a: Color, b: Color, share: f64) -> Color {
    let apart = (a[2] - b[2]).rem_euclid(2.0 * std::f64::consts::PI);
    let apart = apart.min(2.0 * std::f64::consts::PI - apart);
    if a[1] <= GREY || b[1] <= GREY || apart <= FRAC_PI_3 {
        return towards(a, b, share);
    }
    let white = [a[0].max(b[0]).max(MIDDLE), 0.0, 0.0];
    if share < 0.5 { towards(a, white, 2.0 * share) } else { towards(white, b, 2.0 * share - 1.0) }
}

/// Linear in Msh; a grey end takes the hue that keeps the steps to the other one even.
fn towards(mut a: Color, mut b: Color, share: f64) -> Color {
    if a[1] <= GREY && b[1] > GREY {
        a[2] = spun_hue(b, a[0]);
    } else if b[1] <= GREY && a[1] > GREY {
        b[2] = spun_hue(a, b[0]);
    }
    mixed(a, b, share)
}

/// The hue of a grey of magnitude `grey`, seen from a saturated colour.
fn spun_hue([m, s, h]: Color, grey: f64) -> f64 {
    if m >= grey {
        return h;
    }
    let spin = s * (grey * grey - m * m).sqrt() / (m * s.sin());
    if h > -FRAC_PI_3 { h + spin } else { h - spin }
}

fn msh(rgb: Color) -> Color {
    let [l, a, b] = lab(rgb);
    let m = (l * l + a * a + b * b).sqrt();
    if m == 0.0 {
        return [0.0; 3];
    }
    [m, (l / m).clamp(-1.0, 1.0).acos(), b.atan2(a)]
}

fn lab_of_msh([m, s, h]: Color) -> Color {
    [m * s.cos(), m * s.sin() * h.cos(), m * s.sin() * h.sin()]
}

fn lab(rgb: Color) -> Color {
    let [r, g, b] = rgb.map(linear);
    let xyz = [
        0.4124 * r + 0.3576 * g + 0.1805 * b,
        0.2126 * r + 0.7152 * g + 0.0722 * b,
        0.0193 * r + 0.1192 * g + 0.9505 * b,
    ];
    let root = |t: f64| if t > 0.008856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    let [x, y, z]: Color = std::array::from_fn(|k| root(xyz[k] / WHITE[k]));
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn rgb_of_lab([l, a, b]: Color) -> Color {
    let y = (l + 16.0) / 116.0;
    let cube = |t: f64| {
        let cubed = t * t * t;
        if cubed > 0.008856 { cubed } else { (t - 16.0 / 116.0) / 7.787 }
    };
    let roots = [y + a / 500.0, y, y - b / 200.0];
    let [x, y, z]: Color = std::array::from_fn(|k| WHITE[k] * cube(roots[k]));
    let rgb = [
        3.2406 * x - 1.5372 * y - 0.4986 * z,
        -0.9689 * x + 1.8758 * y + 0.0415 * z,
        0.0557 * x - 0.2040 * y + 1.0570 * z,
    ];
    rgb.map(|c| compressed(c).clamp(0.0, 1.0))
}

fn linear(c: f64) -> f64 {
    if c > 0.04045 { ((c + 0.055) / 1.055).powf(2.4) } else { c / 12.92 }
}

fn compressed(c: f64) -> f64 {
    if c > 0.0031308 { 1.055 * c.powf(1.0 / 2.4) - 0.055 } else { 12.92 * c }
}

/// Hue, saturation and value, each 0 to 1.
fn hsv([r, g, b]: Color) -> Color {
    let (max, min) = (r.max(g).max(b), r.min(g).min(b));
    let range = max - min;
    if range == 0.0 {
        return [0.0, 0.0, max];
    }
    let sixths = match max {
        _ if r == max => (g - b) / range,
        _ if g == max => 2.0 + (b - r) / range,
        _ => 4.0 + (r - g) / range,
    };
    [(sixths / 6.0).rem_euclid(1.0), range / max, max]
}

fn rgb_of_hsv([h, s, v]: Color) -> Color {
    [5.0, 3.0, 1.0].map(|shift| {
        let k = (shift + 6.0 * h).rem_euclid(6.0);
        v - v * s * k.min(4.0 - k).clamp(0.0, 1.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn assert_near(a: Color, b: Color, tolerance: f64) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < tolerance), "{a:?} {b:?}");
    }

    /// The matrices of sRGB have four digits, so ends come back to three.
    #[test]
    fn the_ends_are_the_given_colours() {
        let colors = [[0.0; 3], [1.0; 3], [0.2, 0.9, 0.4], [0.9, 0.1, 0.3], [0.3, 0.2, 0.95]];
        for space in [ColorSpace::Rgb, ColorSpace::Hsv, ColorSpace::Lab, ColorSpace::Diverging] {
            for (a, b) in colors.iter().zip(&colors[1..]) {
                assert_near(space.between(*a, *b, 0.0), *a, 2e-3);
                assert_near(space.between(*a, *b, 1.0), *b, 2e-3);
            }
        }
    }

    #[test]
    fn the_middle_of_hsv_and_lab() {
        // from red over yellow to green
        let middle = ColorSpace::Hsv.between([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], 0.5);
        assert_near(middle, [1.0, 1.0, 0.0], 1e-12);
        // L* = 50 between black and white is the grey 119 of 255
        let middle = ColorSpace::Lab.between([0.0; 3], [1.0; 3], 0.5);
        assert_near(middle, [119.0 / 255.0; 3], 2e-3);
    }
}
