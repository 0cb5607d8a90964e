use std::collections::BTreeMap;

use crate::{CRACKED, LINEAR, Lab};

/// The columns of a table in CSV by their names, units included.
fn columns(text: &str) -> BTreeMap<&str, Vec<f64>> {
    let mut lines = text.lines();
    let names: Vec<_> = lines.next().unwrap().split(',').collect();
    let mut columns: BTreeMap<_, Vec<f64>> = names.iter().map(|name| (*name, vec![])).collect();
    for line in lines {
        let numbers: Vec<f64> = line.split(',').map(|n| n.parse().unwrap()).collect();
        assert_eq!(numbers.len(), names.len());
        names.iter().zip(numbers).for_each(|(n, v)| columns.get_mut(n).unwrap().push(v));
    }
    columns
}

/// Fields, shape and numbers of a structured array of doubles, as numpy documents its format 1.0.
fn npy(bytes: &[u8]) -> (Vec<String>, Vec<usize>, Vec<f64>) {
    assert_eq!(&bytes[..8], b"\x93NUMPY\x01\0");
    let data = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let header = std::str::from_utf8(&bytes[10..data]).unwrap();
    let names = header.split("('").skip(1).map(|part| part.split('\'').next().unwrap().to_owned());
    let shape = header
        .split("'shape': (")
        .nth(1)
        .unwrap()
        .split(')')
        .next()
        .unwrap()
        .split(',')
        .filter_map(|n| n.trim().parse().ok())
        .collect();
    let values = bytes[data..].as_chunks::<8>().0.iter().map(|b| f64::from_le_bytes(*b));
    (names.collect(), shape, values.collect())
}

/// u = x + 2y, from every kind of place.
#[test]
fn values_of_a_known_field() {
    let lab = Lab::solved(LINEAR);
    let line = lab.run("sample plate.h5 --line 0,0,3,1 --count 4 -q u,du_dy,error");
    assert!(line.starts_with("s,x,y,side,u,du_dy,error\n"), "{line}");
    let line = columns(&line);
    for (k, &s) in line["s"].iter().enumerate() {
        let (x, y) = (line["x"][k], line["y"][k]);
        assert!((x - k as f64).abs() < 1e-15 && (s - x.hypot(y)).abs() < 1e-15);
        assert_eq!(line["side"][k], 0.0);
        if k == 3 {
            assert!(line["u"][k].is_nan() && line["du_dy"][k].is_nan(), "outside");
        } else {
            assert!((line["u"][k] - (x + 2.0 * y)).abs() < 1e-10);
            assert!((line["du_dy"][k] - 2.0).abs() < 1e-9 && line["error"][k] < 1e-10);
        }
    }
    lab.write("p.csv", "x,y,name\n0.5,0.25,a\n1e-3,0.75,b\n");
    let points = lab.run("sample plate.h5 --points p.csv");
    let points = columns(&points);
    for (k, exact) in [1.0, 1.501].into_iter().enumerate() {
        assert!((points["u"][k] - exact).abs() < 1e-10);
    }
    assert!(
        lab.run("sample plate.h5 --grid 5x3 -q u -o g.npy").contains("15 rows of x, y, side, u")
    );
    let (names, shape, values) = npy(&std::fs::read(lab.path("g.npy")).unwrap());
    assert_eq!((names.join(" ").as_str(), shape), ("x y side u", vec![3, 5]));
    for (k, row) in values.chunks(4).enumerate() {
        let (x, y) = (0.5 * (k % 5) as f64, 0.5 * (k / 5) as f64);
        assert_eq!(row[..3], [x, y, 0.0]);
        assert!((row[3] - (x + 2.0 * y)).abs() < 1e-10, "{row:?}");
    }
    let window = lab.run("sample plate.h5 --grid 2x2 --view 1,0.5,0.5,0.25 -q u");
    assert_eq!(columns(&window)["x"], [0.5, 1.0, 0.5, 1.0]);
}

/// Both sides, as `probe` tells them; jumps and opening along a crack.
#[test]
fn along_a_crack() {
    let oblique = "points = [[-0.3, -0.4], [0.0, 0.0], [0.3, 0.0]]";
    let problem = CRACKED.replace("points = [[-0.5, 0.0], [0.5, 0.0]]", oblique);
    let lab = Lab::solved(&problem);
    let text = lab.run("sample plate.h5 --crack 0 --count 9 -q ux,uy,syy");
    let names = "s,x,y,ux_above,ux_below,uy_above,uy_below,syy_above,syy_below,jump_ux,jump_uy,opening,sliding";
    assert!(text.starts_with(names), "{text}");
    let crack = columns(&text);
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-9 * (1.0 + b.abs());
    for (k, &told) in crack["s"].iter().enumerate() {
        let s = 0.1 * k as f64;
        // a 3-4-5 triangle, then the x axis
        let (tangent, at) = if s < 0.5 {
            ([0.6, 0.8], [-0.3 + 0.6 * s, -0.4 + 0.8 * s])
        } else {
            ([1.0, 0.0], [s - 0.5, 0.0])
        };
        let [x, y] = [crack["x"][k], crack["y"][k]];
        assert!(near(told, s) && near(x, at[0]) && near(y, at[1]), "{k}: {x} {y}");
        let [jx, jy] = ["x", "y"].map(|c| {
            let [above, below] =
                ["above", "below"].map(|side| crack[format!("u{c}_{side}").as_str()][k]);
            above - below
        });
        assert!(near(crack["jump_ux"][k], jx) && near(crack["jump_uy"][k], jy));
        assert!(near(crack["opening"][k], jy * tangent[0] - jx * tangent[1]), "{k}");
        assert!(near(crack["sliding"][k], jx * tangent[0] + jy * tangent[1]), "{k}");
        if k == 0 || k == 8 {
            assert_eq!((jx, jy), (0.0, 0.0));
            assert_eq!(crack["syy_above"][k], f64::INFINITY);
        } else {
            assert!(crack["opening"][k] > 0.1, "{}", crack["opening"][k]);
        }
    }
    let probe = lab.json("probe plate.h5 --at 0.2,0 -q ux,uy,syy");
    for (row, side) in probe["points"].as_array().unwrap().iter().zip(["above", "below"]) {
        assert_eq!(row["side"], side);
        for name in ["ux", "uy", "syy"] {
            let sampled = crack[format!("{name}_{side}").as_str()][7];
            assert!(near(sampled, row["values"][name].as_f64().unwrap()), "{name} {side}");
        }
    }
    // a line across the crack has a row for each side, a grid the upper one
    let across = lab.run("sample plate.h5 --line 0.2,-0.5,0.2,0.5 --count 3 -q uy");
    let across = columns(&across);
    assert_eq!(across["side"], [0.0, 1.0, -1.0, 0.0]);
    assert!(
        near(across["uy"][1], crack["uy_above"][7]) && near(across["uy"][2], crack["uy_below"][7])
    );
    let grid = lab.run("sample plate.h5 --grid 1x3 --view 0.2,-0.5,0.2,0.5 -q uy");
    assert_eq!(columns(&grid)["uy"], [0, 1, 3].map(|k| across["uy"][k]));
}

/// The result does not depend on how the points are spread over threads.
#[test]
fn samples_are_probes() {
    let lab = Lab::solved(CRACKED);
    let grid = lab.run("sample plate.h5 --grid 40x30 -q von-mises");
    let grid = columns(&grid);
    for k in (0..1200).step_by(117) {
        let (x, y) = (grid["x"][k], grid["y"][k]);
        let probe = lab.json(&format!("probe plate.h5 --at {x:?},{y:?} -q von-mises"));
        let exact = probe["points"][0]["values"]["von-mises"].as_f64().unwrap();
        assert!((grid["von-mises"][k] / exact - 1.0).abs() < 1e-9, "{x} {y}");
    }
}
