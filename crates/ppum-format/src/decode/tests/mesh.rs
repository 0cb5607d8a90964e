//! Meshes: what is written is read again, and what is wrong is named.

use ppum::dataset::{Dataset, FieldData};
use ppum::function::{Frame, FunctionKind};
use ppum::mesh::{Clip, Shape};
use ppum::polynomial::PolynomialSpace::{Tensor, Total};
use ppum_testkit::meshes::{
    BivariatePolynomial, MeshBuilder, field, random_map, random_polynomial,
};
use ppum_testkit::random::Random;

use super::put;
use crate::content::{Array, ArrayValues, ObjectTree};
use crate::{Arrays, bytes, encode};

/// A triangle and a square cut in two, all of them curved, with functions of level fields.
pub(super) fn dataset() -> Dataset {
    let (mut random, mut elements) = (Random(2), MeshBuilder::default());
    let triangle = random_map(&mut random, (Shape::Triangle, Total, 3), 0.9, 0.5);
    let square = random_map(&mut random, (Shape::Square, Tensor, 2), 0.9, 0.5);
    elements.push(Shape::Triangle, Total, 3, triangle);
    (0..2).for_each(|_| elements.push(Shape::Square, Tensor, 2, square.clone()));
    (elements.mesh.element, elements.mesh.map_offset[2]) =
        (vec![7, 9, 9], elements.mesh.map_offset[1]);
    let clip = |is_above| Clip { field: 1, is_above };
    (elements.mesh.clip_offsets, elements.mesh.clips) =
        (vec![0, 0, 1, 2], vec![clip(true), clip(false)]);
    let level = |p: BivariatePolynomial| vec![(Total, 1, p); 3];
    let parts = [(Total, 4), (Tensor, 3), (Tensor, 8)]
        .map(|(space, d)| (space, d, random_polynomial(&mut random, space, d.into())));
    let fields: Vec<FieldData> = vec![
        field("v", &parts),
        field("phi", &level(BivariatePolynomial::linear(0.1, 0.2, 1.0))),
        field("psi", &level(BivariatePolynomial::linear(0.0, 1.0, -0.2))),
    ];
    let mut data = elements.dataset(fields);
    let step = data.steps.remove(0).with_function("sign", FunctionKind::Level { field: 1 });
    let root = FunctionKind::formula("sqrt(r)*sin(theta/2)", Frame::Levels([2, 1]));
    data.steps.push(step.with_function("root", root));
    data
}

#[test]
fn meshes_are_read_as_they_were_written() {
    let data = dataset();
    let file = bytes::to_bytes(&data).expect("valid");
    assert_eq!(bytes::from_bytes(file).expect("a dataset"), data);
    // without clips and functions there are no arrays of them
    let mut plain = data;
    plain.steps[0].functions.truncate(1);
    let content = encode::content(&plain).expect("valid");
    assert!(content.contains_key("steps/0000/partition/clip_side"));
    assert!(!content.contains_key("steps/0000/functions/levels"));
    assert!(!content.contains_key("steps/0000/fields/0001/block_space"));
    let of_boxes = encode::content(&crate::everything::dataset(1)).expect("valid");
    let new = ["block_space", "levels", "clip", "map", "shape"];
    assert!(!of_boxes.keys().any(|key| new.iter().any(|new| key.contains(new))));
}

fn complaint(change: impl FnOnce(&mut ObjectTree)) -> String {
    let mut content = encode::content(&dataset()).expect("valid");
    change(&mut content);
    let mut arrays = Arrays::default();
    for (path, array) in content.iter() {
        arrays.insert(path, array.shape.clone(), array.values.clone());
    }
    let errors = arrays.dataset().expect_err("the change must be found");
    assert_eq!(errors.len(), 1, "{errors:?}");
    errors[0].to_string()
}

fn levels(rows: [[i64; 2]; 3]) -> Array {
    Array { shape: vec![3, 2], values: ArrayValues::I64(rows.concat()) }
}

#[test]
fn what_is_wrong_with_a_mesh_is_named() {
    let of = |name: &str, array: Array| complaint(|c| put(c, &format!("steps/0000/{name}"), array));
    let text = |word: &str| Array::scalar(word.to_owned());
    for (name, array, words) in [
        (
            "partition/shape",
            Array::vector([0u8, 1, 2]),
            "entry 2 is 2, expected one of: 0 (triangle), 1 (square)",
        ),
        (
            "partition/map_space",
            Array::vector([0u8, 3, 1]),
            "entry 1 is 3, expected one of: 0 (total degree)",
        ),
        (
            "partition/clip_side",
            Array::vector([0u8, 9]),
            "entry 1 is 9, expected one of: 0 (below), 1 (above)",
        ),
        ("partition/map_degree", Array::vector([3u8, 2]), "expected [3]"),
        ("partition/map", Array::vector([1.0]), "expected [2, "),
        ("partition/clip_offsets", Array::vector([0u64, 1, 2]), "expected [4]"),
        (
            "partition/clip_offsets",
            Array::vector([0u64, 0, 1, 3]),
            "clip_offsets[3]: is 3, but there are 2 clips",
        ),
        ("partition/clip_field", Array::vector([1u32, 8]), "clip_field[1]: index 8"),
        (
            "partition/map_offset",
            Array::vector([0u64, 9, 90]),
            "map_offset[2]: columns 90 + 8 reach beyond",
        ),
        ("partition@kind", text("shepard"), "unknown word `shepard`"),
        (
            "functions/levels",
            levels([[-1i64, -1], [-1, 1], [2, -1]]),
            "function 2 has no level field (-1) in column 1",
        ),
        (
            "functions/levels",
            levels([[-1i64, -1], [2, 1], [2, 1]]),
            "function 1 of the kind `level` does not use it",
        ),
        (
            "functions/levels",
            levels([[-1i64, -1], [-1, 5], [2, 1]]),
            "functions/levels[1]: index 5",
        ),
        (
            "fields/0001/block_space",
            Array::vector([0u8, 1, 2]),
            "entry 2 is 2, expected one of: 0 (total degree)",
        ),
    ] {
        let message = of(name, array);
        let place = format!("steps/0000/{name}");
        assert!(message.contains(&place) && message.contains(words), "{name}: {message}");
    }
    let missing = complaint(|c| drop(c.remove("steps/0000/partition/clip_side")));
    assert!(missing.starts_with("steps/0000/partition/clip_side: is missing"), "{missing}");
}

/// A mesh is its own domain.
#[test]
fn domains_and_partitions_are_of_one_kind() {
    let message = complaint(|c| put(c, "domain@kind", Array::scalar("box".to_owned())));
    assert!(message.contains("steps/0000/partition@kind: `mesh` does not belong to"), "{message}");
    let mut boxes = encode::content(&crate::everything::dataset(2)).expect("valid");
    put(&mut boxes, "domain@kind", Array::scalar("mesh".to_owned()));
    let error = crate::decode::dataset(&boxes).expect_err("boxes").to_string();
    assert!(error.contains("`shepard-box` does not belong to"), "{error}");
}
