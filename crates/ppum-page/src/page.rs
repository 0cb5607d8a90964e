//! The page as a text.

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum_figure::canvas::base64::base64;
use ppum_render::colormap::{Colormap, ColormapError};
use ppum_render::view;
use ppum_scene::error::ImageError;
use ppum_scene::overlays::Overlay;
use ppum_scene::quantity::default_quantity;
use ppum_scene::scene::SceneRequest;
use ppum_scene::subject::scene_bounds;
use serde::Serialize;
use sha2::{Digest as _, Sha256};

use crate::messages::PageView;

const PAGE: &str = include_str!("../web/page.html");
const STYLE: &str = include_str!("../web/page.css");
/// One text: the page gives its workers the function in the first file.
const SCRIPT: &str = concat!(include_str!("../web/worker.js"), include_str!("../web/page.js"));
/// The evaluator, as `tools/page.sh` compiles it.
#[allow(clippy::large_include_file, reason = "each page holds it")]
const EVALUATOR: &[u8] = include_bytes!("../evaluator.wasm.gz");

/// Longest dataset of a page, in bytes: browsers hold no text of more than half a gigabyte.
pub const LARGEST: u64 = 256 << 20;

/// The shape of the first view; a window of another shape shows more.
pub const SHAPE: [u32; 2] = [1024, 768];

/// The initial state of a page.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PageStart {
    /// The shown scene.
    pub scene: SceneRequest,
    /// Where it is seen; the whole domain if nothing is said. Pixels tell the shape alone.
    pub view: Option<PageView>,
    /// The name of the dataset's file.
    pub file: String,
}

/// Features that pages do not have.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StartError {
    /// A colour map from a file.
    #[error("pages have the colour maps of the program alone")]
    Colormap(#[source] ColormapError),
    /// Supports and loads.
    #[error("pages show no supports and loads, which are those of a problem file")]
    Stations,
    /// Lines of symmetry, or the deformed body.
    #[error(transparent)]
    Body(#[from] ImageError),
}

impl PageStart {
    /// Returns the first view of a scene of a field, with its lines of symmetry named: its cracks
    /// are drawn unless they are left out, and a quantity that would be shown anyway is left out,
    /// so that other steps show it too.
    ///
    /// # Errors
    /// Features that pages do not have.
    pub fn new(
        scene: SceneRequest,
        (dataset, field): (&Dataset, &Field<'_>),
        view: Option<PageView>,
        file: String,
    ) -> Result<Self, StartError> {
        let mut scene = scene.with_edges(dataset).map_err(ImageError::from)?;
        if let Some(name) = &scene.colors.colormap {
            Colormap::named(name).map_err(StartError::Colormap)?;
        }
        if scene.overlays.have_stations() {
            return Err(StartError::Stations);
        }
        if !scene.overlays.no_cracks && !scene.overlays.shown.contains(&Overlay::Cracks) {
            scene.overlays.shown.push(Overlay::Cracks);
        }
        scene.quantity = scene.quantity.filter(|text| text != default_quantity(field));
        // the script knows the box of the undeformed part alone
        let view = match view {
            None if scene.deformed.is_some() || scene.mirror.is_some() => {
                let bounds = scene_bounds(dataset, field, &scene)?;
                Some(view::View::fit(bounds, SHAPE).map_err(ImageError::from)?.into())
            }
            view => view,
        };
        Ok(Self { scene, view, file })
    }

    /// The title of the page: that of the dataset, or the name of its file.
    #[must_use]
    pub fn title<'s>(&'s self, dataset: &'s Dataset) -> &'s str {
        if dataset.title.is_empty() { &self.file } else { &dataset.title }
    }
}

/// The page of a dataset, which is given by the bytes of its file.
///
/// # Errors
/// None that is known: a scene is always JSON.
pub fn html(dataset: &[u8], title: &str, start: &PageStart) -> Result<String, serde_json::Error> {
    // in a script nothing but `<` could end it
    let start = serde_json::to_string(start)?.replace('<', "\\u003c");
    let part = |name: &str| match name {
        "title" => escaped(title),
        "policy" => policy(),
        "style" => STYLE.to_owned(),
        "start" => start.clone(),
        "dataset" => base64(dataset),
        "evaluator" => base64(EVALUATOR),
        "script" => SCRIPT.to_owned(),
        other => unreachable!("the page has no part {other}"),
    };
    let mut pieces = PAGE.split("{{");
    let mut page = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (name, rest) = piece.split_once("}}").expect("the page closes its braces");
        page += &part(name);
        page += rest;
    }
    Ok(page)
}

/// The content security policy: this script and this style alone, workers that they make, and
/// nothing from elsewhere.
fn policy() -> String {
    let hash = |text: &str| format!("'sha256-{}'", base64(&Sha256::digest(text)));
    format!(
        "default-src 'none'; script-src {} 'wasm-unsafe-eval'; style-src {}; worker-src blob:",
        hash(SCRIPT),
        hash(STYLE)
    )
}

/// A text as HTML shows it.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped += "&amp;",
            '<' => escaped += "&lt;",
            '>' => escaped += "&gt;",
            '"' => escaped += "&quot;",
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No title and no text of a scene ends the element that it stands in.
    #[test]
    fn texts_stay_texts() {
        let hostile = "</script></title><img src=x onerror=\"alert(1)\">{{script}}&amp;";
        let scene = SceneRequest { quantity: Some(hostile.to_owned()), ..SceneRequest::default() };
        let start = PageStart { scene, view: None, file: hostile.to_owned() };
        let page = html(b"not read here", hostile, &start).expect("a page");
        assert!(!page.contains("<img") && !page.contains("</script></title>"));
        for tag in ["<script", "</script>", "<title>", "</title>", "<style>", "</style>"] {
            assert_eq!(page.matches(tag).count(), PAGE.matches(tag).count(), "{tag}");
        }
        let json =
            page.split("id=\"start\">").nth(1).and_then(|rest| rest.split("</script>").next());
        let read: serde_json::Value = serde_json::from_str(json.expect("it")).expect("JSON");
        assert_eq!(read["file"], hostile);
    }

    /// A browser compares the hash of the script with its text between the tags.
    #[test]
    fn the_policy_is_that_of_the_script() {
        let start = PageStart { scene: SceneRequest::default(), view: None, file: String::new() };
        let page = html(b"", "", &start).expect("a page");
        for (from, to) in [("<script>", "</script>"), ("<style>", "</style>")] {
            let text = page.split(from).nth(1).and_then(|rest| rest.split(to).next());
            let hash = base64(&Sha256::digest(text.expect("an element")));
            assert!(page.contains(&format!("'sha256-{hash}'")), "{from}");
        }
    }
}
