use super::*;
use ppum::cover::Cover;
use ppum::weight::WeightFunction;

use ppum_problem::{BaseCells, Discretization, ProblemData};

#[test]
fn clipped_lengths_and_distances() {
    let open = Rect::new(vec2(0.0, 0.0), vec2(2.0, 1.0));
    for (a, b, length, apart) in [
        (vec2(-1.0, 0.5), vec2(3.0, 0.5), 2.0, 0.0),
        (vec2(0.5, 0.5), vec2(0.5, 0.75), 0.25, 0.0),
        (vec2(0.0, 0.0), vec2(2.0, 0.0), 0.0, 0.0),
        (vec2(-1.0, -1.0), vec2(3.0, 3.0), 2f64.sqrt(), 0.0),
        // the corner (0, 1) is 2.5 (x + 1) − 2 (y − 0.5) = 1.5 over √10.25 off the line
        (vec2(-1.0, 0.5), vec2(1.0, 3.0), 0.0, 1.5 / 10.25f64.sqrt()),
        (vec2(5.0, 4.0), vec2(6.0, 9.0), 0.0, 18f64.sqrt()),
    ] {
        assert!((edge_inside(Edge::segment([a, b]), &open) - length).abs() < 1e-15, "{a:?} {b:?}");
        assert!((distance(Edge::segment([a, b]), &open) - apart).abs() < 1e-15, "{a:?} {b:?}");
        assert!((distance(Edge::segment([b, a]), &open) - apart).abs() < 1e-15, "{a:?} {b:?}");
    }
}

/// [0, 8]² with unit cells and patches 1.5 wide.
fn problem() -> ProblemData {
    let domain = Rect::new(vec2(0.0, 0.0), vec2(8.0, 8.0));
    let mut set = Discretization::new(BaseCells::Grid([8, 8]));
    set.enrichment = Enrichment::None;
    ProblemData::poisson(domain, 1.0, set)
}

/// The patches of a problem that have a function of this name, by the lower left corner of their
/// cells, with the degrees.
fn having(problem: &ProblemData, name: &str) -> Vec<([i32; 2], u8)> {
    let cover = Cover::grid(problem.domain().bounds, [8, 8]).expect("a cover");
    let partition = cover.partition(1.5, WeightFunction::Linear).expect("a partition");
    let problem = Problem::new(problem.clone()).expect("a problem in order");
    let mut all = Enrichments::new(&problem);
    let function = all.table.iter().position(|f| f.name == name).expect("a function") as u32;
    let mut found = Vec::new();
    for patch in 0..partition.len() {
        let blocks = all.blocks(&partition, patch, 2);
        assert_eq!(blocks[0], (0, 2));
        let of_function: Vec<_> = blocks.iter().filter(|block| block.0 == function).collect();
        assert!(of_function.len() <= 1, "twice on one patch");
        let corner = partition.cell[patch].min;
        found.extend(of_function.iter().map(|b| ([corner.x as i32, corner.y as i32], b.1)));
    }
    found.sort_unstable();
    found
}

fn with(new: LocalEnrichment) -> ProblemData {
    ProblemData { enrichments: vec![new], ..problem() }
}

#[test]
fn world() {
    let new = LocalEnrichment { degree: Some(1), ..LocalEnrichment::new(&["x^9"], Site::World) };
    let found = having(&with(new.clone()), "x^9");
    assert!(found.len() == 64 && found.iter().all(|f| f.1 == 1));
    // The supports of the cells from 5 on reach beyond x = 5.1, that of cell 4 to 5.25, of 3
    // to 4.25.
    let right = "if(x > 5.1, 1, 0)".parse().expect("an expression");
    let found =
        having(&with(LocalEnrichment { region: EnrichmentRegion::Where(right), ..new }), "x^9");
    assert!(found.len() == 32 && found.iter().all(|f| f.0[0] >= 4), "{found:?}");
}

#[test]
fn at_a_point() {
    let site = Site::Point { at: vec2(3.1, 4.5), angle: 0.0 };
    let new = LocalEnrichment { name: "root".into(), ..LocalEnrichment::new(&["sqrt(r)"], site) };
    let name = "root at [3.1, 4.5]";
    assert_eq!(having(&with(new.clone()), name), [([2, 4], 0), ([3, 4], 0)]);
    let wide = LocalEnrichment { region: EnrichmentRegion::Near(0.3), ..new };
    let found: Vec<_> = having(&with(wide), name).into_iter().map(|f| f.0).collect();
    // 0.25 from (3.1, 4.5) to the row below and above, 0.15 on the left is held
    assert_eq!(found, [[2, 3], [2, 4], [2, 5], [3, 3], [3, 4], [3, 5]]);
}

#[test]
fn along_a_segment() {
    let site = Site::Along([vec2(0.0, 2.5), vec2(2.5, 2.5)]);
    let name = "abs(y) along [0, 2.5] to [2.5, 2.5]";
    let new = LocalEnrichment::new(&["abs(y)"], site);
    let found: Vec<_> = having(&with(new.clone()), name).into_iter().map(|f| f.0).collect();
    assert_eq!(found, [[0, 2], [1, 2], [2, 2]]);
    let wide = LocalEnrichment { region: EnrichmentRegion::Near(0.251), ..new };
    let found: Vec<_> = having(&with(wide), name).into_iter().map(|f| f.0).collect();
    // rows 1 and 3 begin 0.25 off the line, column 3 begins 0.25 behind its end
    let expected: Vec<_> = (0..4).flat_map(|x| (1..4).map(move |y| [x, y])).collect();
    let corner = |p: &[i32; 2]| p[0] == 3 && p[1] != 2;
    assert_eq!(found, expected.into_iter().filter(|p| !corner(p)).collect::<Vec<_>>());
}

/// The built-in enrichment of tips and the same functions as an enrichment of one's own stand on
/// the same patches with the same degrees.
#[test]
fn at_tips_as_built_in() {
    let mut built_in = problem().with_crack(&[[0.0, 4.5], [3.1, 4.5]]);
    built_in.discretization.enrichment = Enrichment::Zone;
    let mut own = built_in.clone();
    own.discretization.enrichment = Enrichment::Jumps;
    own.enrichments = vec![LocalEnrichment::new(&WESTERGAARD, Site::Tips)];
    let name = "westergaard 2 of crack 0 end";
    let found = having(&built_in, name);
    assert_eq!(found, having(&own, &format!("{} of crack 0 end", WESTERGAARD[1])));
    assert!(found.contains(&([3, 4], 1)) && found.contains(&([3, 5], 0)), "{found:?}");
    for problem in [&built_in, &own] {
        assert_eq!(having(problem, "side of crack 0"), [([0, 4], 2), ([1, 4], 2)]);
    }
    let mut tip_patch = built_in;
    tip_patch.discretization.enrichment = Enrichment::TipPatch;
    assert_eq!(having(&tip_patch, name), [([2, 4], 1), ([3, 4], 1)]);
    own.enrichments[0].region = EnrichmentRegion::Near(0.0);
    let found = having(&own, &format!("{} of crack 0 end", WESTERGAARD[1]));
    assert_eq!(found, having(&tip_patch, name));
}

/// Tip functions alone stand in the zone and along the crack, on the half that is nearer to
/// the tip.
#[test]
fn additive_only() {
    let mut problem = problem().with_crack(&[[1.5, 4.5], [6.7, 4.5]]);
    problem.discretization.enrichment = Enrichment::AdditiveOnly;
    problem.discretization.enrichment_radius = Some(0.1);
    let columns = |name| having(&problem, name).into_iter().map(|(c, d)| (c[0], c[1], d));
    let start: Vec<_> = columns("westergaard 1 of crack 0 start").collect();
    assert_eq!(start, [(1, 4, 0), (2, 4, 0), (3, 4, 0)]);
    let end: Vec<_> = columns("westergaard 4 of crack 0 end").collect();
    // the last one begins 0.05 behind the tip
    assert_eq!(end, [(4, 4, 0), (5, 4, 0), (6, 4, 0), (7, 4, 0)]);
    assert!(
        Enrichments::new(&Problem::new(problem.clone()).expect("in order"))
            .table
            .iter()
            .all(|f| !f.name.contains("side"))
    );
}
