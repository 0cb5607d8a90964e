//! Times against something that grows, as a figure.

use std::path::Path;

use anyhow::Context as _;
use ppum_figure::form::PageFormat;
use ppum_figure::plot::{Plot, PlotAxis, PlotCurve, plot};

/// Size in pixels.
const SIZE: [u32; 2] = [900, 600];

/// Writes curves on logarithmic axes.
pub(crate) fn save(
    path: &Path,
    title: &str,
    [x, y]: [(&str, &str); 2],
    curves: Vec<PlotCurve>,
) -> anyhow::Result<()> {
    let axis = |(name, unit)| PlotAxis::new(name, unit).logarithmic();
    let page = plot(
        &Plot { title: title.into(), x: axis(x), y: axis(y), curves, ..Plot::default() },
        SIZE,
    );
    let texts = [("Software".to_owned(), concat!("ppum ", env!("CARGO_PKG_VERSION")).to_owned())];
    let bytes =
        PageFormat::of(path).bytes(&page, None, &texts).context("cannot encode the image")?;
    ppum_file::replace(path, |out| out.write_all(&bytes))
        .with_context(|| format!("cannot write {}", path.display()))
}
