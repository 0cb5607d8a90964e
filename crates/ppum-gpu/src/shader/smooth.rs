//! The smooth term of a patch where all patches have the same degree: a shader without loops. And
//! what else reads texels of coefficients once each.
//!
//! `smooth_of` of `wgsl/smooth.wgsl` reads a degree and runs loops over coefficients. Here the same
//! nested Horner schemes are written out for one degree, and each texel of coefficients is
//! loaded once.

use std::fmt::Write;

use ppum::dataset::monomials;

/// Numbers of a jet: v, x, y.
const MEMBERS: [&str; 3] = ["v", "x", "y"];

/// `smooth_of` for a degree, `lanes` components side by side, and derivatives up to an order.
pub(crate) fn straight_smooth(degree: usize, lanes: usize, order: u32) -> String {
    let count = monomials(degree);
    // the head, the coefficients without the constant, high and low
    let slots = count + 2;
    let per_texel = 4 / lanes;
    let mut text = "fn smooth_of(address: u32, coordinates: Coordinates) -> Smooth {\n".to_owned();
    for texel in 0..slots.div_ceil(per_texel) {
        let _ = writeln!(text, "    let q{texel} = load(address + {texel}u);");
    }
    let slot = |k: usize| slot(k, lanes);
    text += "    let xi = coordinates.xi;\n";
    let mut lines = ShaderLines { text, order, count: 0 };
    let sums = lines.polynomial(degree, |k| (k + 1 < count).then(|| slot(k + 1)));
    let mut text = lines.text;
    text += "    var out: Smooth;\n";
    for (member, sum) in MEMBERS.iter().zip(&sums) {
        if let Some(sum) = sum {
            let _ = writeln!(text, "    out.v[0].{member} = {sum}{};", slopes(member));
        }
    }
    let _ = writeln!(text, "    out.high[0] = {};", slot(count));
    let _ = writeln!(text, "    out.low[0] = {};", slot(count + 1));
    text + "    out.present = true;\n    out.terms = q0.x;\n    out.others = address + (q0.y >> 8u);\n    return out;\n}\n"
}

/// The function that reads the constants of four functions, each texel of them once.
pub(crate) fn four_constants(lanes: usize, groups: usize) -> String {
    let count = 4 * groups;
    let mut text = format!("fn four_constants(address: u32) -> array<Lanes, {count}> {{\n");
    // the head is the first in the room of all lanes
    let (per_texel, slots) = (4 / lanes, count + 1);
    for texel in 0..slots.div_ceil(per_texel) {
        let _ = writeln!(text, "    let q{texel} = load(address + {texel}u);");
    }
    let all: Vec<String> = (1..slots).map(|k| slot(k, lanes)).collect();
    let _ = writeln!(text, "    return array<Lanes, {count}>({});\n}}", all.join(", "));
    text
}

/// The sums of weights times constants over the patches of a pixel, and the functions that add to
/// them and take them times the functions: these are evaluated once a pixel.
///
/// ```text
/// Σ_i W_i Σ_k c_ik f_k = Σ_k f_k C_k     C_k = Σ_i W_i c_ik
/// ```
pub(crate) fn factors(groups: usize, order: u32) -> String {
    let count = 4 * groups;
    let members = &MEMBERS[..[1, 3][order as usize]];
    let mut text = "struct Factors {\n    are_there: bool,\n".to_owned();
    for member in members {
        let _ = writeln!(text, "    {member}: array<Lanes, {count}>,");
    }
    text += "}\nfn add_factors(sums: ptr<function, Sums>, term: Smooth, w: Jet) {\n";
    text += "    let are_there = term.terms > 0u;\n";
    text += "    (*sums).factors.are_there |= are_there;\n";
    text += "    let all = four_constants(term.others);\n";
    for k in 0..count {
        // what is there else is no number, perhaps
        let _ = writeln!(text, "    let c{k} = select(Lanes(), all[{k}], are_there);");
        for member in members {
            let _ = writeln!(text, "    (*sums).factors.{member}[{k}] += w.{member} * c{k};");
        }
    }
    text += "}\nfn times_factors(f: Functions, sums: Factors) -> array<Jets, GROUPS> {\n";
    text += "    var out: array<Jets, GROUPS>;\n    var sum: Jets;\n";
    for k in 0..count {
        for member in members {
            let _ = writeln!(text, "    sum.{member} = sums.{member}[{k}];");
        }
        let (entry, group) = (k / groups, k % groups);
        let product = format!("jets_times(functions_entry(f, {entry}u), sum)");
        let _ = writeln!(text, "    out[{group}] = jets_plus(out[{group}], {product});");
    }
    text + "    return out;\n}\n"
}

/// The numbers of all lanes in the texels `q0`, `q1`, ….
fn slot(k: usize, lanes: usize) -> String {
    match lanes {
        2 => format!("bitcast<vec2<f32>>(q{}.{})", k / 2, ["xy", "zw"][k % 2]),
        _ => format!("bitcast<vec4<f32>>(q{k})"),
    }
}

/// The chain rule for ξ.
fn slopes(member: &str) -> String {
    let axes = member.chars().filter(|axis| *axis != 'v');
    axes.map(|axis| format!(" * coordinates.inverse.{axis}")).collect()
}

/// A sum that may be zero, for which there is no name then.
type Term = Option<String>;

/// Lines of the function so far.
struct ShaderLines {
    text: String,
    order: u32,
    count: usize,
}

impl ShaderLines {
    /// The sums over η of sums over ξ, in the order of [`MEMBERS`]; half the last. `coefficient`
    /// gives none for the constant.
    fn polynomial(&mut self, degree: usize, coefficient: impl Fn(usize) -> Term) -> [Term; 3] {
        let mut sum: [Term; 3] = Default::default();
        let mut next = 0;
        for row in 0..=degree {
            let [mut p, mut px]: [Term; 2] = Default::default();
            for _ in 0..=row {
                if self.order >= 1 {
                    px = self.step(px, "xi.x", p.clone());
                }
                p = self.step(p, "xi.x", coefficient(next));
                next += 1;
            }
            let [v, x, y] = sum;
            let y = if self.order >= 1 { self.step(y, "xi.y", v.clone()) } else { None };
            let x = if self.order >= 1 { self.step(x, "xi.y", px) } else { None };
            sum = [self.step(v, "xi.y", p), x, y];
        }
        sum
    }

    /// A step of Horner's scheme, sum · factor + term.
    fn step(&mut self, sum: Term, factor: &str, term: Term) -> Term {
        let value = match (sum, term) {
            (None, None) => return None,
            (None, Some(term)) => term,
            (Some(sum), None) => format!("{sum} * {factor}"),
            (Some(sum), Some(term)) => format!("{sum} * {factor} + {term}"),
        };
        let name = format!("t{}", self.count);
        self.count += 1;
        let _ = writeln!(self.text, "    let {name} = {value};");
        Some(name)
    }
}
