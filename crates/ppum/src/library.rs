//! The built-in functions, as formulas.
//!
//! Everything this crate evaluates by a kernel written by hand is defined here by a text; the
//! kernels are held to their texts by tests. Problems name the weights and enrichments of this
//! library; formulas of quantities may use its quantities by their names.

/// A function of the library, or several that belong together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Name in problems.
    pub name: &'static str,
    /// Its kind.
    pub about: &'static str,
    /// Its parameters with their defaults.
    pub parameters: &'static [(&'static str, f64)],
    /// The formulas.
    pub texts: &'static [&'static str],
}

const NONE: &[(&str, f64)] = &[];

/// Weight functions of t = |ξ| on 0 ≤ t < 1; they end at t = 1.
pub const WEIGHTS: [Entry; 6] = [
    Entry { name: "linear", about: "B-spline of degree 1", parameters: NONE, texts: &["1 - t"] },
    Entry {
        name: "quadratic",
        about: "B-spline of degree 2, knots at ±1/3, ±1",
        parameters: NONE,
        texts: &["if(t < 1/3, 1 - 3*t^2, 3/2*(1 - t)^2)"],
    },
    Entry {
        name: "cubic",
        about: "B-spline of degree 3, knots at 0, ±1/2, ±1",
        parameters: NONE,
        texts: &["if(t < 1/2, 1 - 6*t^2 + 6*t^3, 2*(1 - t)^3)"],
    },
    Entry {
        name: "bump",
        about: "infinitely smooth, all derivatives vanish at t = 1",
        parameters: NONE,
        texts: &["exp(1 - 1/((1 - t)*(1 + t)))"],
    },
    Entry {
        name: "cosine",
        about: "half a wave of the cosine, with continuous slope",
        parameters: NONE,
        texts: &["cos(pi*t/2)^2"],
    },
    Entry {
        name: "wendland",
        about: "polynomial of least degree with continuous curvature (Wendland 1995)",
        parameters: NONE,
        texts: &["(1 - t)^4*(4*t + 1)"],
    },
];

/// The four Westergaard functions in the order of equation (6) of Üffinger et al. 2011.
pub const WESTERGAARD: [&str; 4] = [
    "sqrt(r)*cos(theta/2)",
    "sqrt(r)*sin(theta/2)",
    "sqrt(r)*sin(theta)*sin(theta/2)",
    "sqrt(r)*sin(theta)*cos(theta/2)",
];

/// Functions that span the fields r^λ of an elastic wedge, θ counted from its bisector
/// (Williams 1952).
pub const WEDGE: [&str; 4] = [
    "r^lambda*cos(lambda*theta)",
    "r^lambda*sin(lambda*theta)",
    "r^lambda*cos((lambda - 2)*theta)",
    "r^lambda*sin((lambda - 2)*theta)",
];

/// Enrichment functions of x, y, r, theta of their frame.
///
/// Frames: `westergaard` and `williams` belong to crack tips, θ jumps on the crack; `corner` and
/// `wedge` to a point; `kink` and the layers to a line, y is the distance to its left.
pub const ENRICHMENTS: [Entry; 7] = [
    Entry {
        name: "westergaard",
        about: "the four functions of equation (6) of Üffinger et al. 2011: √r fields of a crack tip",
        parameters: NONE,
        texts: &WESTERGAARD,
    },
    Entry {
        name: "williams",
        about: "functions that span the n-th term of Williams' series (1957), r^(n/2)",
        parameters: &[("n", 3.0)],
        texts: &[
            "r^(n/2)*cos(n*theta/2)",
            "r^(n/2)*sin(n*theta/2)",
            "r^(n/2)*cos((n - 4)*theta/2)",
            "r^(n/2)*sin((n - 4)*theta/2)",
        ],
    },
    Entry {
        name: "kink",
        about: "weak discontinuity |d| across a line: a jump of the normal derivative",
        parameters: NONE,
        texts: &["abs(y)"],
    },
    Entry {
        name: "corner",
        about: "r^λ cos λθ and r^λ sin λθ: harmonic functions of a corner, an interface or a slit",
        parameters: &[("lambda", 2.0 / 3.0)],
        texts: &["r^lambda*cos(lambda*theta)", "r^lambda*sin(lambda*theta)"],
    },
    Entry {
        name: "wedge",
        about: "functions that span the fields r^λ of an elastic corner, θ from its bisector (Williams 1952)",
        parameters: &[("lambda", 0.544_483_736_782_464)],
        texts: &WEDGE,
    },
    Entry {
        name: "boundary-layer",
        about: "exponential layer of width ε beside a line",
        parameters: &[("epsilon", 0.01)],
        texts: &["exp(-abs(y)/epsilon)"],
    },
    Entry {
        name: "log-layer",
        about: "logarithmic layer beside a line that begins at the distance ε",
        parameters: &[("epsilon", 0.01)],
        texts: &["log(1 + abs(y)/epsilon)"],
    },
];

/// A quantity: its name with `_` for `-`, and its formula. It may use those before it.
pub type Definition = (&'static str, &'static str);

/// The moduli of an elastic material in plane strain, of `young` and `poisson`: those of
/// [`Moduli`](crate::equation::Moduli).
pub const PLANE_STRAIN: [Definition; 3] = [
    ("mu", "young/(2*(1 + poisson))"),
    ("lambda", "young*poisson/((1 + poisson)*(1 - 2*poisson))"),
    ("out_of_plane", "poisson"),
];

/// The moduli of an elastic material in plane stress, of `young` and `poisson`.
pub const PLANE_STRESS: [Definition; 3] = [
    ("mu", "young/(2*(1 + poisson))"),
    ("lambda", "young*poisson/((1 - poisson)*(1 + poisson))"),
    ("out_of_plane", "0"),
];

/// Quantities of a field with the components ux, uy and their derivatives `dux_dx`, …, in a
/// material with `mu`, `lambda` and `out_of_plane` = σ_zz / (σ_xx + σ_yy).
///
/// Principal stresses are the mean (λ + μ) tr ε plus and minus the radius of Mohr's circle, μ times
/// the length of (ε_xx − ε_yy, 2 ε_xy); von Mises' and Tresca's stress are made of that radius and
/// of the mean less σ_zz. So nothing cancels that is not small by itself, in single
/// precision neither.
pub const ELASTICITY: [Definition; 18] = [
    ("magnitude", "sqrt(ux^2 + uy^2)"),
    ("gradient", "sqrt(dux_dx^2 + dux_dy^2 + duy_dx^2 + duy_dy^2)"),
    ("divergence", "dux_dx + duy_dy"),
    ("curl", "duy_dx - dux_dy"),
    ("exx", "dux_dx"),
    ("eyy", "duy_dy"),
    ("exy", "(dux_dy + duy_dx)/2"),
    ("sxx", "2*mu*exx + lambda*(exx + eyy)"),
    ("syy", "2*mu*eyy + lambda*(exx + eyy)"),
    ("sxy", "2*mu*exy"),
    ("szz", "out_of_plane*(sxx + syy)"),
    (
        "von_mises",
        "hypot(sqrt(3)*mu*hypot(exx - eyy, 2*exy), (lambda + mu)*(1 - 2*out_of_plane)*(exx + eyy))",
    ),
    ("s1", "(lambda + mu)*(exx + eyy) + mu*hypot(exx - eyy, 2*exy)"),
    ("s2", "(lambda + mu)*(exx + eyy) - mu*hypot(exx - eyy, 2*exy)"),
    (
        "tresca",
        "mu*hypot(exx - eyy, 2*exy) + max(mu*hypot(exx - eyy, 2*exy), abs((lambda + mu)*(1 - 2*out_of_plane)*(exx + eyy)))",
    ),
    ("direction", "if(exy == 0, if(exx >= eyy, 0, pi/2), atan2(2*exy, exx - eyy)/2)"),
    ("hydrostatic", "(sxx + syy + szz)/3"),
    ("energy", "((lambda + mu)*(exx + eyy)^2 + mu*((exx - eyy)^2 + 4*exy^2))/2"),
];

/// The quantities of stresses where strains ε⁰ are given, in place of those of [`ELASTICITY`]: σ =
/// C(ε − ε⁰) with the elastic strains in the plane, and σ_zz = ν(σ_xx + σ_yy) − E ε⁰_zz.
pub const EIGENSTRAIN: [Definition; 14] = [
    ("elastic_xx", "exx - (eigenstrain_xx + out_of_plane*eigenstrain_zz)"),
    ("elastic_yy", "eyy - (eigenstrain_yy + out_of_plane*eigenstrain_zz)"),
    ("elastic_xy", "exy - eigenstrain_xy"),
    ("sxx", "2*mu*elastic_xx + lambda*(elastic_xx + elastic_yy)"),
    ("syy", "2*mu*elastic_yy + lambda*(elastic_xx + elastic_yy)"),
    ("sxy", "2*mu*elastic_xy"),
    ("szz", "out_of_plane*(sxx + syy) - young*eigenstrain_zz"),
    (
        "von_mises",
        "hypot(sqrt(3)*mu*hypot(elastic_xx - elastic_yy, 2*elastic_xy), (sxx + syy)/2 - szz)",
    ),
    (
        "s1",
        "(lambda + mu)*(elastic_xx + elastic_yy) + mu*hypot(elastic_xx - elastic_yy, 2*elastic_xy)",
    ),
    (
        "s2",
        "(lambda + mu)*(elastic_xx + elastic_yy) - mu*hypot(elastic_xx - elastic_yy, 2*elastic_xy)",
    ),
    ("tresca", "(s1 - s2)/2 + max((s1 - s2)/2, abs((sxx + syy)/2 - szz))"),
    ("direction", "if(sxy == 0, if(sxx >= syy, 0, pi/2), atan2(2*sxy, sxx - syy)/2)"),
    ("hydrostatic", "(sxx + syy + szz)/3"),
    ("energy", "(sxx*elastic_xx + syy*elastic_yy + 2*sxy*elastic_xy + young*eigenstrain_zz^2)/2"),
];

/// The quantities of stresses in an anisotropic body, in place of those of [`ELASTICITY`]: of the
/// elastic strains along its axes, with its constants `c11`, … and the angle `axis`. In plane
/// stress the constants of the third direction are zero, and so is σ_zz.
pub const ANISOTROPY: [Definition; 20] = [
    ("elastic_xx", "exx - eigenstrain_xx"),
    ("elastic_yy", "eyy - eigenstrain_yy"),
    ("elastic_xy", "exy - eigenstrain_xy"),
    ("e11", "elastic_xx*cos(axis)^2 + elastic_yy*sin(axis)^2 + elastic_xy*sin(2*axis)"),
    ("e22", "elastic_xx*sin(axis)^2 + elastic_yy*cos(axis)^2 - elastic_xy*sin(2*axis)"),
    ("e12", "(elastic_yy - elastic_xx)*sin(2*axis)/2 + elastic_xy*cos(2*axis)"),
    ("s11", "c11*e11 + c12*e22 + 2*c16*e12 - c13*eigenstrain_zz"),
    ("s22", "c12*e11 + c22*e22 + 2*c26*e12 - c23*eigenstrain_zz"),
    ("s12", "c16*e11 + c26*e22 + 2*c66*e12 - c36*eigenstrain_zz"),
    ("sxx", "s11*cos(axis)^2 + s22*sin(axis)^2 - s12*sin(2*axis)"),
    ("syy", "s11*sin(axis)^2 + s22*cos(axis)^2 + s12*sin(2*axis)"),
    ("sxy", "(s11 - s22)*sin(2*axis)/2 + s12*cos(2*axis)"),
    ("szz", "c13*e11 + c23*e22 + 2*c36*e12 - c33*eigenstrain_zz"),
    ("von_mises", "hypot(sqrt(3)*hypot((s11 - s22)/2, s12), (s11 + s22)/2 - szz)"),
    ("s1", "(s11 + s22)/2 + hypot((s11 - s22)/2, s12)"),
    ("s2", "(s11 + s22)/2 - hypot((s11 - s22)/2, s12)"),
    ("tresca", "(s1 - s2)/2 + max((s1 - s2)/2, abs((s11 + s22)/2 - szz))"),
    ("direction", "if(sxy == 0, if(sxx >= syy, 0, pi/2), atan2(2*sxy, sxx - syy)/2)"),
    ("hydrostatic", "(s11 + s22 + szz)/3"),
    ("energy", "(s11*e11 + s22*e22 + 2*s12*e12 - szz*eigenstrain_zz)/2"),
];

/// The hoop strain of a body of revolution, u_x/x. The third direction of plane strain is given it
/// away, ε⁰_zz − u_x/x in place of ε⁰_zz: so all formulas of [`EIGENSTRAIN`] hold, with σ_zz the
/// hoop stress.
pub const HOOP_STRAIN: Definition = ("ehoop", "if(x == 0, dux_dx, ux/x)");

/// Number of quantities of [`ELASTICITY`] before those that [`EIGENSTRAIN`] and [`ANISOTROPY`] take
/// the place of.
pub const STRAINS: usize = 7;

/// Quantities of a field with the one component u, the last [`HEAT`] of them by the names of heat:
/// q = −κ ∇u.
pub const POISSON: [Definition; 7] = [
    ("magnitude", "abs(u)"),
    ("gradient", "sqrt(du_dx^2 + du_dy^2)"),
    ("energy", "conductivity*(du_dx^2 + du_dy^2)/2"),
    ("temperature", "u"),
    ("qx", "-conductivity*du_dx"),
    ("qy", "-conductivity*du_dy"),
    ("flux", "conductivity*sqrt(du_dx^2 + du_dy^2)"),
];

/// Number of the last quantities of [`POISSON`] that have names of heat.
pub const HEAT: usize = 4;

/// The weight function of a name.
#[must_use]
pub fn weight(name: &str) -> Option<&'static Entry> {
    WEIGHTS.iter().find(|entry| entry.name == name)
}

/// The enrichment of a name.
#[must_use]
pub fn enrichment(name: &str) -> Option<&'static Entry> {
    ENRICHMENTS.iter().find(|entry| entry.name == name)
}
