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

/// Names of options in ParaView, matplotlib and other programs, with `_` for `-`, and ours.
pub const FOREIGN: [(&str, &str); 46] = [
    ("antialias", "samples"),
    ("antialiasing", "samples"),
    ("axes", "figure"),
    ("axis", "figure"),
    ("centre", "center"),
    ("clim", "range"),
    ("cmap", "colormap"),
    ("color_map", "colormap"),
    ("colorbar", "bar"),
    ("colors", "colormap"),
    ("colour_map", "colormap"),
    ("colourmap", "colormap"),
    ("component", "quantity"),
    ("contour", "isolines"),
    ("contours", "isolines"),
    ("device", "backend"),
    ("extent", "view"),
    ("field", "quantity"),
    ("figsize", "inches"),
    ("fontsize", "font_size"),
    ("format", "output"),
    ("frame", "step"),
    ("framerate", "fps"),
    ("glyphs", "arrows"),
    ("jobs", "threads"),
    ("levels", "isolines"),
    ("limits", "range"),
    ("magnify", "zoom"),
    ("mesh", "overlay"),
    ("norm", "scale"),
    ("nproc", "threads"),
    ("out", "output"),
    ("palette", "colormap"),
    ("point", "at"),
    ("quiver", "arrows"),
    ("resolution", "size"),
    ("scalars", "quantity"),
    ("time", "step"),
    ("title", "labels"),
    ("vectors", "arrows"),
    ("vmax", "range"),
    ("vmin", "range"),
    ("warp", "deformed"),
    ("xlabel", "labels"),
    ("xlim", "view"),
    ("ylabel", "labels"),
];

/// Returns the option that another program calls `name`, with or without hyphens.
#[must_use]
pub fn own_option(name: &str) -> Option<&'static str> {
    let name = name.trim_start_matches('-').to_lowercase().replace('-', "_");
    FOREIGN.iter().find(|(foreign, _)| *foreign == name).map(|&(_, own)| own)
}

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

    /// No name is one of ours, and those that are ours in images are options.
    #[test]
    fn foreign_names_are_not_ours() {
        let elsewhere = ["at", "fps", "labels", "output", "quantity", "step", "threads"];
        for (foreign, own) in FOREIGN {
            assert!(!TEXTS.contains_key(foreign), "{foreign}");
            assert!(TEXTS.contains_key(own) || elsewhere.contains(&own), "{own}");
        }
        assert_eq!(own_option("--color-map"), Some("colormap"));
        assert_eq!(own_option("--colormap"), None);
    }

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
