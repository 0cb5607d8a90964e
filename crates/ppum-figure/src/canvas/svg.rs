//! A page as SVG 1.1.

use std::fmt::Write as _;

use ppum::edge::Edge;
use ppum::printable::printable;
use ppum::vec2::Vec2;
use ppum_render::image::{Image, Rgba};
use ppum_render::png::{self, TextChunk};

use super::base64::base64;
use super::xml::escaped;
use super::{Align, Canvas, CanvasItem, CanvasPath, StrokeStyle, TextItem, UNSEEN, bezier_curves};
use crate::text::{self, FONT_FILE};

/// Fonts of letters: the one in the file, or where a program ignores that, the same or a similar
/// one of the system.
const FAMILY: &str = "'ppum DejaVu Sans','DejaVu Sans',Verdana,sans-serif";

/// Writes a page.
pub(super) fn file(canvas: &Canvas, dpi: f64, texts: &[TextChunk]) -> String {
    let [width, height] = canvas.size;
    let [across, down] = canvas.size.map(|n| number(f64::from(n) / dpi));
    let mut out = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" \
         width=\"{across}in\" height=\"{down}in\" viewBox=\"0 0 {width} {height}\">\n"
    );
    describe(&mut out, texts);
    if has_text(canvas) {
        font(&mut out);
    }
    content(&mut out, canvas);
    out.push_str("</svg>\n");
    out
}

/// Writes the file's metadata.
fn describe(out: &mut String, texts: &[TextChunk]) {
    let mut rest = String::new();
    for (key, text) in texts {
        let text = escaped(&printable(text));
        match key.as_str() {
            "Title" => *out += &format!("<title>{text}</title>\n"),
            "Description" => *out += &format!("<desc>{text}</desc>\n"),
            _ => {
                rest += &format!("<text key=\"{}\">{text}</text>\n", escaped(&printable(key)));
            }
        }
    }
    if !rest.is_empty() {
        *out += &format!("<metadata>\n<about xmlns=\"urn:ppum\">\n{rest}</about>\n</metadata>\n");
    }
}

fn has_text(canvas: &Canvas) -> bool {
    canvas.items.iter().any(|item| match item {
        CanvasItem::Text(_) => true,
        CanvasItem::Inset { canvas, .. } => has_text(canvas),
        _ => false,
    })
}

/// The font and how letters are set: one after another by their widths, as everywhere in figures.
fn font(out: &mut String) {
    *out += &format!(
        "<style>@font-face{{font-family:'ppum DejaVu Sans';src:url(data:font/ttf;base64,{})}}\
         text{{font-family:{FAMILY};font-kerning:none;font-variant-ligatures:none;white-space:pre}}</style>\n",
        base64(FONT_FILE)
    );
}

/// The paper and all items.
fn content(out: &mut String, canvas: &Canvas) {
    if canvas.paper[3] > 0 {
        let paint = paint("fill", canvas.paper);
        *out +=
            &format!("<rect width=\"{}\" height=\"{}\"{paint}/>\n", canvas.size[0], canvas.size[1]);
    }
    for item in &canvas.items {
        match item {
            CanvasItem::Picture { image, corner } => picture(out, image, *corner),
            CanvasItem::Fill { outline, color } => {
                element(out, &data(&outline.turned_alike(), true), &paint("fill", *color));
            }
            CanvasItem::Line { path, pen } => line(out, path, pen),
            CanvasItem::Text(line) => text_item(out, line),
            CanvasItem::Inset { corner: [x, y], canvas } => {
                let [width, height] = canvas.size;
                *out += &format!(
                    "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" overflow=\"hidden\">\n"
                );
                content(out, canvas);
                out.push_str("</svg>\n");
            }
        }
    }
}

fn picture(out: &mut String, image: &Image, [x, y]: [u32; 2]) {
    let [width, height] = image.size;
    // an image without pixels is no PNG, and nothing to see
    let Ok(bytes) = png::encode(image, &[]) else { return };
    *out += &format!(
        "<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
         style=\"image-rendering:optimizeSpeed;image-rendering:pixelated\" \
         xlink:href=\"data:image/png;base64,{}\"/>\n",
        base64(&bytes)
    );
}

fn line(out: &mut String, path: &CanvasPath, pen: &StrokeStyle) {
    let data = data(path, false);
    let mut stroke = |color: Rgba, width: f64, dashes: &str| {
        let (paint, width) = (paint("stroke", color), number(width));
        let style = format!(
            " fill=\"none\"{paint} stroke-width=\"{width}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"{dashes}"
        );
        element(out, &data, &style);
    };
    if let Some(halo) = pen.halo {
        stroke(halo.color, pen.width + 2.0 * halo.width, "");
    }
    let dashes = pen.dashes.map(|lengths| lengths.map(number).join(" "));
    let dashes = dashes.map_or(String::new(), |list| format!(" stroke-dasharray=\"{list}\""));
    stroke(pen.color, pen.width, &dashes);
}

fn element(out: &mut String, data: &str, style: &str) {
    if !data.is_empty() {
        *out += &format!("<path d=\"{data}\"{style}/>\n");
    }
}

/// The pieces of a path; those that lead to no place are left out.
fn data(path: &CanvasPath, is_closed: bool) -> String {
    let mut data = String::new();
    for points in path.pieces.iter().filter(|points| points.iter().all(|p| p.is_finite())) {
        let Some((first, rest)) = points.split_first() else { continue };
        let _ = write!(data, "M{}", place(*first));
        for p in rest {
            let _ = write!(data, "L{}", place(*p));
        }
        match rest {
            // a disc
            [] => data.push_str("h0"),
            _ if is_closed => data.push('Z'),
            _ => {}
        }
    }
    for curve in path.finite_curves() {
        let _ = write!(data, "M{}", place(curve[0].from));
        curve.iter().for_each(|edge| data.push_str(&command(edge)));
        if is_closed {
            data.push('Z');
        }
    }
    data
}

/// The command that leads along an edge: an arc, but for those that programs which form its centre
/// in single precision would not draw well.
fn command(edge: &Edge) -> String {
    let height = 0.5 * edge.bulge.abs() * edge.chord().length();
    if height <= UNSEEN {
        return format!("L{}", place(edge.to));
    }
    if edge.bulge.abs() < FLAT {
        let curve = |points: [Vec2; 3]| format!("C{}", points.map(place).join(" "));
        return bezier_curves(edge).into_iter().map(curve).collect();
    }
    // an end is known to a thousandth: of a nearly whole circle that is not enough
    let arc = |part: Edge| {
        let (radius, is_left) = (part.curvature().abs().recip(), u8::from(part.bulge > 0.0));
        format!("A{0} {0} 0 0 {is_left} {1}", number(radius), place(part.to))
    };
    edge.divided(std::f64::consts::PI).map(arc).collect()
}

/// Bulges below this are those of arcs whose radius is many times their chord.
const FLAT: f64 = 0.005;

fn place(p: Vec2) -> String {
    format!("{} {}", number(p.x), number(p.y))
}

fn text_item(out: &mut String, line: &TextItem) {
    let runs = text::runs(&line.text, line.size);
    if runs.is_empty() {
        return;
    }
    let (at, angle) = (line.at, line.angle.to_degrees());
    *out += &format!("<text x=\"{}\" y=\"{}\"", number(at.x), number(at.y));
    *out += &format!(" font-size=\"{}\"{}", number(line.size), paint("fill", line.color));
    match line.align {
        Align::Start => {}
        Align::Middle => out.push_str(" text-anchor=\"middle\""),
        Align::End => out.push_str(" text-anchor=\"end\""),
    }
    if angle != 0.0 {
        *out += &format!(" transform=\"rotate({} {})\"", number(-angle), place(at));
    }
    if let Some(halo) = line.halo {
        let (paint, width) = (paint("stroke", halo.color), number(2.0 * halo.width));
        *out += &format!(
            "{paint} stroke-width=\"{width}\" stroke-linejoin=\"round\" paint-order=\"stroke\""
        );
    }
    // other fonts must not change the length; letters that ours lacks have another one
    if text::missing(&line.text).is_empty() {
        *out += &format!(" textLength=\"{}\"", number(line.width()));
    }
    out.push('>');
    let mut lowered = 0.0;
    for run in runs {
        let text = escaped(&run.text);
        let (down, size) = (number(run.lowered - lowered), number(run.size));
        if run.lowered == lowered && run.size == line.size {
            out.push_str(&text);
        } else {
            *out += &format!("<tspan dy=\"{down}\" font-size=\"{size}\">{text}</tspan>");
        }
        lowered = run.lowered;
    }
    out.push_str("</text>\n");
}

/// A colour and its opacity for `fill` or `stroke`.
fn paint(what: &str, [red, green, blue, opacity]: Rgba) -> String {
    let color = format!(" {what}=\"#{red:02x}{green:02x}{blue:02x}\"");
    match opacity {
        255 => color,
        _ => format!("{color} {what}-opacity=\"{}\"", number(f64::from(opacity) / 255.0)),
    }
}

/// A number of pixels to a thousandth.
fn number(value: f64) -> String {
    // + 0 makes −0 a plain zero
    format!("{}", (value * 1000.0).round() / 1000.0 + 0.0)
}
