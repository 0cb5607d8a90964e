//! Values of patches as images: each pixel has that of the cell, the element, or without these
//! the patch with the largest φ, that its centre lies in.

use ppum::crack::Side;
use ppum::field::Field;
use ppum_raster::raster::Raster;
use ppum_raster::view::View;
use rayon::prelude::*;

/// Names of what every field knows of its patches, and the words for them. Boxes have levels,
/// elements their numbers.
const OWN: [(&str, &str); 5] = [
    ("level", "level"),
    ("element", "element"),
    ("order", "order p"),
    ("blocks", "blocks"),
    ("functions", "functions"),
];

/// A value per patch of a field, by its name: `level` of the cell; `element`, the number of a
/// mesh's element; `order`, the largest degree of the patch's blocks; `blocks`, their number;
/// `functions`, that of their functions f_b ξ^k, (d + 1)(d + 2)/2 of a block of degree d; or an
/// attribute of the step with another name. None if there is none of this name.
#[must_use]
pub fn values(field: &Field<'_>, name: &str) -> Option<Vec<f64>> {
    let (partition, data) = (&field.step.partition, field.data);
    let patches = 0..partition.len();
    let degree = |block: usize| data.block_degree[block];
    let functions =
        |patch: usize| data.blocks(patch).map(|b| data.block_size(b)).sum::<usize>() as f64;
    Some(match name {
        "level" if partition.boxes().has_cells() => {
            partition.boxes().level.iter().map(|&level| level.into()).collect()
        }
        "element" if partition.mesh().is_some() => {
            let elements = partition.mesh().map_or(&[][..], |mesh| &mesh.element);
            elements.iter().map(|&element| element.into()).collect()
        }
        "order" => patches.map(|i| data.blocks(i).map(degree).max().unwrap_or(0).into()).collect(),
        "blocks" => patches.map(|i| data.blocks(i).len() as f64).collect(),
        "functions" => patches.map(functions).collect(),
        _ => {
            let found = field.step.attributes.iter().find(|attribute| attribute.name == name)?;
            found.values.clone()
        }
    })
}

/// True if patches have cells, or are elements: else they only overlap.
#[must_use]
pub fn exist(field: &Field<'_>) -> bool {
    let partition = &field.step.partition;
    partition.mesh().is_some() || partition.boxes().has_cells()
}

/// The names that [`values`] knows for a field.
#[must_use]
pub fn names(field: &Field<'_>) -> Vec<String> {
    let attributes = field.step.attributes.iter().map(|attribute| attribute.name.as_str());
    let is_own = |name: &str| OWN.iter().any(|(own, _)| *own == name);
    let other = attributes.filter(|name| !is_own(name));
    let partition = &field.step.partition;
    let is_known = |name: &&str| match *name {
        "level" => partition.boxes().has_cells(),
        "element" => partition.mesh().is_some(),
        _ => true,
    };
    let own = OWN.iter().map(|(name, _)| *name).filter(is_known);
    own.chain(other).map(str::to_owned).collect()
}

/// The words for them in figures: `order p`; of an attribute its name.
#[must_use]
pub fn label(name: &str) -> &str {
    OWN.iter().find(|(own, _)| *own == name).map_or(name, |(_, label)| label)
}

/// The image of one value per patch, NaN outside the domain and where there is no cell. Borders
/// belong to the right and upper cell. In a cover without cells, a point has the value of the patch
/// whose φ is largest there.
///
/// # Panics
/// If there is not one value per patch.
#[must_use]
pub fn raster(field: &Field<'_>, values: &[f64], view: &View) -> Raster {
    assert_eq!(values.len(), field.step.partition.len(), "one value per patch");
    if !field.step.partition.boxes().has_cells() {
        return of_owners(field, values, view);
    }
    let cells = &field.step.partition.boxes().cell;
    let (domain, last) = (field.domain.at(view.center), field.domain.bounds.max - view.center);
    let [columns, rows] = view.pixels.map(|n| n as usize);
    let mut raster = Raster::new(view.pixels, vec![f64::NAN; columns * rows]);
    for (cell, &value) in cells.iter().zip(values) {
        let [across, down] = view.inside(cell);
        for (row, column) in down.flat_map(|row| across.clone().map(move |column| (row, column))) {
            let (offset, max) = (view.offset(column as u32, row as u32), cell.max - view.center);
            let is_left = offset.x < max.x || max.x >= last.x;
            let is_below = offset.y < max.y || max.y >= last.y;
            if is_left && is_below && domain.contains(offset) {
                raster.values[row * columns + column] = value;
            }
        }
    }
    raster
}

/// The image of one value per element, or per patch without a cell, NaN outside.
pub(crate) fn of_owners(field: &Field<'_>, values: &[f64], view: &View) -> Raster {
    let local = field.at(view.center);
    let [columns, rows] = view.pixels.map(|n| n as usize);
    let value = |k: usize| {
        let offset = view.offset((k % columns) as u32, (k / columns) as u32);
        local.owner(offset, Side::Above).map_or(f64::NAN, |patch| values[patch])
    };
    Raster::new(view.pixels, (0..columns * rows).into_par_iter().map(value).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::cover::Cover;
    use ppum::dataset::{Attribute, Dataset, Equation, FieldData, Step};
    use ppum::domain::{Domain, Hole};
    use ppum::vec2::{Rect, vec2};
    use ppum::weight::WeightFunction;

    fn dataset() -> Dataset {
        let bounds = Rect::new(vec2(0.0, 0.0), vec2(4.0, 4.0));
        let holes = vec![Hole::Circle { center: vec2(3.0, 3.0), radius: 0.7 }];
        let cover = Cover::uniform(bounds, 2).expect("a cover");
        let partition = cover.partition(1.3, WeightFunction::Linear).expect("a partition");
        let mut field = FieldData::new("potential", &["u"]);
        (0..partition.len()).for_each(|i| field.push_patch(&[(0, (i % 3) as u8)]));
        let values: Vec<f64> = (0..partition.len()).map(|i| i as f64).collect();
        let mut step = Step::new(partition).with_function("one", ppum::function::FunctionKind::One);
        step = step.with_field(field);
        let attribute = |name: &str| Attribute { name: name.into(), values: values.clone() };
        step.attributes = vec![attribute("order"), attribute("number")];
        let domain = Domain { bounds, holes };
        Dataset::new(domain, Equation::poisson(1.0)).with_step(step)
    }

    /// Against the definition, pixel by pixel, also where pixel centres lie on borders of cells.
    #[test]
    fn pixels_have_the_values_of_their_cells() {
        let dataset = dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let numbers = values(&field, "number").expect("the attribute");
        for view in [
            View::window(-0.5, -0.5, 4.5, 4.5, [50, 50]).unwrap(),
            View::new(vec2(2.0, 2.0), 4.5, [9, 9]).unwrap(),
            View::new(vec2(1.0, 1.0), 1e-12, [5, 5]).unwrap(),
        ] {
            let found = raster(&field, &numbers, &view);
            for (i, j) in (0..view.pixels[0]).flat_map(|i| (0..view.pixels[1]).map(move |j| (i, j)))
            {
                let p = view.center + view.offset(i, j);
                let column = |x: f64| x.floor().clamp(0.0, 3.0);
                let holds = |cell: &Rect| cell.min == vec2(column(p.x), column(p.y));
                let cell = field.step.partition.boxes().cell.iter().position(holds);
                let expected = match cell {
                    Some(cell) if field.domain.contains(p) => numbers[cell],
                    _ => f64::NAN,
                };
                let value = found.value(i, j);
                assert!(
                    value == expected || value.is_nan() && expected.is_nan(),
                    "{p:?} {value} {expected}"
                );
            }
        }
    }

    /// Without cells a point has the value of the patch with the largest φ, on the deformed body of
    /// a field that does not move, too.
    #[test]
    fn largest_patches_own_points_without_cells() {
        let mut dataset = dataset();
        let boxes = dataset.steps[0].partition.boxes_mut().expect("boxes");
        (boxes.cell, boxes.level) = (Vec::new(), Vec::new());
        boxes.half.iter_mut().enumerate().for_each(|(i, half)| *half = *half * [1.0, 1.3][i % 2]);
        let field = Field::new(&dataset, 0).expect("a field");
        assert_eq!(names(&field), ["order", "blocks", "functions", "number"]);
        let numbers = values(&field, "number").expect("the attribute");
        let view = View::window(-0.5, -0.5, 4.5, 4.5, [50, 50]).unwrap();
        let found = raster(&field, &numbers, &view);
        for (i, j) in (0..50).flat_map(|i| (0..50).map(move |j| (i, j))) {
            let (mut local, offset) = (field.at(view.center), view.offset(i, j));
            let phi = |patch| Some((local.partition_function::<0>(patch, offset)?.v, patch));
            let all: Vec<_> = (0..numbers.len()).filter_map(phi).collect();
            let most = all.iter().fold(0.0f64, |most, (phi, _)| most.max(*phi));
            match all.iter().find(|(phi, _)| *phi == most && most > 0.0) {
                Some((_, patch)) => assert_eq!(found.value(i, j), numbers[*patch], "{i} {j}"),
                None => assert!(found.value(i, j).is_nan(), "{i} {j}"),
            }
        }
    }

    #[test]
    fn values_have_names() {
        let dataset = dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        assert_eq!(names(&field), ["level", "order", "blocks", "functions", "number"]);
        for name in names(&field) {
            let found = values(&field, &name).expect("known");
            assert_eq!(found.len(), field.step.partition.len(), "{name}");
        }
        assert_eq!(values(&field, "order").expect("orders")[..4], [0.0, 1.0, 2.0, 0.0]);
        assert_eq!(values(&field, "blocks").expect("numbers")[5], 1.0);
        assert_eq!(values(&field, "functions").expect("numbers")[..4], [1.0, 3.0, 6.0, 1.0]);
        assert_eq!([label("order"), label("number")], ["order p", "number"]);
        assert!(values(&field, "weight").is_none());
    }
}
