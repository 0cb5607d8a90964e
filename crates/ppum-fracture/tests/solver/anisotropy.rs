//! Cracks in anisotropic bodies: exact fields of the plane, an independent collocation of
//! Lekhnitskii's potentials, and the properties that no direction of axes changes.

use crate::studies::support::{checked, parsed, solved};
use ppum::anisotropy::TipLaw;
use ppum::complex::Complex;
use ppum::dataset::{Dataset, TipIntensity};
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum_fracture::growth::series;
use ppum_testkit::random::Random;
use std::f64::consts::PI;
use std::fmt::Write as _;

/// Carbon fibres in epoxy: E₁, E₂, ν₁₂, G₁₂.
const CARBON: [f64; 4] = [144.8, 11.7, 0.21, 9.66];

fn engineering([e1, e2, nu, g]: [f64; 4], degrees: f64) -> String {
    format!(
        "young = [{e1:?}, {e2:?}]\npoisson = [{nu:?}]\nshear = {g:?}\naxis = {degrees:?}\nstate = \"plane-stress\"\n"
    )
}

fn solution(text: &str) -> Dataset {
    solved(&parsed(text))
}

/// A plate of the half width 1 with a crack from −½ to ½, pulled at both ends.
fn pulled(material: &str, height: f64, [level, order]: [usize; 2]) -> Dataset {
    solution(&format!(
        "[domain]\nmin = [-1, {}]\nmax = [1, {height}]\n[material]\n{material}\n\
         [[crack]]\npoints = [[-0.5, 0], [0.5, 0]]\n\
         [[boundary]]\non = \"bottom\"\ntraction = [0, -1]\n[[boundary]]\non = \"top\"\ntraction = [0, 1]\n\
         [discretization]\nlevel = {level}\norder = {order}\n",
        -height
    ))
}

/// K over σ √(πa) of the last tip.
fn shape(dataset: &Dataset) -> [f64; 2] {
    let found = dataset.steps[0].intensities.last().expect("a tip");
    [found.k1, found.k2].map(|k| k / (0.5 * PI).sqrt())
}

fn close(found: f64, expected: f64, size: f64, what: &str) {
    assert!((found - expected).abs() <= size, "{what}: {found:e} instead of {expected:e}");
}

/// Values of a collocation of potentials that leave the crack free.
#[test]
fn plates_with_oblique_fibres() {
    for (degrees, height, expected) in [
        (90.0, 1.0, [1.909_211_8, 0.0]),
        (60.0, 1.0, [1.700_507_8, 0.160_961_0 - 7e-7]),
        (45.0, 1.0, [1.468_440_7, 0.140_275_6]),
        (30.0, 1.0, [1.312_163_7, 0.119_724_3]),
    ] {
        let dataset = pulled(&engineering(CARBON, degrees), height, [4, 4]);
        let found = shape(&dataset);
        println!("{degrees} degrees: {found:?}");
        (0..2).for_each(|k| close(found[k], expected[k], 3e-5, &format!("{degrees} degrees")));
    }
}

/// The field of a crack in an infinite plane under stresses far away: a stiffness in the frame of
/// the crack, the crack's middle, its direction and half length, and σ_11, σ_22 and σ_12.
struct PlaneCrack {
    law: TipLaw,
    middle: Vec2,
    direction: Vec2,
    half: f64,
    remote: [f64; 3],
}

impl PlaneCrack {
    fn factors(&self) -> [f64; 2] {
        let [_, normal, shear] = self.remote;
        [normal, shear].map(|stress| stress * (PI * self.half).sqrt())
    }

    fn t_stress(&self) -> f64 {
        let [along, normal, shear] = self.remote;
        let [s1, s2] = self.law.roots;
        along + s1.times(s2).0 * normal + (s1.0 + s2.0) * shear
    }

    /// The displacement as two formulas: that of √(z_k² − a²) − z_k in place of √z_k, and of the
    /// stresses far away.
    fn formulas(&self) -> [String; 2] {
        let (c, s, middle) = (self.direction.x, self.direction.y, self.middle);
        let mut head = format!(
            "let v = x - ({:?}); let w = y - ({:?}); let p = v*({c:?}) + w*({s:?}); let q = w*({c:?}) - v*({s:?}); ",
            middle.x, middle.y
        );
        let [s1, s2] = self.law.roots;
        for (k, root) in [s1, s2].into_iter().enumerate() {
            let square = self.half * self.half;
            let Complex(a, b) = root;
            write!(
                head,
                "let z{k} = p + ({a:?})*q; let v{k} = ({b:?})*q; let a{k} = z{k}^2 - v{k}^2 - ({square:?}); \
                 let m{k} = hypot(a{k}, 2*z{k}*v{k}); \
                 let r{k} = sqrt(max((m{k} + a{k})/2, 0))*sign(z{k}) - z{k}; \
                 let i{k} = sqrt(max((m{k} - a{k})/2, 0))*sign(v{k}) - v{k}; "
            )
            .expect("a text");
        }
        let Complex(e, f) = s1.minus(s2).inverse();
        write!(
            head,
            "let d = (r0 - r1)*({e:?}) - (i0 - i1)*({f:?}); let g = (r0 - r1)*({f:?}) + (i0 - i1)*({e:?}); "
        )
        .expect("a text");
        let [along, normal, shear] = self.remote;
        let [a11, a12, a16, a22, a26, a66] = *self.law.compliance();
        let strain = [
            a11 * along + a12 * normal + a16 * shear,
            a12 * along + a22 * normal + a26 * shear,
            0.5 * (a16 * along + a26 * normal + a66 * shear),
        ];
        let [opening, sliding] = self.law.modes();
        let component = |i: usize, [x, y]: [f64; 2]| {
            let factor = |k: usize| opening[i][k].scaled(normal).plus(sliding[i][k].scaled(shear));
            let (Complex(a, b), Complex(c, d)) = (factor(0), factor(1));
            format!("(({a:?})*r0 - ({b:?})*i0 + ({c:?})*d - ({d:?})*g + ({x:?})*p + ({y:?})*q)")
        };
        let x = component(0, [strain[0], strain[2]]);
        let y = component(1, [strain[2], strain[1]]);
        [format!("{head}{x}*({c:?}) - {y}*({s:?})"), format!("{head}{x}*({s:?}) + {y}*({c:?})")]
    }

    /// The square around it held by the field.
    fn text(&self, material: &str, [level, order]: [usize; 2]) -> String {
        let ends = [-self.half, self.half].map(|along| self.middle + self.direction * along);
        let [u, v] = self.formulas();
        let edges = ["left", "right", "bottom", "top"].map(|edge| {
            format!("[[boundary]]\non = \"{edge}\"\ndisplacement = [\"{u}\", \"{v}\"]\n")
        });
        format!(
            "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\n{material}\n\
             [[crack]]\npoints = [[{:?}, {:?}], [{:?}, {:?}]]\n{}\
             [discretization]\nlevel = {level}\norder = {order}\n",
            ends[0].x,
            ends[0].y,
            ends[1].x,
            ends[1].y,
            edges.concat()
        )
    }

    /// Errors of K, T, J and G at a tip, in parts of |K|, of the largest stress and of G.
    fn errors(&self, found: &TipIntensity) -> [f64; 4] {
        // in the frame of the other tip, turned by π, stresses and roots are the same
        let ([k1, k2], released) = (self.factors(), self.law.energy_release(self.factors()));
        let own = self.law.energy_release([found.k1, found.k2]);
        [
            (found.k1 - k1).hypot(found.k2 - k2) / k1.hypot(k2),
            (found.t_stress.expect("T") - self.t_stress()).abs(),
            (found.j.expect("J") / released - 1.0).abs(),
            (own / released - 1.0).abs(),
        ]
    }
}

/// Carbon fibres at an angle to a crack that is turned by 20°.
fn oblique(degrees: f64) -> (PlaneCrack, String) {
    let turn = 20.0_f64.to_radians();
    let direction = vec2(turn.cos(), turn.sin());
    let material = engineering(CARBON, degrees + 20.0);
    let body = parsed(&format!("{}[material]\n{material}", BODY));
    let law = body.equation.anisotropy().expect("anisotropic").at_tip(Vec2::ZERO, direction);
    let remote = [0.4, 1.0, -0.6];
    (PlaneCrack { law, middle: vec2(0.02, -0.03), direction, half: 0.45, remote }, material)
}

const BODY: &str = "domain = { min = [-1, -1], max = [1, 1] }\ndiscretization = { level = 2 }\n\
     boundary = [{ on = \"bottom\", traction = [0, -1] }, { on = \"top\", traction = [0, 1] }]\n";

/// K, T, J and G in an exact field, for fibres in many directions, with the estimated error.
#[test]
fn cracks_in_a_plane() {
    for degrees in [0.0, 30.0, 75.0, 90.0] {
        let (field, material) = oblique(degrees);
        let dataset = solution(&field.text(&material, [4, 4]));
        for found in &dataset.steps[0].intensities {
            let [of_k, of_t, of_j, of_g] = field.errors(found);
            let size = found.k1.hypot(found.k2);
            let estimated = found.error.expect("an estimate") / size;
            println!(
                "{degrees} degrees: K {of_k:.1e} ({estimated:.1e}), T {of_t:.1e}, J {of_j:.1e}, G {of_g:.1e}"
            );
            assert!(of_k < 1e-4 && of_t < 1e-2 && of_j < 1e-3 && of_g < 1e-3, "{degrees}");
            assert!(estimated > 0.3 * of_k, "{degrees}: {estimated} of {of_k}");
        }
    }
}

/// Uniform stresses of fifty random laws are reproduced with a crack along them, to what the
/// quadrature at the tips leaves, which grows with the ratio of the moduli: K to 1e-9 times that
/// ratio, T, whose auxiliary field is that of a force at the tip, to 1e-8.
#[test]
fn patch_tests_of_random_laws() {
    let mut random = Random(41);
    for _ in 0..50 {
        let mut rows = [[0.0; 3]; 3];
        rows.iter_mut().flatten().for_each(|entry| *entry = random.between(-1.0, 1.0));
        let entry = |i: usize, j: usize| {
            let product: f64 = (0..3).map(|k| rows[k][i] * rows[k][j]).sum();
            product + if i == j { 0.2 } else { 0.0 }
        };
        let row = |i: usize| format!("[{:?}, {:?}, {:?}]", entry(i, 0), entry(i, 1), entry(i, 2));
        let degrees = random.between(-90.0, 90.0);
        let material = format!(
            "stiffness = [{}, {}, {}]\naxis = {degrees:?}\nstate = \"plane-stress\"",
            row(0),
            row(1),
            row(2)
        );
        // along the crack: no face sees the stress
        let text = format!(
            "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\n{material}\n\
             [[crack]]\npoints = [[-0.4, 0.1], [0.3, 0.1]]\n\
             [[boundary]]\non = \"left\"\ntraction = [-1, 0]\n[[boundary]]\non = \"right\"\ntraction = [1, 0]\n\
             [discretization]\nlevel = 2\norder = 2\n"
        );
        let dataset = solution(&text);
        for found in &dataset.steps[0].intensities {
            let size = found.k1.abs().max(found.k2.abs());
            let t = found.t_stress.expect("T");
            // no eigenvalue is less than 0.2
            let left = 1e-9 * (0..3).map(|i| entry(i, i)).sum::<f64>() / 0.2;
            assert!(size < 2.0 * left && (t - 1.0).abs() < 30.0 * left, "{found:?} in {material}");
        }
    }
}

/// The isotropic body through this code: the same K, and changes in proportion to those of E₂.
#[test]
fn nearly_isotropic_bodies() {
    let (young, nu) = (1.0, 0.3);
    let of = |change: f64| {
        let all = [young, young * (1.0 + change), nu, young / (2.0 * (1.0 + nu))];
        shape(&pulled(&engineering(all, 25.0), 1.0, [3, 4]))
    };
    let isotropic = "young = 1\npoisson = 0.3\nstate = \"plane-stress\"";
    let [expected, _] = shape(&pulled(isotropic, 1.0, [3, 4]));
    let own = of(0.0);
    close(own[0], expected, 1e-9, "isotropic");
    close(own[1], 0.0, 1e-9, "isotropic");
    let rates = [1e-3, 1e-5, 1e-7].map(|change| (of(change)[0] - own[0]) / change);
    println!("{expected} {own:?} rates {rates:?}");
    close(rates[1], rates[0], 3e-3 * rates[0].abs(), "E2 (1 + 1e-5)");
    close(rates[2], rates[1], 3e-2 * rates[0].abs(), "E2 (1 + 1e-7)");
}

/// A body, its axes and its crack turned as a whole, and mirrored.
#[test]
fn turned_and_mirrored_bodies() {
    let (field, material) = oblique(35.0);
    let own = solution(&field.text(&material, [3, 4]));
    let mirrored = PlaneCrack {
        law: field.law,
        direction: vec2(field.direction.y, field.direction.x),
        middle: vec2(field.middle.y, field.middle.x),
        ..field
    };
    // mirrored at x = y axes turn the other way: the law in the crack's frame has shear reversed
    let [c11, c12, c16, c22, c26, c66] = field.law.stiffness();
    let law = TipLaw::new(&[c11, c12, -c16, c22, -c26, c66]);
    let [along, normal, shear] = field.remote;
    let mirrored = PlaneCrack { law, remote: [along, normal, -shear], ..mirrored };
    let other = solution(&mirrored.text(&engineering(CARBON, 90.0 - 55.0), [3, 4]));
    let quarter = PlaneCrack {
        law: field.law,
        direction: field.direction.left(),
        middle: field.middle.left(),
        ..field
    };
    let turned = solution(&quarter.text(&engineering(CARBON, 145.0), [3, 4]));
    for k in 0..2 {
        let [a, b, c] = [&own, &other, &turned].map(|set| &set.steps[0].intensities[k]);
        close(b.k1, a.k1, 1e-8, "mirrored");
        close(b.k2, -a.k2, 1e-8, "mirrored");
        close(c.k1, a.k1, 1e-8, "turned");
        close(c.k2, a.k2, 1e-8, "turned");
    }
}

/// Curved fibres: J, which needs how the law changes, is what the law at the tip releases.
#[test]
fn curved_fibres() {
    let [e1, e2, nu, g] = CARBON;
    let material = format!(
        "young = [{e1:?}, {e2:?}]\npoisson = [{nu:?}]\nshear = \"{g:?}*(1 + 0.1*x)\"\naxis = \"40 + 30*x + 20*y\"\n\
         state = \"plane-stress\"\n"
    );
    let dataset = pulled(&material, 1.0, [5, 3]);
    let body = dataset.equation.elastic().expect("elastic");
    for found in &dataset.steps[0].intensities {
        let crack = &dataset.steps[0].cracks[0];
        let (at, axis) = (crack.end_point(found.tip.end), crack.growth_direction(found.tip.end));
        let released = found.energy_release_in(body, [at, axis]);
        let j = found.j.expect("J");
        println!("curved fibres: J {j}, G {released}, error {:?}", found.error);
        close(j / released, 1.0, 2e-3, "J of G");
    }
}

/// A cleavage plane turns the path of an isotropic body, and fibres that of an orthotropic one.
#[test]
fn paths_by_direction() {
    let text = |material: &str, toughness: &str| {
        format!(
            "[domain]\nmin = [-1, -1]\nmax = [1, 1]\n[material]\n{material}\n\
             [[crack]]\npoints = [[-1, 0], [0, 0]]\n\
             [[boundary]]\non = \"bottom\"\ntraction = [0, -1]\n[[boundary]]\non = \"top\"\ntraction = [0, 1]\n\
             [growth]\nsteps = 1\nincrement = 0.1\ntoughness = \"{toughness}\"\n\
             [discretization]\nlevel = 3\norder = 2\n"
        )
    };
    let angle = |material: &str, toughness: &str| {
        let problem = checked(&parsed(&text(material, toughness)));
        let dataset = series(&problem, None, unwatched()).expect("a series");
        let growth = dataset.steps[0].growth.as_ref();
        growth.map_or(f64::NAN, |growth| growth.tips[0].direction)
    };
    let isotropic = "young = 1\npoisson = 0.3\nstate = \"plane-stress\"";
    let cleavage = "0.1*(1 - 0.9*exp(-((direction - 0.5)/0.05)^2))";
    close(angle(isotropic, cleavage), 0.5, 0.02, "a cleavage plane");
    close(angle(isotropic, "0.1"), 0.0, 1e-3, "without one");
}
