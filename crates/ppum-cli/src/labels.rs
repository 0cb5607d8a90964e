//! The labels of figures, as an option.

use anyhow::bail;
use ppum_scene::page_style::PageStyle;
use ppum_scene::request::{FigureTexts, Request};

/// The option of the words of figures.
#[derive(Debug, clap::Args)]
pub(crate) struct LabelArgs {
    /// Override labels of a figure: title=, x=, y=, bar=, separated by commas; an empty text
    /// removes the label
    #[arg(long, value_name = "title=…,x=…,y=…,bar=…", value_parser = texts)]
    labels: Vec<FigureTexts>,
}

impl LabelArgs {
    /// Refuses options of figures for images that are none.
    pub(crate) fn check(&self, request: &Request) -> anyhow::Result<()> {
        let Request { look, .. } = request;
        let mut given =
            PageStyle::of_figures(look).into_iter().chain([("labels", !self.labels.is_empty())]);
        match given.find(|(_, is_given)| *is_given).filter(|_| !request.is_figure()) {
            Some((option, _)) => bail!("--{option} is for figures; add --figure"),
            None => Ok(()),
        }
    }

    /// The texts that were given; of those that were given twice the last one.
    pub(crate) fn texts(&self) -> FigureTexts {
        self.labels.iter().cloned().fold(FigureTexts::default(), |all, more| more.or(all))
    }
}

/// `KEY=TEXT` with commas between; a comma that no key follows is part of a text.
fn texts(text: &str) -> Result<FigureTexts, String> {
    const KEYS: [&str; 4] = ["title=", "x=", "y=", "bar="];
    let (mut all, mut last) = ([const { None::<String> }; 4], None);
    for part in text.split(',') {
        let found = KEYS.iter().position(|key| part.trim_start().starts_with(key));
        match (found, last.and_then(|last: usize| all[last].as_mut())) {
            (Some(key), _) => {
                all[key] = part.trim_start().strip_prefix(KEYS[key]).map(str::to_owned);
                last = Some(key);
            }
            (None, Some(text)) => *text += &format!(",{part}"),
            (None, None) => return Err("begin with title=, x=, y= or bar=".into()),
        }
    }
    let [title, x, y, bar] = all;
    Ok(FigureTexts { title, x, y, bar })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_may_have_commas() {
        let found = texts("title=A plate, cracked, x=1,y=up,bar=").unwrap();
        let [title, x, y, bar] =
            ["A plate, cracked", "1", "up", ""].map(|text| Some(text.to_owned()));
        assert_eq!(found, FigureTexts { title, x, y, bar });
        assert!(texts("plate").is_err() && texts("").is_err());
    }
}
