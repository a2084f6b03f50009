//! Trials: the same wheel measured many times with noise and phases of its own, and how often each 95 %
//! interval has the number that was put in.

use precess::fit::{Estimate, Fitted, Group, Sense, fit, fit_waterfall};

use super::scene::{ANGLE, PHASE, SEED, U_D, U_S, Variant, measured, stated, wheel};
use super::synthetic::{Random, Wheel};
use super::waterfalls::{Averaging, options, rows, wheel_of_spectra};

/// A parameter: its name, what was put in, what was found.
pub(crate) type Compared = (String, f64, Estimate);

/// Every parameter that was put in.
pub(crate) fn compared(wheel: &Wheel, fitted: &Fitted) -> Vec<Compared> {
    let imbalance = &fitted.imbalance;
    let mut all =
        vec![("U_s".to_owned(), U_S, imbalance.u_s), ("U_d".to_owned(), U_D, imbalance.u_d)];
    all.extend(imbalance.phase.map(|phase| ("phase of U_d".to_owned(), PHASE, phase)));
    all.extend(imbalance.angle.map(|angle| ("angle of U_s".to_owned(), ANGLE, angle)));
    for (harmonic, source) in fitted.harmonics.iter().zip(&wheel.sources).skip(1) {
        let h = source.h;
        all.push((format!("h = {h}"), h, harmonic.number));
        for c in &harmonic.coefficients {
            let (put_in, word) = match (c.group, c.sense) {
                (Group::AxialForce, _) => (source.fx, ""),
                (Group::AxialTorque, _) => (source.tx, ""),
                (Group::RadialForce, Sense::Forward) => (source.f_forward, ", forward"),
                (Group::RadialForce, Sense::Backward) => (source.f_backward, ", backward"),
                (Group::RadialTorque, Sense::Forward) => (source.t_forward, ", forward"),
                (Group::RadialTorque, Sense::Backward) => (source.t_backward, ", backward"),
            };
            // A coefficient that is zero is at the end of its interval.
            if put_in == 0.0 {
                continue;
            }
            all.push((format!("C of {h}, {}{word}", c.group), put_in, c.c));
            let lead = if c.group.is_torque() { source.lead } else { 0.0 };
            if let (Some(phase), true, Sense::Forward) = (c.phase, c.group.is_radial(), c.sense) {
                all.push((format!("phase of {h}, {}", c.group), source.phase + lead, phase));
            }
        }
    }
    for mode in &fitted.modes {
        let bearing = if mode.group.is_torque() { &wheel.tilting } else { &wheel.radial };
        let w = (bearing.stiffness / bearing.inertia).sqrt();
        let damping = bearing.damping / (2.0 * bearing.inertia * w);
        all.push((format!("frequency, {}", mode.group), w, mode.frequency));
        all.push((format!("damping, {}", mode.group), damping, mode.damping));
        if mode.group.is_torque() {
            let ratio = bearing.spin / bearing.inertia;
            all.push(("I_s / I_r".to_owned(), ratio, mode.inertia_ratio));
        }
    }
    all
}

/// Trials of [`SEED`], each with a seed drawn from it, on two threads.
pub(crate) fn trials(count: usize, variant: Variant) -> Vec<Vec<Compared>> {
    let wheel = wheel();
    each_seed(count, &|random| {
        let measurement = measured(&wheel, variant, random);
        compared(&wheel, &fit(&measurement, &stated(variant)).expect("it fits"))
    })
}

/// Trials of waterfalls.
pub(crate) fn spectra_trials(count: usize, averaging: Averaging) -> Vec<Vec<Compared>> {
    let wheel = wheel_of_spectra(averaging);
    let options = options(&wheel, true);
    each_seed(count, &|random| {
        let rows = rows(&wheel, averaging, random);
        compared(&wheel, &fit_waterfall(&rows, &options).expect("it fits"))
    })
}

fn each_seed(
    count: usize,
    trial: &(dyn Fn(&mut Random) -> Vec<Compared> + Sync),
) -> Vec<Vec<Compared>> {
    let mut random = Random::new(SEED);
    let seeds: Vec<u64> = (0..count).map(|_| random.bits()).collect();
    let run = |seeds: &[u64]| -> Vec<Vec<Compared>> {
        seeds.iter().map(|seed| trial(&mut Random::new(*seed))).collect()
    };
    let (first, second) = seeds.split_at(count / 2);
    std::thread::scope(|scope| {
        let first = scope.spawn(|| run(first));
        let second = run(second);
        let mut all = first.join().expect("trials");
        all.extend(second);
        all
    })
}

/// Of each parameter its name, and the share of trials whose interval has it.
pub(crate) fn coverage(trials: &[Vec<Compared>]) -> Vec<(String, f64)> {
    let Some(first) = trials.first() else { return Vec::new() };
    (0..first.len())
        .map(|k| {
            let inside = trials.iter().filter(|all| {
                let (_, put_in, found) = &all[k];
                found.contains(*put_in)
            });
            (first[k].0.clone(), inside.count() as f64 / trials.len() as f64)
        })
        .collect()
}
