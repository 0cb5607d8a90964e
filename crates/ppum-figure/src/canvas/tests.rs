//! Pages in all three forms.

use std::f64::consts::FRAC_PI_2;

use ppum::vec2::vec2;
use ppum_testkit::random::Random;
use roxmltree::{Document, Node};

use super::*;

const RED: Rgba = [200, 30, 20, 255];
const PALE: Rgba = [20, 60, 200, 128];
const WHITE: Rgba = [255, 255, 255, 255];

fn picture() -> Image {
    let mut image = Image::filled([30, 20], [0, 120, 60, 255]);
    let pixels = image.rgba.as_chunks_mut::<4>().0;
    pixels.iter_mut().take(200).for_each(|pixel| *pixel = [90, 10, 160, 77]);
    pixels[..3].fill([0; 4]);
    image
}

/// One of each item, and text that XML, fonts or lines of their own could trip over.
pub(super) fn page() -> Canvas {
    let mut inset = Canvas::new([60, 40], [240, 240, 200, 255]);
    let across = CanvasPath::through(vec![vec2(-30.0, -10.0), vec2(90.0, 60.0)]);
    inset.items.push(CanvasItem::Line { path: across, pen: StrokeStyle::new(RED, 6.0) });
    let mut page = Canvas::new([240, 180], WHITE);
    let mut boxes = CanvasPath::default();
    boxes.rect(vec2(150.0, 20.0), vec2(190.0, 60.0));
    boxes.rect(vec2(210.0, 40.0), vec2(170.0, 80.0));
    let mut lines =
        CanvasPath::through(vec![vec2(20.0, 160.0), vec2(120.0, 110.0), vec2(200.0, 165.0)]);
    lines.line(vec2(60.0, 100.0), vec2(150.0, 170.0));
    let dots =
        CanvasPath::of_pieces(vec![vec![vec2(30.0, 110.0)], vec![], vec![vec2(f64::NAN, 1.0)]]);
    let text = |text: &str, at| TextItem::new(text, 14.0, at, [38, 38, 42, 255]);
    let halo = Some(Halo { color: [255, 230, 0, 200], width: 2.0 });
    page.items = vec![
        CanvasItem::Picture { image: picture(), corner: [10, 12] },
        CanvasItem::Fill { outline: boxes, color: PALE },
        CanvasItem::Inset { corner: [60, 15], canvas: inset },
        CanvasItem::Line {
            path: lines.clone(),
            pen: StrokeStyle::new(RED, 5.0).with_halo(PALE, 3.0),
        },
        CanvasItem::Line { path: lines, pen: StrokeStyle::new(WHITE, 1.0).dashed(6.0, 4.0) },
        CanvasItem::Line { path: dots, pen: StrokeStyle::new(PALE, 12.0) },
        CanvasItem::Text(text("σ_{xy} of <A & B>  \"μ\"", vec2(10.0, 90.0))),
        CanvasItem::Text(
            TextItem { halo, ..text("upwards", vec2(225.0, 90.0)) }
                .aligned(Align::Middle)
                .upwards(),
        ),
        CanvasItem::Text(text("ends", vec2(200.0, 100.0)).aligned(Align::End)),
        CanvasItem::Text(text("板 \u{1b}[0m\u{ffff}", vec2(10.0, 174.0))),
        CanvasItem::Text(text("", vec2(10.0, 174.0))),
    ];
    page
}

fn texts() -> Vec<TextChunk> {
    let text = |key: &str, text: &str| (key.to_owned(), text.to_owned());
    vec![
        text("Title", "A & B < σ"),
        text("Software", "ppum 0"),
        text("Description", "what it shows"),
        text("ppum:view", "center 0,0 \"so\""),
    ]
}

fn number(node: Node<'_, '_>, name: &str) -> f64 {
    node.attribute(name).unwrap_or_else(|| panic!("{name} of {node:?}")).parse().unwrap()
}

fn named<'a>(document: &'a Document<'_>, name: &str) -> Vec<Node<'a, 'a>> {
    let nodes = document.descendants().filter(|node| node.tag_name().name() == name);
    nodes.filter(|node| node.tag_name().namespace() != Some("urn:ppum")).collect()
}

#[test]
fn every_item_is_in_the_svg() {
    let svg = page().svg(120.0, &texts());
    let document = Document::parse(&svg).unwrap();
    let root = document.root_element();
    let found = ["width", "height", "viewBox"].map(|name| root.attribute(name).unwrap());
    assert_eq!(found, ["2in", "1.5in", "0 0 240 180"]);
    let counts = ["image", "path", "text", "svg"].map(|name| named(&document, name).len());
    // boxes, inset's line, line and halo, dashes, dots
    assert_eq!(counts, [1, 6, 4, 2]);
    let inset = named(&document, "svg")[1];
    let place = ["x", "y", "width", "height"].map(|name| number(inset, name));
    assert_eq!((place, inset.attribute("overflow")), ([60.0, 15.0, 60.0, 40.0], Some("hidden")));
    assert_eq!(named(&document, "title")[0].text(), Some("A & B < σ"));
    assert_eq!(named(&document, "desc")[0].text(), Some("what it shows"));
    let entry = document.descendants().find(|node| node.attribute("key") == Some("ppum:view"));
    assert_eq!(entry.unwrap().text(), Some("center 0,0 \"so\""));
    let dashed =
        named(&document, "path").into_iter().find_map(|node| node.attribute("stroke-dasharray"));
    assert_eq!(dashed, Some("6 4"));
    let paper = named(&document, "rect");
    assert_eq!(
        paper.iter().map(|node| node.attribute("fill").unwrap()).collect::<Vec<_>>(),
        ["#ffffff", "#f0f0c8"]
    );
}

#[test]
fn pictures_in_the_svg_are_without_loss() {
    let svg = page().svg(96.0, &[]);
    let document = Document::parse(&svg).unwrap();
    let node = named(&document, "image")[0];
    let link = node.attribute(("http://www.w3.org/1999/xlink", "href")).unwrap();
    let expected = ppum_render::png::encode(&picture(), &[]).unwrap();
    assert_eq!(link, format!("data:image/png;base64,{}", base64::base64(&expected)));
    assert!(node.attribute("style").unwrap().ends_with("image-rendering:pixelated"));
    let place = ["x", "y", "width", "height"].map(|name| number(node, name));
    assert_eq!(place, [10.0, 12.0, 30.0, 20.0]);
}

/// Whatever font a program takes, lines have their length; it is the one that everything is
/// placed by.
#[test]
fn text_in_the_svg_has_its_length() {
    let page = page();
    let svg = page.svg(96.0, &[]);
    let document = Document::parse(&svg).unwrap();
    let lines: Vec<&TextItem> = page
        .items
        .iter()
        .filter_map(|item| match item {
            CanvasItem::Text(line) if !line.text.is_empty() => Some(line),
            _ => None,
        })
        .collect();
    let found = named(&document, "text");
    assert_eq!(found.len(), lines.len());
    for (node, line) in found.iter().zip(lines) {
        assert_eq!(node.attribute("textLength").is_some(), text::missing(&line.text).is_empty());
        if node.has_attribute("textLength") {
            assert!((number(*node, "textLength") - line.width()).abs() < 6e-4, "{}", line.text);
        }
        let content: String =
            node.descendants().filter(Node::is_text).filter_map(|n| n.text()).collect();
        let whole: String = text::runs(&line.text, 1.0).into_iter().map(|run| run.text).collect();
        assert_eq!(content, whole.replace('\u{ffff}', "\u{fffd}"));
        assert_eq!(number(*node, "font-size"), line.size);
    }
    assert!(found[0].children().any(|n| n.attribute("dy") == Some("2.38")), "a lowered subscript");
    assert_eq!(found[1].attribute("transform"), Some("rotate(-90 225 90)"));
    assert_eq!(found[1].attribute("paint-order"), Some("stroke"));
}

#[test]
fn a_page_without_letters_carries_no_font() {
    let mut page = page();
    assert!(page.svg(96.0, &[]).contains("@font-face"));
    page.items.retain(|item| !matches!(item, CanvasItem::Text(_)));
    assert!(!page.svg(96.0, &[]).contains("@font-face"));
    let pdf = String::from_utf8_lossy(&page.pdf(96.0, &[])).into_owned();
    assert!(!pdf.contains("/FontFile2"));
}

/// Lines of a fill that turn against each other take nothing from each other.
#[test]
fn fills_turn_one_way() {
    let mut path = CanvasPath::default();
    path.rect(vec2(0.0, 0.0), vec2(4.0, 4.0));
    path.rect(vec2(6.0, 2.0), vec2(2.0, 6.0));
    path.pieces.push(vec![vec2(0.0, 0.0), vec2(0.0, 3.0), vec2(3.0, 0.0)]);
    let area = |points: &Vec<Vec2>| {
        points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| a.cross(*b)).sum::<f64>()
    };
    let areas: Vec<f64> = path.turned_alike().pieces.iter().map(area).collect();
    assert_eq!(areas, [32.0, 32.0, 9.0]);
}

fn random_arc(random: &mut Random, size: f64) -> Edge {
    let mut end = || vec2(random.between(0.1, 0.9), random.between(0.1, 0.9)) * size;
    let (from, to) = (end(), end());
    Edge { from, to, bulge: random.between(-3.0, 3.0) }
}

fn line_of(edges: &[Edge]) -> CanvasItem {
    let mut path = CanvasPath::default();
    edges.iter().for_each(|edge| path.edge(*edge));
    CanvasItem::Line { path, pen: StrokeStyle::new(RED, 3.0).with_halo(PALE, 2.0) }
}

fn image_of(item: CanvasItem) -> Image {
    Canvas { size: [160, 160], paper: WHITE, items: vec![item] }.image()
}

/// Largest difference of the shades of two images.
fn difference(a: &Image, b: &Image) -> u8 {
    a.rgba.iter().zip(&b.rgba).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or(0)
}

/// Pixels of an arc are those of a polyline of many chords, of the reversed arc and of ten parts.
#[test]
fn pixels_of_arcs_are_those_of_many_chords() {
    let mut random = Random(31);
    for _ in 0..40 {
        let arc = random_arc(&mut random, 160.0);
        let image = image_of(line_of(&[arc]));
        let chords = CanvasPath::through((0..=4000).map(|k| arc.at(f64::from(k) / 4e3)).collect());
        let pen = StrokeStyle::new(RED, 3.0).with_halo(PALE, 2.0);
        // a shade for each hundredth of a pixel, and chords are a 64th away
        let limit = image_of(CanvasItem::Line { path: chords, pen });
        assert!(difference(&image, &limit) <= 5, "{arc:?}");
        assert!(difference(&image, &image_of(line_of(&[arc.reversed()]))) <= 1, "{arc:?}");
        let parts: Vec<Edge> =
            (0..10).map(|k| arc.part([k, k + 1].map(|k| f64::from(k) / 10.0))).collect();
        assert!(difference(&image, &image_of(line_of(&parts))) <= 5, "{arc:?}");
        let flipped = line_of(&[arc]).flipped([true, false], [160, 160]);
        let (flipped, size) = (image_of(flipped), 160);
        let pixel = |i: u32, j: u32| flipped.pixel(size - 1 - i, j);
        let all = (0..size).flat_map(|i| (0..size).map(move |j| (i, j)));
        let most = all.flat_map(|(i, j)| {
            image.pixel(i, j).into_iter().zip(pixel(i, j)).map(|(a, b)| a.abs_diff(b))
        });
        assert!(most.max().unwrap_or(0) <= 5, "{arc:?}");
    }
}

/// The edges of a path of an SVG file.
fn edges_of(data: &str) -> Vec<Edge> {
    let (mut edges, mut at) = (Vec::new(), Vec2::ZERO);
    let starts: Vec<usize> = data.match_indices(char::is_alphabetic).map(|(k, _)| k).collect();
    for (k, &start) in starts.iter().enumerate() {
        let end = starts.get(k + 1).copied().unwrap_or(data.len());
        let numbers: Vec<f64> =
            data[start + 1..end].split_whitespace().map(|n| n.parse().unwrap()).collect();
        let to = vec2(numbers[numbers.len() - 2], numbers[numbers.len() - 1]);
        if let ("A", [radius, other, _, large, left, ..]) = (&data[start..=start], &numbers[..]) {
            assert_eq!((radius, *large), (other, 0.0));
            let half = (0.5 * (to - at).length() / radius).min(1.0).asin();
            let bulge = (0.5 * half).tan() * (2.0 * left - 1.0);
            edges.push(Edge { from: at, to, bulge });
        } else if &data[start..=start] == "L" {
            edges.push(Edge::segment([at, to]));
        }
        at = to;
    }
    edges
}

/// Arcs are arcs in SVG: on the same circle to the thousandths that numbers have.
#[test]
fn arcs_are_arcs_in_the_svg() {
    let mut random = Random(32);
    for _ in 0..200 {
        let arc = random_arc(&mut random, 160.0);
        if arc.bulge.abs() < 0.01 {
            continue;
        }
        let page = Canvas { size: [160, 160], paper: WHITE, items: vec![line_of(&[arc])] };
        let svg = page.svg(96.0, &[]);
        let document = Document::parse(&svg).unwrap();
        let edges = edges_of(named(&document, "path")[0].attribute("d").unwrap());
        assert!(!edges.is_empty() && edges.iter().all(Edge::is_arc));
        let sweep: f64 = edges.iter().map(Edge::sweep).sum();
        assert!((sweep - arc.sweep()).abs() < 0.02, "{arc:?} {edges:?}");
        // of half a circle whose radius is rounded up the middle is not known as well
        let of = |t: f64| edges.iter().map(|e| e.distance(arc.at(t))).fold(f64::INFINITY, f64::min);
        let most = (0..=20).map(|k| of(f64::from(k) / 20.0)).fold(0.0, f64::max);
        let radius = arc.curvature().abs().recip();
        assert!(most < 2e-3 + (2e-3 * radius).sqrt().min(0.6), "{most} {arc:?} {edges:?}");
    }
}

/// Cubics of arcs lie on them and meet.
#[test]
fn cubics_lie_on_their_arcs() {
    let mut random = Random(33);
    for size in [10.0, 100.0, 1e4] {
        for _ in 0..50 {
            let arc = random_arc(&mut random, size);
            let mut from = arc.from;
            for [a, b, to] in bezier_curves(&arc) {
                for k in 0..=10 {
                    let (t, u) = (f64::from(k) / 10.0, 1.0 - f64::from(k) / 10.0);
                    let p = from * (u * u * u)
                        + a * (3.0 * u * u * t)
                        + b * (3.0 * u * t * t)
                        + to * (t * t * t);
                    assert!(arc.distance(p) < 1.1 * UNSEEN, "{arc:?} {t}");
                }
                from = to;
            }
            assert_eq!(from, arc.to);
        }
    }
    let pdf = Canvas {
        size: [9, 9],
        paper: WHITE,
        items: vec![line_of(&[random_arc(&mut random, 9.0)])],
    };
    let content = &streams(&pdf.pdf(96.0, &[]))[0].1;
    assert!(String::from_utf8_lossy(content).lines().any(|line| line.ends_with(" c")));
}

/// The streams of a PDF file, decompressed, each with its dictionary before.
fn streams(pdf: &[u8]) -> Vec<(String, Vec<u8>)> {
    let find = |from: usize, word: &[u8]| {
        pdf[from..].windows(word.len()).position(|w| w == word).map(|at| from + at)
    };
    let (mut all, mut from) = (Vec::new(), 0);
    while let Some(at) = find(from, b"\nstream\n") {
        let start = at + b"\nstream\n".len();
        let end = find(start, b"\nendstream").unwrap();
        let head = String::from_utf8_lossy(&pdf[from..at]).into_owned();
        let head = head.rsplit(" obj\n").next().unwrap().to_owned();
        all.push((head, miniz_oxide::inflate::decompress_to_vec_zlib(&pdf[start..end]).unwrap()));
        from = end + b"\nendstream".len();
    }
    all
}

#[test]
fn pdf_pages_have_their_physical_size_and_texts() {
    let pdf = page().pdf(120.0, &texts());
    let whole = String::from_utf8_lossy(&pdf).into_owned();
    assert!(whole.starts_with("%PDF-1.7") && whole.contains("/MediaBox [0 0 144 108]"));
    assert!(whole.contains("/Creator (ppum 0)") && whole.contains("/Subject (what it shows)"));
    assert!(whole.contains("/ppum:view (center 0,0 \"so\")"));
}

/// Text is found again by the codes of the font: letters are letters.
#[test]
fn text_in_the_pdf_can_be_copied() {
    let streams = streams(&page().pdf(96.0, &[]));
    let map = streams.iter().find_map(|(_, bytes)| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        text.contains("beginbfchar").then_some(text)
    });
    let map = map.expect("a map from codes to characters");
    let hex = |text: &str| u32::from_str_radix(text.trim_matches(['<', '>']), 16).unwrap();
    let pairs = map.lines().filter_map(|line| {
        let (code, character) = line.strip_prefix('<')?.split_once("> <")?;
        Some((hex(code), char::from_u32(hex(character))?))
    });
    let found: String = pairs.map(|(_, c)| c).collect();
    for c in "σxyof<A&B>\"μupwardsen板".chars() {
        assert_eq!(found.matches(c).count(), 1, "{c} in {found}");
    }
    assert!(
        streams.iter().any(|(head, bytes)| head.contains("/Length1") && bytes == text::FONT_FILE)
    );
}

#[test]
fn pictures_in_the_pdf_are_without_loss() {
    let streams = streams(&page().pdf(96.0, &[]));
    let unfiltered = |bytes: &[u8], width: usize| {
        let mut above = vec![0u8; width];
        let rows = bytes.chunks_exact(width + 1).flat_map(|row| {
            assert_eq!(row[0], 2);
            above = row[1..].iter().zip(&above).map(|(a, b)| a.wrapping_add(*b)).collect();
            above.clone()
        });
        rows.collect::<Vec<u8>>()
    };
    let picture = picture();
    let pixels = picture.rgba.as_chunks::<4>().0;
    let named = |color: &str| {
        streams.iter().find(|(head, _)| head.contains("/Image") && head.contains(color)).unwrap()
    };
    let (head, colors) = named("/DeviceRGB");
    assert!(head.contains("/Width 30") && head.contains("/Height 20") && head.contains("/SMask"));
    let expected: Vec<u8> = pixels.iter().flat_map(|p| [p[0], p[1], p[2]]).collect();
    assert_eq!(unfiltered(colors, 90), expected);
    let expected: Vec<u8> = pixels.iter().map(|p| p[3]).collect();
    assert_eq!(unfiltered(&named("/DeviceGray").1, 30), expected);
}

#[test]
fn turned_text_starts_where_it_should() {
    let line = TextItem::new("abc", 10.0, vec2(50.0, 60.0), RED).aligned(Align::End).upwards();
    assert_eq!(line.angle, FRAC_PI_2);
    assert!((line.start() - vec2(50.0, 60.0 + line.width())).length() < 1e-9);
}
