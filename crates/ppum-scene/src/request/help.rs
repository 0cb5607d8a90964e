//! The effect of each option of an image: the comment of its field, which is the help of the
//! command line, the docstring of Python and the tooltip of the window.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use clap::{Args as _, Command};

use crate::request::Request;

/// The texts by the names of options, with `_` for `-`.
pub static TEXTS: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let command = Request::augment_args(Command::new("render"));
    let text =
        |arg: &clap::Arg| Some((arg.get_long()?.replace('-', "_"), arg.get_help()?.to_string()));
    command.get_arguments().filter_map(text).collect()
});

/// The text of an option as a tooltip, without the default.
///
/// # Panics
/// There is no option of this name.
#[must_use]
pub fn tooltip(option: &str) -> &'static str {
    let text = TEXTS.get(option).expect("options of images have texts");
    text.split(" [default").next().unwrap_or(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each field that a request has in JSON, except for what programs read by options of their
    /// own.
    #[test]
    fn every_option_has_a_text() {
        let own = ["labels", "quantities", "parts", "subject", "quantity"];
        let renamed = [("shown", "overlay"), ("contrast", "extremes")];
        let request = serde_json::to_value(Request::default()).unwrap_or_default();
        let fields = request.as_object().into_iter().flatten();
        let all = fields.flat_map(|(name, value)| match value.as_object() {
            Some(inner) if name != "labels" && name != "subject" => inner.keys().cloned().collect(),
            _ => vec![name.clone()],
        });
        let mut count = 0;
        for name in all.filter(|name| !own.contains(&name.as_str())) {
            let option =
                renamed.iter().find(|(field, _)| *field == name).map_or(&*name, |(_, o)| o);
            assert!(TEXTS.get(option).is_some_and(|text| text.len() > 10), "{name}");
            count += 1;
        }
        // a colour that is left out is no field
        assert_eq!(count + 1, TEXTS.len());
    }
}
