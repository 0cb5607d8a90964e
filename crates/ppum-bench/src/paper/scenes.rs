//! The scenes that are measured: the paper's, and what else drawing depends on.

use clap::ValueEnum;
use ppum::library::ELASTICITY;
use ppum::vec2::{Vec2, vec2};
use serde::Serialize;

use crate::synthetic::{CrackRecipe, DOMAIN, TIPS};

/// The subjects of the tables, each with its scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum SceneGroup {
    /// Table 1 of the paper, graded covers, a million patches
    Patches,
    /// Order of the polynomials
    Orders,
    /// All patches enriched
    Enriched,
    /// Zooms towards a tip
    Zooms,
    /// Formulas in place of kernels
    Formulas,
    /// Colours alone
    Colors,
}

impl SceneGroup {
    pub(super) const ALL: [Self; 6] =
        [Self::Patches, Self::Orders, Self::Enriched, Self::Zooms, Self::Formulas, Self::Colors];

    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Patches => "Table 1 of the paper, graded covers, a million patches",
            Self::Orders => "Order of the polynomials",
            Self::Enriched => "All patches enriched",
            Self::Zooms => "Zooms towards a tip",
            Self::Formulas => "Formulas in place of kernels",
            Self::Colors => "Colours alone",
        }
    }
}

/// The drawn quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SceneQuantity {
    /// The stress by its kernel.
    Stress,
    /// The stress by its formula in the library.
    StressByFormula,
    /// A formula of functions that are no arithmetic.
    Elementary,
    /// The colours of the stress, which is there already.
    Colors,
}

impl SceneQuantity {
    /// The quantity, as `-q` takes it.
    pub(super) fn quantity(self) -> &'static str {
        match self {
            Self::Stress | Self::Colors => "von-mises",
            Self::StressByFormula => ELASTICITY
                .iter()
                .find(|(name, _)| *name == "von_mises")
                .map_or("", |(_, text)| text),
            Self::Elementary => "exp(ux) + log(1 + von_mises)*(1.5 + sin(9*uy)) + atan(von_mises)",
        }
    }

    fn words(self) -> &'static str {
        match self {
            Self::Stress => "stress by its kernel",
            Self::StressByFormula => "stress by its formula",
            Self::Elementary => "exp, log, sin, atan",
            Self::Colors => "colours of a stress",
        }
    }
}

/// A cover with what is drawn of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PaperScene {
    pub(super) group: SceneGroup,
    pub(super) recipe: CrackRecipe,
    pub(super) zoom: f64,
    pub(super) subject: SceneQuantity,
}

/// A weight that a formula gives, and that a kernel has too.
const LINEAR: &str = "1 - t";

impl PaperScene {
    fn new(group: SceneGroup, recipe: CrackRecipe) -> Self {
        Self { group, recipe, zoom: 1.0, subject: SceneQuantity::Stress }
    }

    pub(super) fn cover(&self) -> &'static str {
        if self.recipe.level == self.recipe.tip_level { "uniform" } else { "graded" }
    }

    /// The middle of its images.
    pub(super) fn center(&self) -> Vec2 {
        // a pixel on a tip is infinite: images are centred a bit beside it
        let beside = vec2(0.011, 0.017) * (DOMAIN.size().x / self.zoom);
        if self.zoom == 1.0 { DOMAIN.center() } else { TIPS[1] + beside }
    }

    /// Returns the words that distinguish it within its group.
    pub(super) fn words(&self) -> String {
        let CrackRecipe { order, enriched, weight, .. } = self.recipe;
        match self.group {
            SceneGroup::Patches => String::new(),
            SceneGroup::Orders => format!("order {order}"),
            SceneGroup::Enriched => format!("{:.0} % enriched", 100.0 * enriched),
            SceneGroup::Zooms if self.zoom == 1.0 => "zoom 1".to_owned(),
            SceneGroup::Zooms => format!("zoom 1e{:.0}", self.zoom.log10()),
            SceneGroup::Formulas if weight.is_some() => "weight by its formula".to_owned(),
            SceneGroup::Formulas | SceneGroup::Colors => self.subject.words().to_owned(),
        }
    }
}

/// All scenes, or a few of each kind on few patches.
pub(super) fn scenes(quick: bool) -> Vec<PaperScene> {
    let [coarse, fine, graded] = if quick {
        [CrackRecipe::new(2, 2), CrackRecipe::new(4, 4), CrackRecipe::new(2, 5)]
    } else {
        [CrackRecipe::new(2, 2), CrackRecipe::new(6, 6), CrackRecipe::new(6, 14)]
    };
    let patches =
        covers(quick).into_iter().map(|recipe| PaperScene::new(SceneGroup::Patches, recipe));
    let typical = [coarse, fine, graded];
    let orders = typical.into_iter().flat_map(|recipe| {
        [1, 2, 4, 8]
            .map(|order| PaperScene::new(SceneGroup::Orders, CrackRecipe { order, ..recipe }))
    });
    let enriched = typical.map(|recipe| {
        PaperScene::new(SceneGroup::Enriched, CrackRecipe { enriched: 1.0, ..recipe })
    });
    let zooms = [1.0, 1e3, 1e6, 1e9, 1e12]
        .map(|zoom| PaperScene { zoom, ..PaperScene::new(SceneGroup::Zooms, graded) });
    let formulas = [coarse, fine].into_iter().flat_map(formulas);
    let colors = PaperScene {
        subject: SceneQuantity::Colors,
        ..PaperScene::new(SceneGroup::Colors, coarse)
    };
    let all = patches.chain(orders).chain(enriched).chain(zooms).chain(formulas);
    all.chain([colors]).collect()
}

/// Those of the paper and beyond.
fn covers(quick: bool) -> Vec<CrackRecipe> {
    let (uniform, graded): (&[u8], &[[u8; 2]]) = if quick {
        (&[2, 3, 4], &[[2, 5]])
    } else {
        (&[2, 3, 4, 5, 6, 7, 10], &[[3, 10], [4, 14], [5, 14], [6, 14]])
    };
    let uniform = uniform.iter().map(|&level| CrackRecipe::new(level, level));
    uniform
        .chain(graded.iter().map(|&[level, tip_level]| CrackRecipe::new(level, tip_level)))
        .collect()
}

fn formulas(recipe: CrackRecipe) -> [PaperScene; 4] {
    let scene = PaperScene::new(SceneGroup::Formulas, recipe);
    [
        scene,
        PaperScene { subject: SceneQuantity::StressByFormula, ..scene },
        PaperScene { recipe: CrackRecipe { weight: Some(LINEAR), ..recipe }, ..scene },
        PaperScene { subject: SceneQuantity::Elementary, ..scene },
    ]
}
