//! Table 1 of the paper as printed, by the names of the pages: parameters, initial state, torques.
//!
//! The row `d` (8 mm) and the row `J_13` (15.4 g m^2) as printed, `u_x` read as 200 mN m. What
//! the table does not give (`L^o`, `L^i`, the gimbals' centres of mass, F, `L_B`) is zero, and so are
//! the gimbals' initial angles and rates, whose rows the scan garbles. The suites hold these numbers
//! against their own and the tool's.

use std::f64::consts::PI;

/// Every parameter and its number in SI units.
pub const PARAMETERS: [(&str, f64); 50] = [
    ("m_b", 810.0),
    ("m_go", 24.0),
    ("m_gi", 24.0),
    ("m_w", 4.0),
    ("m_v", 28.0),
    ("m_d", 52.0),
    ("m_sc", 862.0),
    ("r_bc_b_bx", -0.0002),
    ("r_bc_b_by", 0.0001),
    ("r_bc_b_bz", 0.1),
    ("i_b_11", 900.0),
    ("i_b_12", 4.15),
    ("i_b_13", 2.93),
    ("i_b_22", 800.0),
    ("i_b_23", 2.75),
    ("i_b_33", 600.0),
    ("r_go_b_bx", 0.3),
    ("r_go_b_by", 0.0),
    ("r_go_b_bz", 0.0),
    ("r_goc_go_gox", 0.0),
    ("r_goc_go_goy", 0.0),
    ("r_goc_go_goz", 0.0),
    ("i_go_11", 9.0),
    ("i_go_12", 0.81),
    ("i_go_13", 0.24),
    ("i_go_22", 11.0),
    ("i_go_23", 0.93),
    ("i_go_33", 5.0),
    ("l_o_x", 0.0),
    ("l_o_y", 0.0),
    ("l_o_z", 0.0),
    ("r_gic_gi_gix", 0.0),
    ("r_gic_gi_giy", 0.0),
    ("r_gic_gi_giz", 0.0),
    ("i_gi_11", 9.0),
    ("i_gi_12", 0.81),
    ("i_gi_13", 0.24),
    ("i_gi_22", 11.0),
    ("i_gi_23", 0.93),
    ("i_gi_33", 5.0),
    ("l_i_x", 0.0),
    ("l_i_y", 0.0),
    ("l_i_z", 0.0),
    ("d", 8.0e-3),
    ("j_11", 0.2),
    ("j_12", 0.0),
    ("j_13", 15.4e-3),
    ("j_22", 0.1),
    ("j_23", 0.0),
    ("j_33", 0.1),
];

/// Body rate along B at the start, rad/s: (4.85, 0.57, 0) deg/s.
pub const OMEGA: [f64; 3] = [4.85 * PI / 180.0, 0.57 * PI / 180.0, 0.0];

/// Rates of the outer gimbal, the inner gimbal and the wheel at the start, rad/s: 500 rpm.
pub const RATES: [f64; 3] = [0.0, 0.0, 500.0 * PI / 30.0];

/// Torques of the motors of the outer gimbal, the inner gimbal and the wheel, N m.
pub const TORQUES: [f64; 3] = [0.1, 0.1, 0.2];

/// The number of a parameter.
#[must_use]
pub fn parameter(name: &str) -> Option<f64> {
    PARAMETERS.iter().find(|(known, _)| *known == name).map(|(_, value)| *value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masses_of_assemblies_are_sums() {
        let [b, go, gi, w, v, d, sc] = ["m_b", "m_go", "m_gi", "m_w", "m_v", "m_d", "m_sc"]
            .map(|name| parameter(name).unwrap());
        assert_eq!([v, d, sc], [gi + w, go + gi + w, b + go + gi + w]);
    }
}
