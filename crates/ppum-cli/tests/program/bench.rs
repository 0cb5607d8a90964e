use crate::Lab;

#[test]
fn phases_are_measured() {
    let report = Lab::new().json("bench --level 4 --threads 2");
    assert_eq!(report["threads"], 2);
    let run = &report["solver"][0];
    assert_eq!(run["level"], 4);
    assert!(run["unknowns"].as_u64().unwrap() > 2 * 6 * 256);
    let phases = run["phases"].as_array().unwrap();
    let names: Vec<_> = phases.iter().map(|phase| phase["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["cover", "basis", "assembly", "solution", "intensity"]);
    let sum: f64 = phases.iter().map(|phase| phase["seconds"].as_f64().unwrap()).sum();
    assert!(sum > 0.0 && (sum - run["seconds"].as_f64().unwrap()).abs() < 1e-12);
}

#[test]
fn a_table_for_people() {
    let text = Lab::new().run("bench --level 4");
    for part in ["level 4: ", "  assembly ", "  in all ", " unknowns/s"] {
        assert!(text.contains(part), "{text}");
    }
    assert!(Lab::new().fail("bench --level 11").contains("11 is not in 4..=10"));
}
