//! Table 1 of the paper: a rigid hub with one DGVSCMG.
//!
//! What the table leaves out (`L^o`, `L^i`, gimbal offsets, mount, `F`, `L_B`, initial gimbal
//! state) is zero or identity. It contradicts itself twice, so it is run in variants. `U_s/m_w` =
//! 32 g cm / 4 kg is 0.08 mm but the row `d` says 8.0 mm, and `U_d` = 15.4 g m^2 is ten thousand
//! times a catalogue wheel's 15.4 g cm^2: see [`Imbalance`]. The row `u_x` reads 200 or 250 mN m:
//! see [`Drive`]. The solver takes both wheels with a warning that the triangle inequality is
//! broken: their moments 0.2, 0.1, 0.1 kg m^2 are the limit of a thin disc, so any J13 breaks it,
//! by 4.6e-3 kg m^2 as printed and by 4.7e-11 kg m^2 for the catalogue wheel.

use clap::ValueEnum;
use nalgebra::{Matrix3, Vector3};
use precess_dynamics::dgvscmg::{Joints, MotorTorques, PerJoint};
use precess_dynamics::units::{from_cm, from_g_cm, from_g_cm2, from_mm, from_mn_m, from_rpm};
use precess_dynamics::{Dgvscmg, Hub, ImbalanceModel, Inputs, Passive, Quaternion, State};

use super::Scenario;

/// The wheel's static and dynamic imbalance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Imbalance {
    /// As printed: d = 8 mm, J13 = 0.0154 kg m^2.
    Printed,
    /// A catalogue wheel: d = 0.08 mm, J13 = 1.54e-6 kg m^2.
    Catalogue,
}

/// The motor torques.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Drive {
    /// Torque-free: every motor off.
    Free,
    /// `u_x` = 200 mN m on the wheel, `u_y` = `u_z` = 100 mN m on the gimbals.
    #[value(
        name = "200",
        help = "u_x = 200 mN m on the wheel, u_y = u_z = 100 mN m on the gimbals"
    )]
    Wheel200,
    /// `u_x` = 250 mN m on the wheel, `u_y` = `u_z` = 100 mN m on the gimbals.
    #[value(
        name = "250",
        help = "u_x = 250 mN m on the wheel, u_y = u_z = 100 mN m on the gimbals"
    )]
    Wheel250,
}

/// One reading of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Variant {
    /// The wheel.
    pub imbalance: Imbalance,
    /// The motors.
    pub drive: Drive,
}

/// All variants, or those with this wheel or these motors.
#[must_use]
pub fn variants(imbalance: Option<Imbalance>, drive: Option<Drive>) -> Vec<Variant> {
    let mut variants = Vec::new();
    for &i in Imbalance::value_variants() {
        for &d in Drive::value_variants() {
            if imbalance.is_none_or(|chosen| chosen == i) && drive.is_none_or(|chosen| chosen == d)
            {
                variants.push(Variant { imbalance: i, drive: d });
            }
        }
    }
    variants
}

impl Imbalance {
    /// Offset of the wheel's centre of mass, m, and its product of inertia J13, kg m^2.
    #[must_use]
    pub fn d_and_j_13(self) -> (f64, f64) {
        match self {
            Self::Printed => (from_mm(8.0), 0.0154),
            Self::Catalogue => (from_g_cm(32.0) / M_W, from_g_cm2(15.4)),
        }
    }

    /// A few words for a heading.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Printed => "Wheel as printed",
            Self::Catalogue => "Catalogue wheel",
        }
    }
}

impl Drive {
    /// The torques of the three motors, N m.
    #[must_use]
    pub fn motors(self) -> MotorTorques {
        let on = |u_w| MotorTorques { u_o: from_mn_m(100.0), u_i: from_mn_m(100.0), u_w };
        match self {
            Self::Free => MotorTorques { u_o: 0.0, u_i: 0.0, u_w: 0.0 },
            Self::Wheel200 => on(from_mn_m(200.0)),
            Self::Wheel250 => on(from_mn_m(250.0)),
        }
    }

    /// A few words for a heading.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Free => "torque-free",
            Self::Wheel200 => "wheel torque 200\u{a0}mN\u{a0}m",
            Self::Wheel250 => "wheel torque 250\u{a0}mN\u{a0}m",
        }
    }
}

const M_W: f64 = 4.0;

impl Variant {
    /// `table1-printed-free` and so on.
    #[must_use]
    pub fn name(self) -> String {
        let word = |v: Option<clap::builder::PossibleValue>| {
            v.map(|v| v.get_name().to_owned()).unwrap_or_default()
        };
        format!(
            "table1-{}-{}",
            word(self.imbalance.to_possible_value()),
            word(self.drive.to_possible_value())
        )
    }

    /// The scenario of this variant.
    #[must_use]
    pub fn scenario(self) -> Scenario<1> {
        let (d, j_13) = self.imbalance.d_and_j_13();
        let zero = Vector3::zeros();
        let gimbal = symmetric([9.0, 11.0, 5.0], [0.81, 0.24, 0.93]);
        Scenario {
            name: self.name(),
            title: format!("{}, {}", self.imbalance.words(), self.drive.words()),
            hub: Hub {
                m_b: 810.0,
                r_bc_b: Vector3::new(from_cm(-0.02), from_cm(0.01), from_cm(10.0)),
                i_b_bc: symmetric([900.0, 800.0, 600.0], [4.15, 2.93, 2.75]),
            },
            devices: [Dgvscmg {
                mount: Matrix3::identity(),
                r_go_b: Vector3::new(from_cm(30.0), 0.0, 0.0),
                m_go: 24.0,
                r_goc_go: zero,
                i_go_goc: gimbal,
                l_o: zero,
                m_gi: 24.0,
                r_gic_gi: zero,
                i_gi_gic: gimbal,
                l_i: zero,
                m_w: M_W,
                d,
                i_w_wc: symmetric([0.2, 0.1, 0.1], [0.0, j_13, 0.0]),
                passive: PerJoint::all(Passive::none()),
                model: ImbalanceModel::Coupled,
            }],
            state: State {
                r_b_n: zero,
                r_b_n_dot: zero,
                attitude: Quaternion { q0: 1.0, q1: 0.0, q2: 0.0, q3: 0.0 },
                omega: Vector3::new(4.85_f64.to_radians(), 0.57_f64.to_radians(), 0.0),
                devices: [Joints {
                    gamma_o: 0.0,
                    gamma_i: 0.0,
                    theta: 0.0,
                    gamma_o_dot: 0.0,
                    gamma_i_dot: 0.0,
                    spin: from_rpm(500.0),
                }],
            },
            inputs: Inputs { motors: [self.drive.motors()], ..Inputs::none() },
        }
    }
}

/// Diagonal 11, 22, 33 and the elements 12, 13, 23.
fn symmetric(diagonal: [f64; 3], [i_12, i_13, i_23]: [f64; 3]) -> Matrix3<f64> {
    let [i_11, i_22, i_33] = diagonal;
    Matrix3::new(i_11, i_12, i_13, i_12, i_22, i_23, i_13, i_23, i_33)
}

#[cfg(test)]
mod tests {
    use precess_dynamics::{Part, Spacecraft, Warning};

    use super::*;

    /// Decimal units against powers of ten: a rounding or two of 2e-16.
    const ROUNDING: f64 = 1e-15;

    #[test]
    fn the_catalogue_wheel_is_a_hundredth_and_a_ten_thousandth_of_the_printed_one() {
        let (d, j_13) = Imbalance::Printed.d_and_j_13();
        let (d_c, j_13_c) = Imbalance::Catalogue.d_and_j_13();
        assert!((d / d_c / 100.0 - 1.0).abs() < ROUNDING);
        assert!((j_13 / j_13_c / 10_000.0 - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn both_wheels_are_beyond_a_thin_disc_by_what_the_module_says() {
        for (imbalance, expected) in [(Imbalance::Printed, 4.6e-3), (Imbalance::Catalogue, 4.7e-11)]
        {
            let s = Variant { imbalance, drive: Drive::Free }.scenario();
            let spacecraft = Spacecraft::new(&s.hub, &s.devices).expect("it is accepted");
            let warnings: Vec<_> = spacecraft.warnings().collect();
            let [Warning::Triangle { part: Part::Body { device: 0, body: "wheel" }, excess }] =
                warnings[..]
            else {
                panic!("{warnings:?}");
            };
            // The module has two digits.
            assert_eq!(format!("{excess:.1e}"), format!("{expected:.1e}"));
        }
    }

    #[test]
    fn masses_add_up_to_the_row_m_sc() {
        let s = Variant { imbalance: Imbalance::Printed, drive: Drive::Free }.scenario();
        let [v] = s.devices;
        assert_eq!(s.hub.m_b + v.m_go + v.m_gi + v.m_w, 862.0);
    }

    #[test]
    fn a_question_narrows_the_variants() {
        assert_eq!(variants(None, None).len(), 6);
        assert_eq!(variants(Some(Imbalance::Printed), None).len(), 3);
        let one = variants(Some(Imbalance::Catalogue), Some(Drive::Wheel250));
        assert_eq!(one.iter().map(|v| v.name()).collect::<Vec<_>>(), ["table1-catalogue-250"]);
    }
}
