use crate::{Lab, Png};

/// Every command it prints can be repeated, and every picture is there.
#[test]
fn the_tour() {
    let lab = Lab::new();
    let told = lab.run("demo -o tour");
    for name in ["von-mises", "displacement", "tip", "patches"] {
        let path = lab.path(&format!("tour/{name}.png"));
        assert!(told.contains(&format!("wrote tour/{name}.png")), "{told}");
        assert_eq!(Png::read(&path).size, [1024, 768]);
    }
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/centre-crack.toml");
    let problem = std::fs::read_to_string(lab.path("tour/centre-crack.toml")).unwrap();
    assert_eq!(problem, std::fs::read_to_string(example).unwrap());
    let next = told.split_once("Then try:").unwrap().1.lines().filter(|line| !line.is_empty());
    let commands: Vec<_> = next.collect();
    assert!(commands.len() > 3);
    for command in commands {
        let (program, arguments) = command.trim().split_once(' ').unwrap();
        assert_eq!(program, env!("CARGO_BIN_EXE_ppum"));
        lab.run(arguments);
    }
}
