//! The formulas of a dataset: each must be one of its scope, with the dataset's tables.

use std::collections::BTreeSet;
use std::fmt::Display;
use std::sync::Arc;

use super::errors::{CheckError, CheckResult, Errors, check_names, fail, require};
use super::fields::MAX_COMPONENTS;
use crate::dataset::{
    Dataset, FieldData, MAX_QUANTITIES, MAX_QUANTITY_TEXT, MAX_TABLES, NamedQuantity, Step,
};
use crate::function::{CompileError, FunctionTable};
use crate::quantity::{QuantityFormula, Vocabulary, names};
use crate::weight::WeightFunction;
use ppum_formula::{Formula, Scope, ScopeError, Table, VARIABLES};

/// Checks names of tables, then all formulas but those of quantities, which need checked fields.
/// True if there is nothing wrong with them.
pub(super) fn check(dataset: &Dataset, errors: &mut Errors) -> bool {
    let tables = &dataset.tables;
    let few = errors.add(at_most("tables", tables.len(), MAX_TABLES, "tables"));
    let plane = with_tables(&VARIABLES, tables).and_then(|_| with_tables(&["x", "y"], tables));
    let plane = match plane {
        Ok(plane) if few => plane,
        Ok(_) => return false,
        Err(error) => return errors.add(Err(message("tables", &error))),
    };
    let mut is_fine = true;
    for (name, expression) in dataset.equation.constants() {
        is_fine &= errors.add(parse(&format!("equation.{name}"), expression.text(), &plane));
    }
    for (k, step) in dataset.steps.iter().enumerate() {
        is_fine &= errors.within(&format!("steps[{k}]"), |e| check_step(step, tables, &plane, e));
    }
    is_fine
}

fn at_most(place: &str, count: usize, most: usize, of: &str) -> CheckResult {
    require(count <= most, place, || format!("there are {count} {of}, but at most {most} may be"))
}

fn with_tables(variables: &[&str], tables: &[Arc<Table>]) -> Result<Scope, ScopeError> {
    Scope::new(variables)?.with_tables(tables)
}

fn message(place: &str, message: &dyn Display) -> CheckError {
    CheckError { place: place.to_owned(), message: message.to_string() }
}

fn parse(place: &str, text: &str, scope: &Scope) -> CheckResult {
    Formula::parse(text, scope).map(drop).map_err(|error| message(place, &error))
}

fn check_step(step: &Step, tables: &[Arc<Table>], plane: &Scope, errors: &mut Errors) {
    if let WeightFunction::Formula(weight) = &step.partition.boxes().weight {
        let scope = with_tables(&["t"], tables).map_err(|error| message("tables", &error));
        errors.add(scope.and_then(|scope| parse("partition.weight", weight.text(), &scope)));
    }
    errors.add(check_functions(step, tables));
    for (k, field) in step.fields.iter().enumerate() {
        errors.within(&format!("fields[{k}]"), |errors| {
            errors.each("exact", &field.exact, |_, text| parse("", text, plane));
        });
    }
}

fn check_functions(step: &Step, tables: &[Arc<Table>]) -> CheckResult {
    let Err(error) = FunctionTable::new(&step.functions, step.cracks.len(), tables) else {
        return Ok(());
    };
    let part = match *error.source {
        CompileError::Scope(_) => "parameters",
        _ => "formula",
    };
    fail(&format!("functions[{}].{part}", error.index), error.source.to_string())
}

/// Checks the quantities that a dataset names: names of their own, and formulas of the first field
/// of each step, which may use the quantities before them.
pub(super) fn check_quantities(dataset: &Dataset, errors: &mut Errors) {
    let all = || {
        check_quantity_names(dataset)?;
        check_quantity_texts(dataset)
    };
    errors.add(all());
}

fn check_quantity_names(dataset: &Dataset) -> CheckResult {
    at_most("quantities", dataset.quantities.len(), MAX_QUANTITIES, "quantities")?;
    let bytes = dataset.quantities.iter().map(|quantity| quantity.text.len()).sum();
    at_most("quantities", bytes, MAX_QUANTITY_TEXT, "bytes of formulas")?;
    check_names("quantities", dataset.quantities.iter().map(|quantity| &quantity.name))?;
    for NamedQuantity { name, .. } in &dataset.quantities {
        require(is_name(name), &format!("quantities `{name}`"), || {
            "names are letters, digits, `_` and `-`, a letter or `_` first".into()
        })?;
    }
    let mut all = components(dataset.steps.iter().flat_map(|step| &step.fields));
    all.try_for_each(|components| check_names_of(dataset, components))
}

fn check_quantity_texts(dataset: &Dataset) -> CheckResult {
    let mut first = components(dataset.steps.iter().filter_map(|step| step.fields.first()));
    first.try_for_each(|components| check_texts(dataset, components))
}

/// The components of fields, each list once, without those whose number is an error: what names of
/// thousands mean takes too long to say.
fn components<'d>(
    fields: impl Iterator<Item = &'d FieldData>,
) -> impl Iterator<Item = &'d Vec<String>> {
    let all: BTreeSet<_> = fields.map(|field| &field.components).collect();
    all.into_iter().filter(|components| components.len() <= MAX_COMPONENTS)
}

fn check_names_of(dataset: &Dataset, components: &[String]) -> CheckResult {
    let built_in = names(&dataset.equation, components);
    for NamedQuantity { name, .. } in &dataset.quantities {
        let place = format!("quantities `{name}`");
        if built_in.iter().any(|(known, _)| known == name) {
            return fail(&place, "a field has a quantity of this name; choose another".into());
        }
    }
    Ok(())
}

fn check_texts(dataset: &Dataset, components: &[String]) -> CheckResult {
    let Dataset { equation, tables, quantities, .. } = dataset;
    let parse = |place: &str, text: &str, named| {
        let vocabulary = Vocabulary { equation, components, tables, named };
        QuantityFormula::new(text, &vocabulary).map(drop).map_err(|error| message(place, &error))
    };
    // any number is a formula where the names do not clash
    parse("tables", "0", &[])?;
    for (k, NamedQuantity { name, text, .. }) in quantities.iter().enumerate() {
        let place = format!("quantities `{name}`");
        parse(&place, text, &quantities[..k])?;
        parse(&place, "0", &quantities[..=k])?;
    }
    Ok(())
}

fn is_name(name: &str) -> bool {
    let letter = |c: char| c.is_ascii_alphabetic() || c == '_';
    name.starts_with(letter) && name.chars().all(|c| letter(c) || c.is_ascii_digit() || c == '-')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::tests::dataset;
    use crate::equation::{Elasticity, Equation, StressState};
    use crate::expression::Expression;
    use crate::function::{Frame, Function, FunctionKind, NonsmoothPoints, Role};

    fn table(name: &str) -> Arc<Table> {
        Arc::new(Table::curve(name, vec![0.0, 1.0], vec![1.0, 2.0]).expect("a table"))
    }

    fn quantity(name: &str, text: &str) -> NamedQuantity {
        NamedQuantity { name: name.into(), text: text.into(), unit: String::new() }
    }

    fn function(text: &str) -> FunctionKind {
        let parameters = vec![("a".to_owned(), 2.0)];
        let (text, declared) = (text.to_owned(), NonsmoothPoints::default());
        FunctionKind::Formula { text, frame: Frame::World, parameters, declared, role: Role::User }
    }

    fn body(young: &str, tables: &[Arc<Table>]) -> Equation {
        let scope = Scope::cartesian().with_tables(tables).expect("new names");
        Equation::Elasticity(Elasticity {
            young: Expression::parse_in(young, &scope).expect("a formula"),
            poisson: 0.3.into(),
            state: StressState::PlaneStrain,
            eigenstrain: None,
            anisotropy: None,
        })
    }

    /// Every kind of formula, all of them with a table.
    fn good() -> Dataset {
        let mut data = dataset();
        data.tables = vec![table("k"), table("q")];
        data.equation = body("table(k, x*y)", &data.tables);
        let scope = with_tables(&["t"], &data.tables).expect("new names");
        let weight = WeightFunction::formula("(1 - t)*table(k, t)", &scope);
        data.steps[0].partition.boxes_mut().expect("boxes").weight = weight.expect("a weight");
        data.steps[0].functions[1].kind = function("a*table(k, r)*theta");
        data.steps[0].fields[0].exact = vec!["table(k, y)".into(), "0".into()];
        data.quantities = vec![quantity("a-b", "von_mises/table(q, ux) + young*duy_dx")];
        data
    }

    fn error_after(change: impl FnOnce(&mut Dataset)) -> CheckError {
        let mut data = good();
        change(&mut data);
        data.check().expect_err("the change must be found")
    }

    #[test]
    fn tables_are_known_in_every_formula() {
        assert_eq!(good().check(), Ok(()));
        type DatasetChange = fn(&mut Dataset);
        let places: [(&str, DatasetChange); 5] = [
            ("equation.young", |_| {}),
            ("steps[0].partition.weight", |d| d.equation = dataset().equation),
            ("steps[0].functions[1].formula", |d| {
                d.equation = dataset().equation;
                d.steps[0].partition.boxes_mut().expect("boxes").weight = WeightFunction::Linear;
            }),
            ("steps[0].fields[0].exact[0]", |d| {
                d.equation = dataset().equation;
                d.steps[0].partition = dataset().steps.remove(0).partition;
                d.steps[0].functions[1].kind = function("a*r");
            }),
            ("quantities `a-b`", |d| {
                let exact = vec!["x".to_owned(), "0".to_owned()];
                d.equation = dataset().equation;
                d.steps = dataset().steps;
                d.steps[0].fields[0].exact = exact;
            }),
        ];
        for (place, change) in places {
            let error = error_after(|d| {
                change(d);
                d.tables.clear();
            });
            assert_eq!(error.place, place);
            assert!(error.message.contains("there are no tables here"), "{error}");
        }
    }

    #[test]
    fn mistakes_point_at_the_text() {
        let error = error_after(|d| d.steps[0].functions[1].kind = function("x +\n  b*y"));
        assert_eq!(error.place, "steps[0].functions[1].formula");
        assert!(error.message.contains("line 2, column 3: unknown name `b`"), "{error}");
        let error = error_after(|d| d.steps[0].fields[0].exact[1] = "r".into());
        assert_eq!(error.place, "steps[0].fields[0].exact[1]");
        let error = error_after(|d| d.steps[0].functions[1].kind = function(" "));
        assert_eq!(error.place, "steps[0].functions[1].formula");
    }

    #[test]
    fn names_do_not_clash() {
        for name in ["x", "theta", "t", "sin", "1a", "k"] {
            assert_eq!(error_after(|d| d.tables.push(table(name))).place, "tables", "{name}");
        }
        let error = error_after(|d| d.tables.push(table("a")));
        assert_eq!(error.place, "steps[0].functions[1].parameters");
        for name in ["ux", "sxx", "duy_dx", "mu"] {
            assert_eq!(error_after(|d| d.tables.push(table(name))).place, "tables", "{name}");
        }
        for name in [
            "",
            "ux",
            "von-mises",
            "von_mises",
            "duy_dx",
            "a b",
            "phi:3",
            "7",
            "-a",
            "a-b",
            "a_b",
            "k",
        ] {
            let error = error_after(|d| d.quantities.push(quantity(name, "x")));
            assert!(error.place.starts_with("quantities"), "{name}: {error}");
        }
    }

    #[test]
    fn quantities_are_formulas_of_the_first_field() {
        for text in ["u", "theta", "q", "phi", "a_b", "x < y", ""] {
            let error = error_after(|d| d.quantities[0].text = text.into());
            assert_eq!(error.place, "quantities `a-b`", "{text}");
        }
        let mut data = good();
        data.quantities[0].text = "s1 - s2 + exx*lambda/mu + poisson + energy".into();
        data.quantities.push(quantity("twice", "2*a_b"));
        assert_eq!(data.check(), Ok(()));
        data.quantities.swap(0, 1);
        let error = data.check().expect_err("used before it is defined");
        assert_eq!(error.place, "quantities `twice`");
        data.quantities = (0..300).map(|k| quantity(&format!("q{k}"), "x")).collect();
        assert_eq!(data.check().expect_err("too many").place, "quantities");
        data.quantities = vec![quantity("q", &"x +".repeat(30_000))];
        assert_eq!(data.check().expect_err("too long").place, "quantities");
    }

    #[test]
    fn formulas_have_limits_together() {
        let error = error_after(|d| {
            d.tables.extend((0..300).map(|k| table(&format!("t{k}"))));
        });
        assert_eq!(error.to_string(), "tables: there are 302 tables, but at most 256 may be");
        // each has terms of its own
        let long = |k: usize| -> String {
            (0..500).map(|j| format!("sin({j}.{k}*x*y) + ")).chain(["x".to_owned()]).collect()
        };
        let error = error_after(|d| {
            let function = |k| Function { name: "f".into(), kind: function(&long(k)) };
            d.steps[0].functions.extend((0..200).map(function));
        });
        assert!(error.message.contains("operations together"), "{error}");
        let error = error_after(|d| {
            let crack = d.steps[0].cracks[0].clone();
            d.steps[0].cracks = vec![crack; 2000];
            let function = |_| Function { name: "f".into(), kind: function("x") };
            d.steps[0].functions.extend((0..600).map(function));
        });
        assert!(error.message.contains("cracks, tables and parameters"), "{error}");
    }
}
