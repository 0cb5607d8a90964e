//! The quantities of a field, in groups, with symbols and meanings; and the names that formulas of
//! it may use.

use std::sync::Arc;

use ppum::equation::TEMPERATURE;
use ppum::field::Field;
use ppum::formula::function_names;
use ppum::quantity::{Quantity, Vocabulary, available};
use ppum_render::cells;
use ppum_scene::quantity::OF_PATCHES;

use crate::field::OwnedField;
use crate::shapes::plain;
use crate::widgets::chooser::ChooserItem;

/// The quantities of a field.
#[derive(Default)]
pub struct FieldChoices {
    of: Option<Arc<OwnedField>>,
    /// All that can be chosen.
    pub choices: Vec<ChooserItem>,
    /// Names that formulas of quantities may use.
    pub names: Vec<String>,
}

impl FieldChoices {
    /// Looks up what is not known yet.
    pub fn look_up(&mut self, field: &Arc<OwnedField>) {
        if self.of.as_ref().is_some_and(|known| Arc::ptr_eq(known, field)) {
            return;
        }
        self.choices = choices(field.field());
        let vocabulary = Vocabulary::of(field.field());
        self.names = vocabulary.names().chain(function_names().map(str::to_owned)).collect();
        self.names.extend(["pi", "let", "and", "or", "not"].map(str::to_owned));
        self.of = Some(Arc::clone(field));
    }

    /// The field.
    pub(crate) fn field(&self) -> Option<&Arc<OwnedField>> {
        self.of.as_ref()
    }
}

fn choices(field: &Field<'_>) -> Vec<ChooserItem> {
    let named = field.quantities.iter().filter(|named| Quantity::parse(&named.name, field).is_ok());
    let named = named.map(|named| ChooserItem {
        value: named.name.clone(),
        about: ppum::formula::one_line(&named.text),
        group: "Of the file",
    });
    let is_named = |name: &String| field.quantities.iter().any(|named| named.name == *name);
    let all = available(field).into_iter().filter(|name| !is_named(name));
    let usable = all.filter_map(|value| {
        let quantity = Quantity::parse(&value, field).ok()?;
        let (about, group) = (about(&quantity, &field.data.components), group(&value, &quantity));
        Some(ChooserItem { value, about, group })
    });
    let phi = ChooserItem { value: "phi:0".into(), about: meaning_of_phi(), group: PARTITION };
    let mut all: Vec<ChooserItem> = named.chain(usable).chain([phi]).collect();
    let of_cells = cells::names(field).into_iter().map(|name| {
        let is_taken = all.iter().any(|choice| choice.value == name);
        let of = if cells::exist(field) { "cell" } else { "patch" };
        let label = if name == INDICATOR { "estimated error" } else { cells::label(&name) };
        let about = format!("{label}, of each {of}");
        let value = if is_taken { format!("{OF_PATCHES}{name}") } else { name };
        ChooserItem { value, about, group: "Values of cells" }
    });
    let of_cells: Vec<ChooserItem> = of_cells.collect();
    all.extend(of_cells);
    all.sort_by_key(|choice| GROUPS.iter().position(|group| *group == choice.group));
    all
}

const PARTITION: &str = "Partition of unity";
/// The attribute of datasets that an adaptation refines by.
const INDICATOR: &str = "indicator";

/// Groups of quantities, in their order.
const GROUPS: [&str; 9] = [
    "Of the file",
    "Field",
    "Stress",
    "Strain",
    "Derivatives",
    "Energy",
    "Error",
    PARTITION,
    "Values of cells",
];

fn group(name: &str, quantity: &Quantity) -> &'static str {
    match quantity {
        Quantity::Formula(_) if HEAT.contains(&name) || name == "magnitude" => "Field",
        Quantity::Formula(_) if name == "gradient" => "Derivatives",
        Quantity::Formula(_) if STRAINS.contains(&name) => "Strain",
        Quantity::Formula(_) if name == "energy" => "Energy and error",
        Quantity::Component(_) | Quantity::Magnitude => "Field",
        Quantity::Derivative(..) | Quantity::GradientNorm => "Derivatives",
        Quantity::Divergence | Quantity::Curl | Quantity::Strain(..) => "Strain",
        Quantity::EnergyDensity => "Energy",
        Quantity::Error => "Error",
        Quantity::WeightSum | Quantity::Overlap | Quantity::PartitionFunction(_) => PARTITION,
        _ => "Stress",
    }
}

/// Quantities that are formulas of the library, and are no stresses.
const HEAT: [&str; 4] = [TEMPERATURE, "qx", "qy", "flux"];
const STRAINS: [&str; 7] = ["elastic-xx", "elastic-yy", "elastic-xy", "e11", "e22", "e12", "ehoop"];

fn meaning_of_phi() -> String {
    "φ of a patch, by its number".into()
}

/// Symbol and meaning.
fn about(quantity: &Quantity, components: &[String]) -> String {
    let meaning = match quantity {
        Quantity::Component(2) if components[2] == TEMPERATURE => "temperature",
        Quantity::Component(_) if components.len() > 1 => "displacement",
        Quantity::Component(_) => "potential",
        Quantity::Magnitude => "size of the field",
        Quantity::GradientNorm => "size of the gradient",
        Quantity::Divergence => "change of area",
        Quantity::Curl => "twice the rotation",
        Quantity::Strain(a, b) if a == b => "strain",
        Quantity::Strain(..) => "shear strain",
        Quantity::Stress(a, b) if a == b => "stress",
        Quantity::Stress(..) => "shear stress",
        Quantity::StressOut => "stress out of the plane",
        Quantity::Principal1 => "the larger one",
        Quantity::Principal2 => "the smaller one",
        Quantity::WeightSum => "sum of the weights",
        Quantity::Error => "distance from the exact solution",
        _ => "",
    };
    let symbol = plain(&quantity.symbol(components));
    if meaning.is_empty() { symbol } else { format!("{symbol}, {meaning}") }
}
