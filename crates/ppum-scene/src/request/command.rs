//! The command line that draws what is seen: `ppum render` with all that was chosen.
//!
//! A request is written as JSON, and whatever is not as in a request that asks for nothing becomes
//! an option with the name of its field. The program tests the way back.

use serde_json::Value;

use crate::request::Request;

/// Fields of a request whose options have another name.
const NAMES: [(&str, &str); 6] = [
    ("overlays.shown", "overlay"),
    ("panels.parts", "part"),
    ("panels.quantities", "quantity"),
    ("subject.functions", "function"),
    ("subject.quantities", "define"),
    ("colors.contrast", "extremes=contrast"),
];

/// The words of `ppum render` that draws a request of a file.
#[must_use]
pub fn render(request: &Request, file: &str, output: &str) -> Vec<String> {
    // a name that begins with a dash is no option
    let file = if file.starts_with('-') { format!("./{file}") } else { file.to_owned() };
    let mut words = ["ppum", "render", &file, "-o", output].map(str::to_owned).to_vec();
    let asked = Request { scene: request.scene.settled(), ..request.clone() };
    let [asked, nothing] = [asked, Request::default()].map(|request| json(&request));
    options("", &asked, &nothing, &mut words);
    words
}

/// A request as JSON; numbers that JSON lacks are nowhere in it.
fn json(request: &Request) -> Value {
    serde_json::to_value(request).unwrap_or_default()
}

/// Adds an option for what is asked for at a path: a field of the request, or of an object in it.
fn options(path: &str, asked: &Value, nothing: &Value, words: &mut Vec<String>) {
    let Value::Object(fields) = asked else { return option(path, asked, words) };
    for (name, value) in fields {
        let nothing = &nothing[name];
        if value != nothing {
            let path = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
            options(&path, value, nothing, words);
        }
    }
}

fn option(path: &str, value: &Value, words: &mut Vec<String>) {
    let known = NAMES.iter().find(|(field, _)| *field == path).map(|(_, option)| *option);
    let name = known.or(path.rsplit('.').next()).unwrap_or(path).replace('_', "-");
    let mut add = |value: &str| words.push(format!("--{name}={value}"));
    match (path.split('.').next(), value) {
        (_, Value::Bool(_)) => words.push(format!("--{name}")),
        (Some("labels"), Value::String(text)) => {
            let key = path.trim_start_matches("labels.");
            words.push(format!("--labels={key}={text}"));
        }
        (_, Value::Array(all)) => {
            let is_repeated = all.iter().any(Value::is_array) || name == "ticks";
            let joint = if ["size", "layout"].contains(&&*name) { "x" } else { "," };
            let texts = all.iter().map(text);
            if is_repeated {
                texts.for_each(|text| add(&text));
            } else {
                add(&texts.collect::<Vec<_>>().join(joint));
            }
        }
        _ => add(&text(value)),
    }
}

/// A value as an option has it; a pair is a name and what it stands for.
fn text(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(pair) => pair.iter().map(text).collect::<Vec<_>>().join("="),
        other => other.to_string(),
    }
}

/// Words as a shell reads them: those with signs of its own in single quotes.
#[must_use]
pub fn line(words: &[String]) -> String {
    words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ")
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
    use crate::request::page_style::PageStyle;
    use crate::request::region::ViewRegion;

    #[test]
    fn words_that_a_shell_would_change_are_quoted() {
        let words = ["a.h5", "it's", "", "(a+b)*2", "--range=-1,2", "$HOME"].map(str::to_owned);
        let want = r"a.h5 'it'\''s' '' '(a+b)*2' --range=-1,2 '$HOME'";
        assert_eq!(line(&words), want);
    }

    #[test]
    fn what_is_not_chosen_is_not_said() {
        let place =
            ViewRegion { center: Some([-0.5, 1e-13]), width: Some(1e-12), ..ViewRegion::default() };
        let look = PageStyle { size: Some([80, 60]), ..PageStyle::default() };
        let request = Request { look, place, ..Request::default() };
        assert_eq!(
            line(&render(&request, "-x.h5", "x.png")),
            "ppum render ./-x.h5 -o x.png --size=80x60 --center=-0.5,1e-13 --width=1e-12"
        );
    }
}
