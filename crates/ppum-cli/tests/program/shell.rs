use crate::Lab;

#[test]
fn completions_know_the_commands() {
    let lab = Lab::new();
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = lab.run(&format!("completions {shell}"));
        for word in ["ppum", "solve", "sample", "crack", "overlay"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    assert!(lab.fail("completions tcsh").contains("zsh"));
}

#[test]
fn every_command_has_a_manual_page() {
    let lab = Lab::new();
    let page = lab.run("man");
    assert!(page.contains(".TH ppum 1") && page.contains("sample"), "{page}");
    lab.run("man -o pages/man1");
    for (command, word) in [("", "solve"), ("-sample", "crack"), ("-render", "colormap")] {
        let page = lab.path("pages/man1").join(format!("ppum{command}.1"));
        assert!(std::fs::read_to_string(page).unwrap().contains(word), "{command}: {word}");
    }
    lab.write("file", "");
    assert!(lab.fail("man -o file/man1").contains("file/man1"));
}
