//! A run in MRPs and the same run in Euler parameters: one motion, two parameterisations.
//!
//! Run with `--nocapture` to see the figures.

use nalgebra::Vector3;
use precess_dynamics::{Angle, Attitude, Mrp, Quaternion, Real, Scalar, Spacecraft, State};
use precess_tests::blocks::largest;
use precess_tests::bounds::ORDER;
use precess_tests::case::Set;
use precess_tests::double_double::DoubleDouble as Wide;
use precess_tests::table1::{self, Drive, Imbalance};

/// Steps of the coarsest run, over one second.
const COARSEST: u32 = 128;

/// 170 degrees about the x axis: the body passes the half turn, where the MRPs switch to their
/// shadow set, early in the second.
fn start() -> Quaternion<Wide> {
    let half_angle = Wide::from_f64(85.0_f64.to_radians());
    let (sine, cosine) = half_angle.sin_cos();
    let zero = Wide::from_f64(0.0);
    Quaternion { q0: cosine, q1: sine, q2: zero, q3: zero }
}

/// One second of Table 1 with its catalogue wheel in double-double, from a given attitude; the body
/// turns at about 1 rad/s, so that the attitude is what the step has to resolve.
fn run<A: Attitude<Wide>>(attitude: A, steps: u32) -> State<Set<1, Wide>, A> {
    let case = table1::scenario(Imbalance::Catalogue, Drive::Wheel250).converted::<Wide>();
    let spacecraft = Spacecraft::new(&case.hub, &case.devices).expect("valid parameters");
    let State { r_b_n, r_b_n_dot, devices, .. } = case.state;
    let omega = Vector3::new(1.0, 0.5, -0.25).map(Wide::from_f64);
    let dt = Wide::from_f64(f64::from(steps)).recip();
    (0..steps).fold(State { r_b_n, r_b_n_dot, attitude, omega, devices, modal: () }, |state, _| {
        spacecraft.step(&state, &case.inputs, dt).expect("finite state")
    })
}

/// Largest difference of attitude (elements of `[BN]`) and of position (m) between the two.
fn difference(mrp: &State<Set<1, Wide>, Mrp<Wide>>, quaternion: &State<Set<1, Wide>>) -> [f64; 2] {
    let (a, b) = (mrp.attitude.dcm(), quaternion.attitude.dcm());
    let attitude = a.iter().zip(b.iter()).map(|(a, b)| (*a - *b).abs().to_f64());
    let position = mrp.r_b_n.iter().zip(quaternion.r_b_n.iter());
    let position = position.map(|(a, b)| (*a - *b).abs().to_f64());
    [largest(attitude), largest(position)]
}

#[test]
fn runs_in_mrps_and_in_euler_parameters_are_one_motion() {
    let mut coarser: Option<[f64; 2]> = None;
    for steps in [COARSEST, 2 * COARSEST, 4 * COARSEST] {
        let mrp = run(Mrp::from(start()), steps);
        let quaternion = run(start(), steps);
        assert!(mrp.attitude.0.x < Wide::from_f64(0.0), "the MRPs did not switch: {mrp:?}");

        // The attitude does not act back on what moves along B axes: not one bit differs.
        assert_eq!(mrp.omega, quaternion.omega);
        assert_eq!(mrp.devices, quaternion.devices);

        let finer = difference(&mrp, &quaternion);
        if let Some(coarser) = coarser {
            for ((coarse, fine), what) in coarser.iter().zip(finer).zip(["[BN]", "r_b_n"]) {
                let ratio = coarse / fine;
                println!("{what}: {coarse:.2e} -> {fine:.2e}, {ratio:.2}-fold");
                assert!(
                    ORDER.contains(&ratio),
                    "{what}: {coarse:e} falls {ratio}-fold to {fine:e}"
                );
            }
        }
        coarser = Some(finer);
    }
}
