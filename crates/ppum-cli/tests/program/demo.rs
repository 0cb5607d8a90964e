use std::io::{BufRead as _, BufReader};
use std::process::Stdio;

use crate::{Lab, Png};

const EXAMPLE: &str = include_str!("../../../../examples/centre-crack.toml");

/// It writes the example, and tells of each command before it runs it.
#[test]
fn the_tour_begins_with_its_problem() {
    let lab = Lab::new();
    let mut tour = lab.command("demo -o tour").stdout(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(tour.stdout.take().unwrap()).lines().map(Result::unwrap);
    let first = lines.find(|line| line.starts_with("$ "));
    tour.kill().unwrap();
    tour.wait().unwrap();
    let program = env!("CARGO_BIN_EXE_ppum");
    assert_eq!(first, Some(format!("$ {program} solve tour/centre-crack.toml")));
    let problem = std::fs::read_to_string(lab.path("tour/centre-crack.toml")).unwrap();
    assert_eq!(problem, EXAMPLE);
}

/// Every command it prints can be repeated, and every picture is there.
#[test]
#[ignore = "slow: 4096 cells of order 2"]
fn the_tour() {
    let lab = Lab::new();
    let told = lab.run("demo -o tour");
    for name in ["von-mises", "displacement", "tip", "patches"] {
        let path = lab.path(&format!("tour/{name}.png"));
        assert!(told.contains(&format!("wrote tour/{name}.png")), "{told}");
        assert_eq!(Png::read(&path).size, [1024, 768]);
    }
    let next = told.split_once("Then try:").unwrap().1.lines().filter(|line| !line.is_empty());
    let commands: Vec<_> = next.collect();
    assert!(commands.len() > 3);
    for command in commands {
        let (program, arguments) = command.trim().split_once(' ').unwrap();
        assert_eq!(program, env!("CARGO_BIN_EXE_ppum"));
        lab.run(arguments);
    }
}
