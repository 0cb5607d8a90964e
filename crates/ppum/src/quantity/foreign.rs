//! Names that other programs give to quantities, for messages about unknown names.

/// Names of Abaqus, Ansys, Code_Aster, NGSolve and formulas in letters, in lower case, with ours.
const FOREIGN: [(&[&str], &str); 26] = [
    (&["mises", "vonmises", "von_mises_stress", "s_mises", "seqv", "vmis"], "von-mises"),
    (&["s11", "sx", "sixx", "sigma_xx", "sigmaxx", "sig_xx", "stress_xx", "stressxx"], "sxx"),
    (&["s22", "sy", "siyy", "sigma_yy", "sigmayy", "sig_yy", "stress_yy", "stressyy"], "syy"),
    (&["s12", "sixy", "sigma_xy", "sigmaxy", "sig_xy", "stress_xy", "tau_xy", "tauxy"], "sxy"),
    (&["s33", "sz", "sizz", "sigma_zz", "sigmazz", "sig_zz", "stress_zz"], "szz"),
    (&["e11", "le11", "epxx", "epsilon_xx", "eps_xx", "strain_xx"], "exx"),
    (&["e22", "le22", "epyy", "epsilon_yy", "eps_yy", "strain_yy"], "eyy"),
    (&["epxy", "epsilon_xy", "eps_xy", "strain_xy"], "exy"),
    (&["u1", "dx", "disp_x", "displacement_x", "u_x"], "ux"),
    (&["u2", "dy", "disp_y", "displacement_y", "u_y"], "uy"),
    (&["displacement", "disp", "usum", "u_mag", "norm_u"], "magnitude"),
    (&["sigma_1", "sigma1", "max_principal", "s_max", "smax", "sp1"], "s1"),
    (&["sigma_2", "sigma2", "min_principal", "s_min", "smin"], "s2"),
    (&["sint", "tresca_stress"], "tresca"),
    (&["mean_stress", "sigma_m"], "hydrostatic"),
    (&["sener", "eners", "strain_energy", "energy_density"], "energy"),
    (&["temp", "nt11"], "temperature"),
    (&["grad", "gradu", "grad_u"], "gradient"),
    (&["hfl1", "flux_x", "heat_flux_x", "fluxx"], "qx"),
    (&["hfl2", "flux_y", "heat_flux_y", "fluxy"], "qy"),
    (&["hfl", "heat_flux", "heatflux", "q"], "flux"),
    (
        &["sn", "sigma_n", "sigman", "cpress", "contact_pressure", "pressure", "traction"],
        "normal-traction",
    ),
    (&["tau", "sigma_t", "cshear1"], "shear-traction"),
    (&["gap", "copen", "jeu", "cod"], "opening"),
    (&["slip", "cslip1"], "sliding"),
    (&["contact", "cstatus", "status"], "closed"),
];

/// Returns our name of a quantity that another program calls `name`.
pub(super) fn own_name(name: &str) -> Option<&'static str> {
    let name = name.to_lowercase().replace('-', "_");
    FOREIGN.iter().find(|(names, _)| names.contains(&&*name)).map(|&(_, own)| own)
}
