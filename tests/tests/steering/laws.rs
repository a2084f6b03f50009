//! Laws on random spacecraft: torque to rounding, null motion, weights, bounds, and what they refuse.

use nalgebra::Vector3;
use precess_dynamics::{
    Inverse, Steered, SteeringError, SteeringLaw, SteeringMatrix, SteeringTerms, steering_weights,
};
use precess_tests::random::{Random, SEED, Sample};

const STEERED: [Steered; 12] = {
    let (rate, acceleration) = (Steered::Rate, Steered::Acceleration);
    [
        rate,
        rate,
        acceleration,
        rate,
        rate,
        acceleration,
        rate,
        rate,
        acceleration,
        rate,
        rate,
        acceleration,
    ]
};

/// Steering matrices of four DGVSCMGs with a torque each.
fn each(mut check: impl FnMut(&SteeringMatrix<f64, 12>, Vector3<f64>, &mut Random)) {
    for seed in SEED..SEED + precess_tests::cases(200) {
        let sample = Sample::<4>::new(seed);
        let case = sample.case::<f64>();
        let craft = case.spacecraft(sample);
        let terms: SteeringTerms<f64, 12> = craft.steering_terms(&case.state).unwrap();
        let mut random = Random::new(seed);
        let torque = random.vector(1.0);
        check(&terms.matrix(&STEERED), torque, &mut random);
    }
}

#[test]
fn the_exact_inverse_gives_the_torque_to_rounding() {
    let mut worst = 0.0_f64;
    each(|matrix, torque, _| {
        let found = SteeringLaw::exact().allocate(matrix, &torque).unwrap();
        let demanded = (torque + matrix.drift).norm();
        let error = (matrix.torque(&found.commands) - torque).norm();
        assert!(error.is_finite() && found.torque_error.norm() < 1e-12 * demanded);
        worst = worst.max(error / demanded);
    });
    assert!(worst < 1e-12, "{worst:e} of the demanded moment");
}

/// The exact inverse is the one of least norm: any null motion makes it larger.
#[test]
fn null_motion_gives_no_torque_and_is_across_the_least_commands() {
    each(|matrix, torque, random| {
        let law = SteeringLaw::exact();
        let least = law.allocate(matrix, &torque).unwrap().commands;
        let preferred = core::array::from_fn(|_| random.within(-1.0, 1.0));
        let null = law.null_motion(matrix, &preferred).unwrap();
        let size: f64 = matrix.columns.iter().zip(null).map(|(q, x)| q.norm() * x.abs()).sum();
        assert!(matrix.times(&null).norm() < 1e-13 * size);
        let dot: f64 = least.iter().zip(null).map(|(a, b)| a * b).sum();
        let norms = [least, null].map(|list| list.iter().map(|x| x * x).sum::<f64>().sqrt());
        assert!(dot.abs() < 1e-9 * norms[0] * norms[1], "{dot:e}");
        assert!(norms[1] > 1e-3);
    });
}

#[test]
fn a_weight_of_zero_commands_nothing_and_wheels_fade_far_from_singular() {
    let weights = steering_weights(&STEERED, [1.0, 2.0], 3.0, 0.5);
    let wheel = 2.0 * (-1.5_f64).exp();
    assert_eq!(&weights[..3], &[1.0, 1.0, wheel]);
    assert_eq!(steering_weights(&[Steered::Nothing; 1], [1.0, 2.0], 3.0, 0.5), [0.0]);
    each(|matrix, torque, _| {
        let mut law = SteeringLaw { weights, ..SteeringLaw::exact() };
        law.weights[4] = 0.0;
        let found = law.allocate(matrix, &torque).unwrap();
        assert_eq!(found.commands[4].abs(), 0.0);
        let demanded = (torque + matrix.drift).norm();
        assert!((matrix.torque(&found.commands) - torque).norm() < 1e-11 * demanded);
    });
}

#[test]
fn commands_stay_within_their_bounds_and_what_is_lacking_is_said() {
    let (mut met, mut lacking) = (0, 0);
    each(|matrix, torque, _| {
        let law = SteeringLaw::exact();
        let free = law.allocate(matrix, &torque).unwrap();
        let largest = free.commands.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for share in [2.0, 0.7, 0.05] {
            let bounds = [[-share * largest, share * largest]; 12];
            let found = law.allocate_within(matrix, &torque, &bounds).unwrap();
            for (command, [lower, upper]) in found.commands.iter().zip(bounds) {
                assert!((lower..=upper).contains(command), "{command} in {lower} to {upper}");
            }
            let demanded = (torque + matrix.drift).norm();
            let error = matrix.torque(&found.commands) - torque;
            assert!((error - found.torque_error).norm() < 1e-12 * demanded);
            if share > 1.0 {
                assert_eq!((found.commands, found.bounded), (free.commands, 0));
            } else {
                assert!(found.bounded > 0);
                let exact = found.torque_error.norm() < 1e-11 * demanded;
                *(if exact { &mut met } else { &mut lacking }) += 1;
            }
        }
    });
    assert!(met > 0 && lacking > 0, "{met} met, {lacking} lacking");
}

#[test]
fn robust_inverses_are_exact_far_from_singular_and_bounded_near_it() {
    each(|matrix, torque, _| {
        let reference = 1e-3 * matrix.columns.iter().map(Vector3::norm).fold(0.0, f64::max);
        let robust = |lambda| SteeringLaw {
            inverse: Inverse::SingularityRobust { lambda, mu: 0.0 },
            reference,
            ..SteeringLaw::exact()
        };
        let exact = SteeringLaw::exact().allocate(matrix, &torque).unwrap();
        let norm = |list: [f64; 12]| list.iter().map(|x| x * x).sum::<f64>().sqrt();
        let mut before = norm(exact.commands) * (1.0 + 1e-9);
        for lambda in [1e-9, 1e-3, 1.0, 1e3] {
            let found = robust(lambda).allocate(matrix, &torque).unwrap();
            assert!(norm(found.commands) <= before, "lambda {lambda}");
            before = norm(found.commands);
        }
    });
}

#[test]
fn what_cannot_be_meant_is_refused_by_name() {
    let sample = Sample::<4>::new(SEED);
    let case = sample.case::<f64>();
    let craft = case.spacecraft(sample);
    let terms: SteeringTerms<f64, 12> = craft.steering_terms(&case.state).unwrap();
    let matrix = terms.matrix(&STEERED);
    let (torque, law) = (Vector3::x(), SteeringLaw::exact());
    let refused = |law: SteeringLaw<f64, 12>| law.allocate(&matrix, &torque).unwrap_err();
    let mut negative = law;
    negative.weights[2] = -1.0;
    let argument = |what, index, value| SteeringError::Argument { what, index, value };
    assert_eq!(refused(negative), argument("weight", 2, -1.0));
    let none = SteeringLaw { reference: 0.0, ..law };
    assert_eq!(refused(none), argument("reference momentum", 0, 0.0));
    let endless = Inverse::SingularityRobust { lambda: f64::INFINITY, mu: 1.0 };
    let endless = SteeringLaw { inverse: endless, ..law };
    assert_eq!(refused(endless), argument("parameter of the inverse", 0, f64::INFINITY));
    let mut bounds = [[-1.0, 1.0]; 12];
    bounds[3] = [1.0, -1.0];
    let wrong = law.allocate_within(&matrix, &torque, &bounds).unwrap_err();
    assert_eq!(wrong, argument("bound", 3, -1.0));
    assert_eq!(
        wrong.to_string(),
        "bound 3 is -1.0; it must be finite, a weight not below zero, a bound in order"
    );
    let torque = Vector3::new(0.0, f64::NAN, 0.0);
    assert!(matches!(
        law.allocate(&matrix, &torque),
        Err(SteeringError::Argument { what: "torque component", index: 1, .. })
    ));
    let overflow = law.allocate(&matrix, &Vector3::new(f64::MAX, f64::MAX, f64::MAX)).unwrap_err();
    assert_eq!(overflow, SteeringError::Overflow);
    let nothing = terms.matrix(&[Steered::Nothing; 12]);
    let singular = law.allocate(&nothing, &Vector3::x()).unwrap_err();
    assert!(matches!(singular, SteeringError::Singular { .. }), "{singular:?}");
}
