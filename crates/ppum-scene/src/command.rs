//! The command line that draws what is seen: `ppum render` with all that was chosen.

use ppum_render::range::Range;
use ppum_render::scale::Scale;
use ppum_render::view::View;

use crate::scene::Scene;

/// The words of `ppum render` that draws a scene of a file from a view: the same picture, but for
/// what computes it. Of a figure `page` is its size, and the view that of its plot.
#[must_use]
pub fn render(
    scene: &Scene,
    file: &str,
    view: &View,
    output: &str,
    page: Option<[u32; 2]>,
) -> Vec<String> {
    let mut words = CommandLine(vec!["ppum".into(), "render".into(), file_word(file)]);
    words.option("-o", output);
    let View { center, width, .. } = view;
    let [columns, rows] = page.unwrap_or(view.pixels);
    words.add(format!("--size={columns}x{rows}"));
    words.add(format!("--center={:?},{:?}", center.x, center.y));
    words.add(format!("--width={width:?}"));
    if page.is_some() {
        words.add("--figure");
    }
    subject(scene, &mut words);
    colors(scene, &mut words);
    overlays(scene, &mut words);
    if let Some(factor) = scene.deformed {
        words.add(format!("--deformed={factor}"));
        if scene.outline {
            words.add("--outline");
        }
    }
    words.0
}

/// Words as a shell reads them: those with signs of its own in single quotes.
#[must_use]
pub fn line(words: &[String]) -> String {
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
}

struct CommandLine(Vec<String>);

impl CommandLine {
    fn add(&mut self, word: impl Into<String>) {
        self.0.push(word.into());
    }

    fn option(&mut self, name: &str, value: &str) {
        self.add(name);
        self.add(value);
    }
}

/// A name that begins with a dash is no option.
fn file_word(file: &str) -> String {
    if file.starts_with('-') { format!("./{file}") } else { file.to_owned() }
}

fn subject(scene: &Scene, words: &mut CommandLine) {
    let subject = &scene.subject;
    if let Some(step) = subject.step {
        words.add(format!("--step={step}"));
    }
    if let Some(quantity) = &scene.quantity {
        words.add(format!("--quantity={quantity}"));
    }
    if let Some(part) = &subject.part {
        words.add(format!("--part={part}"));
    }
    for (which, formula) in &subject.functions {
        words.add(format!("--function={which}={formula}"));
    }
    if let Some(weight) = &subject.weight {
        words.add(format!("--weight={weight}"));
    }
    for (name, formula) in &subject.quantities {
        words.add(format!("--define={name}={formula}"));
    }
}

fn colors(scene: &Scene, words: &mut CommandLine) {
    let colors = &scene.colors;
    if let Some(name) = &colors.colormap {
        words.add(format!("--colormap={name}"));
    }
    if colors.range != Range::Auto {
        words.add(format!("--range={}", colors.range));
    }
    if colors.scale != Scale::Linear {
        words.add(format!("--scale={}", colors.scale));
    }
    if colors.symmetric {
        words.add("--symmetric");
    }
    if colors.contrast {
        words.add("--extremes=contrast");
    }
    if let Some(bands) = colors.bands {
        words.add(format!("--bands={bands}"));
    }
}

fn overlays(scene: &Scene, words: &mut CommandLine) {
    let overlays = &scene.overlays;
    if !overlays.shown.is_empty() {
        let names: Vec<_> = overlays.shown.iter().map(|overlay| overlay.name()).collect();
        words.add(format!("--overlay={}", names.join(",")));
    }
    if let Some(levels) = &overlays.isolines {
        words.add(format!("--isolines={levels}"));
        if overlays.level_labels {
            words.add("--level-labels");
        }
    }
    if let Some(spacing) = overlays.arrows {
        words.add(format!("--arrows={spacing:?}"));
    }
    if let Some(spacing) = overlays.crosses {
        words.add(format!("--crosses={spacing:?}"));
    }
}

/// A word with quotes around it if a shell would take it for something else.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_=+,./:%@".contains(c);
    match !word.is_empty() && word.chars().all(is_plain) {
        true => word.to_owned(),
        false => format!("'{}'", word.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_a_shell_would_change_are_quoted() {
        let words = ["a.h5", "it's", "", "(a+b)*2", "--range=-1,2", "$HOME"].map(str::to_owned);
        let want = r"a.h5 'it'\''s' '' '(a+b)*2' --range=-1,2 '$HOME'";
        assert_eq!(line(&words), want);
    }

    #[test]
    fn what_is_not_chosen_is_not_said() {
        let view = View::new(ppum::vec2::vec2(-0.5, 1e-13), 1e-12, [80, 60]).expect("a view");
        let words = render(&Scene::default(), "-x.h5", &view, "x.png", None);
        let line = line(&words);
        assert_eq!(
            line,
            "ppum render ./-x.h5 -o x.png --size=80x60 --center=-0.5,1e-13 --width=1e-12"
        );
    }
}
