//! Files that nobody can trust.

use std::time::Duration;

use ppum_import::{DrawingFormat, ImportOptions, read};
use ppum_testkit::processor::thread_time;
use ppum_testkit::random::Random;

use crate::parts::Body;

fn all(body: &Body, random: &mut Random) -> [(String, DrawingFormat); 3] {
    let (dxf, svg) = (body.dxf(random), body.svg(random));
    [(dxf, DrawingFormat::Dxf), (svg, DrawingFormat::Svg), (body.geo(), DrawingFormat::Geo)]
}

const MESH: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 1 1 0\n1 0 0 0 1 0 0 1 5 0\n1 0 0 0 1 1 0 0 0\n$EndEntities\n\
                    $Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n$Elements\n2 2 1 2\n1 1 1 1\n1 1 2\n2 1 3 1\n2 1 2 3 4\n$EndElements\n";

/// Whatever is damaged, reading ends with a drawing, whose problem file is TOML, or with a message.
#[test]
fn damaged_files() {
    let mut random = Random(6);
    let (mut read_well, mut refused) = (0, 0);
    for _ in 0..300 {
        let body = Body::random(&mut random);
        let files =
            all(&body, &mut random).into_iter().chain([(MESH.to_owned(), DrawingFormat::Msh)]);
        for (text, format) in files.flat_map(|file| std::iter::repeat_n(file, 8)) {
            let damaged = damage(text.into_bytes(), &mut random);
            match read(&damaged, format, &ImportOptions::default()) {
                Ok(drawing) => {
                    read_well += 1;
                    let text = drawing.problem_file("a", "b");
                    assert!(text.parse::<toml::Table>().is_ok(), "{text}");
                }
                Err(error) => {
                    refused += 1;
                    assert!(error.to_string().len() > 20);
                }
            }
        }
    }
    assert!(read_well > 300 && refused > 300, "{read_well} {refused}");
}

/// Changes, doubles or cuts a piece of a file.
fn damage(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    for _ in 0..1 + random.below(3) {
        let at = random.below(bytes.len());
        let end = (at + 1 + random.below(20)).min(bytes.len());
        match random.below(6) {
            0 => bytes.truncate(at + 1),
            1 => bytes[at] = random.pick(b"0123456789.-e \n,;{}<>\"'()\xff\0"),
            2 => drop(bytes.drain(at..end)),
            3 => {
                let piece = bytes[at..end].to_vec();
                bytes.splice(at..at, piece);
            }
            4 => drop(
                bytes.splice(at..end, random.pick(&["nan", "1e308", "-1e999", "inf", "0"]).bytes()),
            ),
            _ => bytes.swap(at, end - 1),
        }
        if bytes.is_empty() {
            bytes.push(b' ');
        }
    }
    bytes
}

/// Deep nesting, long lists and counts that lie take neither the stack nor minutes.
#[test]
fn large_and_deep_files() {
    let deep = |open: &str, close: &str, n: usize| open.repeat(n) + &close.repeat(n);
    let entity = "<!DOCTYPE svg [<!ENTITY a 'aaaaaaaaaa'>".to_owned()
        + &(1..20)
            .map(|k| format!("<!ENTITY a{k} '{}'>", format!("&a{};", k - 1).repeat(10)))
            .collect::<String>()
        + "]><svg>&a19;</svg>";
    let block = |k: usize| {
        format!("0\nBLOCK\n2\nb{k}\n0\nINSERT\n2\nb{}\n70\n1000\n71\n1000\n0\nENDBLK\n", k + 1)
    };
    let blocks: String = (0..30).map(block).collect();
    let files = [
        (deep("<g>", "</g>", 1_000_000), DrawingFormat::Svg),
        (
            format!("<svg>{}</svg>", deep("<g transform='rotate(1)'>", "</g>", 100_000)),
            DrawingFormat::Svg,
        ),
        (entity, DrawingFormat::Svg),
        (format!("<svg><path d='M0 0{}'/></svg>", "L1 1 2 3".repeat(200_000)), DrawingFormat::Svg),
        (
            format!(
                "0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nb0\n0\nEOF\n"
            ),
            DrawingFormat::Dxf,
        ),
        (
            "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n".to_owned()
                + &"10\n1\n20\n2\n".repeat(1_000_000),
            DrawingFormat::Dxf,
        ),
        ("$MeshFormat\n2.2 0 8\n$Nodes\n18446744073709551615\n".to_owned(), DrawingFormat::Msh),
        (
            "$MeshFormat\n4.1 0 8\n$Nodes\n99999999999 1 1 1\n2 1 0 99999999999999\n1\n".to_owned(),
            DrawingFormat::Msh,
        ),
        ("If (1)\n".repeat(300_000), DrawingFormat::Geo),
        (
            format!("Point(1) = {{{}1{}}};", "(".repeat(100_000), ")".repeat(100_000)),
            DrawingFormat::Geo,
        ),
        ("a = a;".repeat(300_000), DrawingFormat::Geo),
        ("/*".repeat(300_000), DrawingFormat::Geo),
        ("\0".repeat(10_000_000), DrawingFormat::Geo),
    ];
    for (text, format) in files {
        let before = thread_time();
        let error = read(text.as_bytes(), format, &ImportOptions::default()).unwrap_err();
        let time = thread_time() - before;
        assert!(time < Duration::from_secs(10), "{time:?}: {:.100}", error.to_string());
    }
}

/// Some hundred thousand lines are joined in a time that grows like their number.
#[test]
fn many_lines() {
    let n = 200_000;
    let at = |k: usize| (std::f64::consts::TAU * (k % n) as f64 / n as f64).sin_cos();
    let line = |k: usize| {
        let ((y, x), (v, u)) = (at(k), at(k + 1));
        format!("0\nLINE\n8\na\n10\n{x:?}\n20\n{y:?}\n11\n{u:?}\n21\n{v:?}\n")
    };
    let lines: String = (0..n).map(line).collect();
    let text = format!("0\nSECTION\n2\nENTITIES\n{lines}0\nEOF\n");
    let options = ImportOptions { tolerance: 1e-9, ..ImportOptions::default() };
    let drawing = read(text.as_bytes(), DrawingFormat::Dxf, &options).unwrap();
    assert_eq!(drawing.outline.edges().len(), n);
    assert!(drawing.problem_file("a", "b").parse::<toml::Table>().is_ok());
}
