//! Random bodies, and the four formats that they are written in.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use ppum::vec2::{Vec2, vec2};
use ppum_testkit::random::Random;

/// A side of the outline: a line or an arc to the next corner, with a name.
#[derive(Clone, Debug)]
pub(crate) struct Side {
    pub(crate) from: Vec2,
    pub(crate) to: Vec2,
    /// Tangent of a quarter of the turn; 0 is a line.
    pub(crate) bulge: f64,
    pub(crate) name: String,
}

/// A body with an outline, circular holes and polygonal cracks.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) sides: Vec<Side>,
    pub(crate) circles: Vec<(Vec2, f64)>,
    pub(crate) cracks: Vec<Vec<Vec2>>,
}

impl Side {
    /// Centre and the angle of the begin around it.
    pub(crate) fn center(&self) -> Vec2 {
        let half = (self.to - self.from) * 0.5;
        self.from + half + half.left() * ((1.0 - self.bulge * self.bulge) / (2.0 * self.bulge))
    }

    /// A point of the side, s from 0 to 1.
    pub(crate) fn at(&self, s: f64) -> Vec2 {
        if self.bulge == 0.0 {
            return self.from + (self.to - self.from) * s;
        }
        let out = self.from - self.center();
        let (sin, cos) = (4.0 * self.bulge.atan() * s).sin_cos();
        self.center() + out * cos + out.left() * sin
    }
}

impl Body {
    /// A star of 5 to 12 corners around a place, a third of its sides bulged; up to 3 holes and 2
    /// cracks inside of all sides.
    pub(crate) fn random(random: &mut Random) -> Self {
        let (n, scale) = (5 + random.below(8), 10_f64.powf(random.between(-2.0, 3.0)));
        let center = vec2(random.between(-3.0, 3.0), random.between(-3.0, 3.0)) * scale;
        let corner = |(k, radius): (usize, f64)| {
            let (sin, cos) = (TAU * k as f64 / n as f64).sin_cos();
            center + vec2(cos, sin) * (radius * scale)
        };
        let radii: Vec<_> = (0..n).map(|_| random.between(0.8, 1.2)).collect();
        let corners: Vec<_> = radii.into_iter().enumerate().map(corner).collect();
        let side = |k: usize| Side {
            from: corners[k],
            to: corners[(k + 1) % n],
            bulge: if random.below(3) == 0 { random.between(0.05, 0.3) } else { 0.0 },
            name: format!("side {}", k / 2),
        };
        let sides = (0..n).map(side).collect();
        let place = |k: usize| {
            center + vec2((2.1 * k as f64).cos(), (2.1 * k as f64).sin()) * (0.35 * scale)
        };
        let circles =
            (0..random.below(4)).map(|k| (place(k), scale * (0.05 + 0.02 * k as f64))).collect();
        let crack = |k: usize| {
            let at = center + vec2(-0.05, 0.06 * (k as f64 - 0.5)) * scale;
            vec![at, at + vec2(0.06, 0.01) * scale, at + vec2(0.11, 0.0) * scale]
        };
        Self { sides, circles, cracks: (0..random.below(3)).map(crack).collect() }
    }

    /// Points on the outline, eight by side.
    pub(crate) fn outline(&self) -> Vec<Vec2> {
        let sides = self.sides.iter().flat_map(|side| (0..8).map(|k| side.at(f64::from(k) / 8.0)));
        sides.collect()
    }

    /// Lines, arcs, circles and polylines, in any order and any direction.
    pub(crate) fn dxf(&self, random: &mut Random) -> String {
        let mut entities: Vec<String> = Vec::new();
        for side in &self.sides {
            let is_back = random.below(2) == 0;
            let [a, b] = if is_back { [side.to, side.from] } else { [side.from, side.to] };
            let head = |kind: &str| format!("0\n{kind}\n5\n2F\n8\n{}\n", side.name);
            entities.push(match (side.bulge, random.below(2)) {
                (0.0, _) => head("LINE") + &pair(10, a) + &pair(11, b),
                (bulge, 0) => {
                    let bulge = if is_back { -bulge } else { bulge };
                    head("LWPOLYLINE")
                        + "90\n2\n70\n0\n"
                        + &pair(10, a)
                        + &format!("42\n{bulge:?}\n")
                        + &pair(10, b)
                }
                (bulge, _) => {
                    let out = side.from - side.center();
                    let from = out.y.atan2(out.x).to_degrees();
                    let to = from + (4.0 * bulge.atan()).to_degrees();
                    head("ARC")
                        + &pair(10, side.center())
                        + &format!("40\n{:?}\n50\n{from:?}\n51\n{to:?}\n", out.length())
                }
            });
        }
        for (center, radius) in &self.circles {
            entities.push(
                "0\nCIRCLE\n8\n0\n".to_owned() + &pair(10, *center) + &format!("40\n{radius:?}\n"),
            );
        }
        for crack in &self.cracks {
            let vertices: String =
                crack.iter().map(|p| format!("0\nVERTEX\n8\n0\n{}", pair(10, *p))).collect();
            entities.push(format!("0\nPOLYLINE\n8\n0\n66\n1\n70\n0\n{vertices}0\nSEQEND\n"));
        }
        shuffle(&mut entities, random);
        format!("0\nSECTION\n2\nENTITIES\n{}0\nENDSEC\n0\nEOF\n", entities.concat())
    }

    /// Paths and circles with y down, under a turned, scaled and shifted group.
    pub(crate) fn svg(&self, random: &mut Random) -> String {
        let angle = random.between(-180.0, 180.0);
        let (sin, cos) = (-angle).to_radians().sin_cos();
        // the page turned back, so that the group's transform restores it
        let own = |p: Vec2| {
            let p = vec2(p.x, -p.y) * 0.5;
            vec2(cos * p.x - sin * p.y, sin * p.x + cos * p.y)
        };
        let mut elements: Vec<String> = Vec::new();
        for side in &self.sides {
            let [a, b] = [side.from, side.to].map(own);
            let radius = (side.from - side.center()).length() * 0.5;
            let d = match side.bulge {
                0.0 => format!("M{:?},{:?}L{:?} {:?}", a.x, a.y, b.x, b.y),
                // counter-clockwise turns clockwise where y points down
                _ => format!(
                    "M {:?} {:?} A{radius:?} {radius:?} 0 0 0 {:?} {:?}",
                    a.x, a.y, b.x, b.y
                ),
            };
            elements.push(format!("<path id=\"{}\" d=\"{d}\"/>\n", side.name));
        }
        for (center, radius) in &self.circles {
            let center = own(*center);
            elements.push(format!(
                "<circle cx=\"{:?}\" cy=\"{:?}\" r=\"{:?}\"/>\n",
                center.x,
                center.y,
                0.5 * radius
            ));
        }
        for crack in &self.cracks {
            let points: String =
                crack.iter().map(|p| format!("{:?},{:?} ", own(*p).x, own(*p).y)).collect();
            elements.push(format!("<polyline points=\"{points}\"/>\n"));
        }
        shuffle(&mut elements, random);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\"><g transform=\"scale(2) rotate({angle:?})\">\n{}</g></svg>",
            elements.concat()
        )
    }

    /// Points, lines, circle arcs and physical curves; lengths by a variable.
    pub(crate) fn geo(&self) -> String {
        let (mut text, mut tag) = ("h = 1/2; // a variable\n".to_owned(), 0);
        let mut point = |p: Vec2, text: &mut String| {
            tag += 1;
            let _ = writeln!(text, "Point({tag}) = {{2*h*{:?}, {:?}*2*h, 0, h}};", p.x, p.y);
            tag
        };
        let corners: Vec<_> = self.sides.iter().map(|side| point(side.from, &mut text)).collect();
        let mut curve = 100;
        for (k, side) in self.sides.iter().enumerate() {
            curve += 1;
            let [a, b] = [corners[k], corners[(k + 1) % corners.len()]];
            if side.bulge == 0.0 {
                let _ = writeln!(text, "Line({curve}) = {{{a}, {b}}};");
            } else {
                let center = point(side.center(), &mut text);
                let _ = writeln!(text, "Circle({curve}) = {{{a}, {center}, {b}}};");
            }
            let _ = writeln!(text, "Physical Curve(\"{}\", {curve}) += {{{curve}}};", side.name);
        }
        for (center, radius) in &self.circles {
            let middle = point(*center, &mut text);
            let [right, top, left] = [0.0, 0.5 * PI, PI].map(|angle: f64| {
                point(*center + vec2(angle.cos(), angle.sin()) * *radius, &mut text)
            });
            let bottom = point(*center - vec2(0.0, *radius), &mut text);
            for [a, b] in [[right, top], [top, left], [left, bottom], [bottom, right]] {
                curve += 1;
                let _ = writeln!(text, "Circle({curve}) = {{{a}, {middle}, {b}}};");
            }
        }
        for crack in &self.cracks {
            curve += 1;
            let points: Vec<String> =
                crack.iter().map(|p| point(*p, &mut text).to_string()).collect();
            let _ = writeln!(text, "Line({curve}) = {{{}}};", points.join(", "));
        }
        text + "Curve Loop(1) = {101:105};\nPlane Surface(1) = {1};\n"
    }
}

fn pair(code: i32, p: Vec2) -> String {
    format!("{code}\n{:?}\n{}\n{:?}\n", p.x, code + 10, p.y)
}

fn shuffle(all: &mut [String], random: &mut Random) {
    (1..all.len()).for_each(|k| all.swap(k, random.below(k + 1)));
}
