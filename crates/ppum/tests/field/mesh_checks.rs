//! What is wrong with meshes is said with the array, the row and a remedy.

use ppum::dataset::{BoxPartition, Dataset, Partition};
use ppum::domain::Hole;
use ppum::function::{Frame, FunctionKind};
use ppum::mesh::{Clip, Mesh, Shape};
use ppum::polynomial::PolynomialSpace::{self, Tensor, Total};
use ppum::vec2::vec2;
use ppum_testkit::meshes::{BivariatePolynomial, MeshBuilder, field};

/// Two elements, the second cut into two patches, with a level field.
fn dataset() -> Dataset {
    let mut elements = MeshBuilder::default();
    let map = |x: f64| {
        [BivariatePolynomial::linear(x, 1.0, 0.0), BivariatePolynomial::linear(0.0, 0.0, 1.0)]
    };
    elements.push(Shape::Square, Tensor, 2, map(-1.0));
    elements.push(Shape::Square, Total, 1, map(1.0));
    elements.push(Shape::Square, Total, 1, map(1.0));
    let clip = |is_above| Clip { field: 1, is_above };
    elements.mesh.clip_offsets = vec![0, 0, 1, 2];
    elements.mesh.clips = vec![clip(true), clip(false)];
    let [x, y] = map(0.0);
    let parts = |space: PolynomialSpace, p: &BivariatePolynomial| vec![(space, 1, p.clone()); 3];
    elements.dataset(vec![field("v", &parts(Tensor, &x)), field("phi", &parts(Total, &y))])
}

fn error(change: impl FnOnce(&mut Dataset)) -> String {
    let mut data = dataset();
    change(&mut data);
    data.check().expect_err("the change must be found").to_string()
}

fn of_mesh(change: impl FnOnce(&mut Mesh)) -> String {
    error(|data| {
        let Partition::Mesh(mesh) = &mut data.steps[0].partition else { panic!("a mesh") };
        change(mesh);
    })
}

#[test]
fn a_good_mesh_passes() {
    assert_eq!(dataset().check(), Ok(()));
}

#[test]
fn arrays_of_meshes() {
    let at = |message: String, place: &str, words: &str| {
        let place = format!("steps[0].partition.{place}: ");
        assert!(message.starts_with(&place) && message.contains(words), "{message}");
    };
    at(of_mesh(|m| *m = Mesh::default()), "shape", "no patch");
    at(of_mesh(|m| m.origin.truncate(2)), "origin", "expected 3");
    at(of_mesh(|m| m.element.push(0)), "element", "expected 3");
    at(of_mesh(|m| m.origin[1].y = f64::NAN), "origin[1]", "not a finite point");
    at(of_mesh(|m| m.map_degree[2] = 0), "map_degree[2]", "between 1 and 8");
    at(of_mesh(|m| m.map_degree[2] = 9), "map_degree[2]", "between 1 and 8");
    at(of_mesh(|m| m.map_offset[0] = 5), "map_offset[0]", "reach beyond the 12");
    at(of_mesh(|m| m.map_offset[1] = u64::MAX), "map_offset[1]", "reach beyond");
    at(of_mesh(|m| m.map[1][3] = f64::INFINITY), "map[1][3]", "not a finite number");
    at(of_mesh(|m| m.map[1].truncate(3)), "map[1]", "expected 12");
    at(of_mesh(|m| m.map[0][8] = 1e308), "map_offset[1]", "not finite");
    at(of_mesh(|m| m.clip_offsets.truncate(2)), "clip_offsets", "one more than patches");
    at(of_mesh(|m| m.clip_offsets[0] = 1), "clip_offsets[0]", "expected 0");
    at(of_mesh(|m| m.clip_offsets[2] = 3), "clip_offsets[3]", "must not fall");
    at(of_mesh(|m| m.clip_offsets[3] = 3), "clip_offsets[3]", "there are 2 clips");
    at(of_mesh(|m| m.clips[1].field = 2), "clip_field[1]", "there are 2 fields");
    at(of_mesh(|m| m.origin[0].x = -5.0), "origin[0]", "enlarge the domain");
}

/// Determinants: turned round, zero at a corner, folded inside.
#[test]
fn folded_elements() {
    let turned = of_mesh(|m| m.map[0][8] = -1.0);
    let words = "steps[0].partition.map_offset[1]: the map of patch 1 (element 1) has the determinant -1 at (0, 0)";
    assert!(turned.starts_with(words) && turned.contains("counter-clockwise order"), "{turned}");
    // ξ + c ξη has the slope 1 + c η by ξ
    for (c, is_fine) in [(0.99, true), (1.0, false), (-1.0, false), (1.5, false)] {
        let mut data = dataset();
        let Partition::Mesh(mesh) = &mut data.steps[0].partition else { panic!("a mesh") };
        mesh.map[0][3] = c;
        data.domain.bounds.min.x = -9.0;
        assert_eq!(data.check().is_ok(), is_fine, "{c}");
    }
}

#[test]
fn level_fields() {
    let two = |d: &mut Dataset| {
        let field = &mut d.steps[0].fields[1];
        field.components.push("w".into());
        field.coefficients.push(field.coefficients[0].clone());
    };
    let message = error(two);
    assert!(
        message.contains("clip_field[0]") && message.contains("a level field has one"),
        "{message}"
    );
    let sign = |field| {
        move |d: &mut Dataset| {
            let step = d.steps.remove(0).with_function("sign", FunctionKind::Level { field });
            d.steps.push(step);
        }
    };
    assert!(error(sign(7)).starts_with("steps[0].functions[1].levels: index 7"));
    let frame = |d: &mut Dataset| {
        let kind = FunctionKind::formula("r", Frame::Levels([1, 4]));
        let step = d.steps.remove(0).with_function("r", kind);
        d.steps.push(step);
    };
    assert!(error(frame).starts_with("steps[0].functions[1].frame.levels: index 4"));
    // a level field with a function of its own
    let enriched = error(|d| {
        sign(1)(d);
        d.steps[0].fields[1].block_function[2] = 1;
    });
    assert!(enriched.contains("block 2 has a function"), "{enriched}");
}

/// Level fields and tensor products belong to meshes, meshes have domains without holes and follow
/// no boxes.
#[test]
fn meshes_and_boxes_do_not_mix() {
    let holes = error(|d| {
        d.domain.holes.push(Hole::Circle { center: vec2(0.0, 0.0), radius: 0.1 });
    });
    assert!(holes.contains("leave the holes out"), "{holes}");
    let (center, half) = (vec2(0.0, 0.0), vec2(4.0, 2.0));
    let boxes = BoxPartition {
        center: vec![center],
        half: vec![half],
        origin: vec![center],
        scale: vec![half],
        cell: vec![dataset().domain.bounds],
        level: vec![0],
        point: vec![None],
        ..BoxPartition::EMPTY
    };
    let on_boxes = |d: &mut Dataset| {
        let step = &mut d.steps[0];
        step.partition = boxes.clone().into();
        for field in &mut step.fields {
            field.patch_blocks = vec![0, 3];
        }
    };
    assert!(error(on_boxes).contains("block_space[0]: a tensor product on a box"));
    let signed = error(|d| {
        on_boxes(d);
        d.steps[0].fields[0].block_space.clear();
        d.steps[0].fields.truncate(1);
        d.steps[0].functions[0].kind = FunctionKind::Level { field: 0 };
    });
    assert!(signed.contains("functions[0].levels: level fields belong to meshes"), "{signed}");
    let mixed = error(|d| {
        let mut other = d.clone();
        on_boxes(&mut other);
        other.steps[0].fields.iter_mut().for_each(|field| {
            field.block_space.clear();
            field.block_degree.fill(0);
        });
        d.steps.extend(other.steps);
    });
    assert!(mixed.starts_with("steps[1].partition: is of boxes"), "{mixed}");
    let spaces = error(|d| d.steps[0].fields[0].block_space.truncate(1));
    assert!(spaces.contains("block_space: has 1 entries, expected 3"), "{spaces}");
}
