//! Options of the look of pictures and figures: size, words, colours of the page.

use anyhow::bail;
use clap::ValueEnum;
use ppum_figure::figure::{BarPlace, Design, Theme, TickChoice};
use ppum_scene::request::Texts;

use crate::arguments::{inches, positive, size};

/// The options of size and look.
#[derive(Debug, clap::Args)]
pub(crate) struct LookArgs {
    /// Size of the page in pixels [default: 1024x768, a bare picture of the whole domain takes its
    /// shape; of `compare` 660x600 for each panel]
    #[arg(long, value_name = "WxH", value_parser = size, conflicts_with = "inches")]
    size: Option<[u32; 2]>,
    /// Size of the picture on paper, in inches
    #[arg(long, value_name = "WxH", value_parser = inches)]
    inches: Option<[f64; 2]>,
    /// Pixels per inch [default: 300 with --inches, else 96]
    #[arg(long, value_name = "N", value_parser = positive)]
    dpi: Option<f64>,
    /// Size of the letters of a figure in points [default: 9 with --inches, else with the size
    /// in pixels]
    #[arg(long, value_name = "PT", value_parser = positive)]
    font_size: Option<f64>,
    /// Colours around the picture of a figure [default: light]
    #[arg(long, value_enum)]
    theme: Option<ThemeName>,
    /// Leave out the colour of a figure's page
    #[arg(long)]
    transparent: bool,
    /// Place of a figure's colour bar [default: auto, below long plates]
    #[arg(long, value_enum)]
    bar: Option<BarName>,
    /// Marks of a figure: auto, about how many, or at which values; of the colour bar, or with x=
    /// or y= in front of an axis
    #[arg(long, value_name = "[x=|y=]auto|N|A,B,…", allow_hyphen_values = true, value_parser = marks)]
    ticks: Vec<(LabelledAxis, TickChoice)>,
    /// Words of a figure: title=, x=, y=, bar=, apart by commas; none are left out
    #[arg(long, value_name = "title=…,x=…,y=…,bar=…", value_parser = texts)]
    labels: Vec<Texts>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ThemeName {
    /// Dark on white
    Light,
    /// Light on black
    Dark,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum BarName {
    /// Below long plates, else right
    Auto,
    Right,
    Bottom,
    None,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LabelledAxis {
    X,
    Y,
    Bar,
}

/// Size of pictures if nothing is said.
pub(crate) const DEFAULT_SIZE: [u32; 2] = [1024, 768];
/// Size of a panel if no size is given, also of long plates.
const PANEL: [u32; 2] = [660, 600];
const LONG_PANEL: [u32; 2] = [900, 330];
/// Panels side by side that pages grow with.
const MOST_PANELS: u32 = 12;
/// Length over height of what counts as long.
pub(crate) const LONG: f64 = 2.2;
const PRINT_DPI: f64 = 300.0;
const SCREEN_DPI: f64 = 96.0;

impl LookArgs {
    /// Refuses options of figures for pictures that are none.
    pub(crate) fn check(&self, is_figure: bool) -> anyhow::Result<()> {
        let given = [
            ("--font-size", self.font_size.is_some()),
            ("--theme", self.theme.is_some()),
            ("--transparent", self.transparent),
            ("--bar", self.bar.is_some()),
            ("--ticks", !self.ticks.is_empty()),
            ("--labels", !self.labels.is_empty()),
        ];
        if !is_figure && let Some((option, _)) = given.iter().find(|(_, is_given)| *is_given) {
            bail!("{option} is for figures; add --figure");
        }
        Ok(())
    }

    /// The size that was asked for \[pixels\].
    pub(crate) fn given_size(&self) -> Option<[u32; 2]> {
        self.size.or_else(|| Some(Design::inches(self.inches?, self.dpi()).size))
    }

    /// Size of a page of so many panels across and down if no size is given, of things of a shape.
    pub(crate) fn page(aspect: Option<f64>, [across, down]: [u32; 2]) -> [u32; 2] {
        let panel = if aspect.is_some_and(|aspect| aspect > LONG) { LONG_PANEL } else { PANEL };
        // a page of more panels than anyone can see stays small enough to be refused for want
        // of room
        [across.min(MOST_PANELS) * panel[0], down.min(MOST_PANELS) * panel[1]]
    }

    /// Pixels per inch.
    fn dpi(&self) -> f64 {
        self.dpi.unwrap_or(if self.inches.is_some() { PRINT_DPI } else { SCREEN_DPI })
    }

    /// Pixels per inch if someone cares.
    pub(crate) fn given_dpi(&self) -> Option<f64> {
        (self.dpi.is_some() || self.inches.is_some()).then(|| self.dpi())
    }

    /// The look of a figure of something of a shape, width over height, none if it has any shape;
    /// of `size` pixels unless another size is given, with letters as for one of so many parts of
    /// it across and down.
    pub(crate) fn design(&self, aspect: Option<f64>, size: [u32; 2], parts: [u32; 2]) -> Design {
        let mut design = match (self.inches, self.size.unwrap_or(size)) {
            (Some(inches), _) => Design::inches(inches, self.dpi()),
            (None, size) => {
                let part = [size[0] / parts[0], size[1] / parts[1]];
                Design { size, ..Design::pixels(part).at(self.dpi()) }
            }
        };
        design.font_size = self.font_size.unwrap_or(design.font_size);
        design.transparent = self.transparent;
        if self.theme == Some(ThemeName::Dark) {
            design.theme = Theme::Dark;
        }
        design.bar = match self.bar.unwrap_or(BarName::Auto) {
            BarName::Auto => aspect.map_or(BarPlace::Right, BarPlace::fitting),
            BarName::Right => BarPlace::Right,
            BarName::Bottom => BarPlace::Bottom,
            BarName::None => BarPlace::None,
        };
        for (axis, choice) in &self.ticks {
            let ticks = match axis {
                LabelledAxis::X => &mut design.x_ticks,
                LabelledAxis::Y => &mut design.y_ticks,
                LabelledAxis::Bar => &mut design.bar_ticks,
            };
            ticks.clone_from(choice);
        }
        design
    }

    /// The texts that were given; of those that were given twice the last one.
    pub(crate) fn texts(&self) -> Texts {
        self.labels.iter().cloned().fold(Texts::default(), |all, more| Texts {
            title: more.title.or(all.title),
            x: more.x.or(all.x),
            y: more.y.or(all.y),
            bar: more.bar.or(all.bar),
        })
    }
}

/// The letters of a panel's caption by its number: `a`, `b`, …, `z`, `aa`, `ab`, …
pub(crate) fn letters(number: usize) -> String {
    let last = char::from(b'a' + (number % 26) as u8);
    match number / 26 {
        0 => last.to_string(),
        before => letters(before - 1) + &last.to_string(),
    }
}

/// `[x=|y=|bar=]auto|N|A,B,…`.
fn marks(text: &str) -> Result<(LabelledAxis, TickChoice), String> {
    let (axis, choice) = match text.split_once('=') {
        None => (LabelledAxis::Bar, text),
        Some(("x", choice)) => (LabelledAxis::X, choice),
        Some(("y", choice)) => (LabelledAxis::Y, choice),
        Some(("bar", choice)) => (LabelledAxis::Bar, choice),
        Some((other, _)) => return Err(format!("there is no axis `{other}`; write x, y or bar")),
    };
    let choice = choice.trim();
    if choice == "auto" {
        return Ok((axis, TickChoice::Auto));
    }
    if let Ok(count) = choice.parse::<usize>() {
        return match count {
            1..=100 => Ok((axis, TickChoice::Count(count))),
            _ => Err("write 1 to 100 marks, or their values with a comma".into()),
        };
    }
    let number = |part: &str| part.trim().parse().ok().filter(|v: &f64| v.is_finite());
    let values: Option<Vec<f64>> =
        choice.split(',').filter(|p| !p.trim().is_empty()).map(number).collect();
    let values = values.ok_or("write auto, a number of marks, or values with commas between")?;
    Ok((axis, TickChoice::At(values)))
}

/// `KEY=TEXT` with commas between; a comma that no key follows is part of a text.
fn texts(text: &str) -> Result<Texts, String> {
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
    Ok(Texts { title, x, y, bar })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_of_axes_and_bar() {
        assert_eq!(marks("auto"), Ok((LabelledAxis::Bar, TickChoice::Auto)));
        assert_eq!(marks("x=5"), Ok((LabelledAxis::X, TickChoice::Count(5))));
        assert_eq!(marks("y=-1,0.5"), Ok((LabelledAxis::Y, TickChoice::At(vec![-1.0, 0.5]))));
        assert_eq!(marks("3,"), Ok((LabelledAxis::Bar, TickChoice::At(vec![3.0]))));
        assert_eq!(marks("x="), Ok((LabelledAxis::X, TickChoice::At(vec![]))));
        for wrong in ["z=3", "0", "101", "1,a", "inf,0", "some"] {
            assert!(marks(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn letters_go_on_behind_z() {
        let found = [0, 25, 26, 51, 52, 701, 702].map(letters);
        assert_eq!(found, ["a", "z", "aa", "az", "ba", "zz", "aaa"]);
    }

    #[test]
    fn texts_may_have_commas() {
        let found = texts("title=A plate, cracked, x=1,y=up,bar=").unwrap();
        let [title, x, y, bar] =
            ["A plate, cracked", "1", "up", ""].map(|text| Some(text.to_owned()));
        assert_eq!(found, Texts { title, x, y, bar });
        assert!(texts("plate").is_err() && texts("").is_err());
    }
}
