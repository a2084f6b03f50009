//! Runs of scenario files against closed forms, and against cases that NASA published.
//!
//! What limits the agreement. The integrator keeps the root mean square, over the numbers of the
//! state, of each step's estimated error within `tolerance * (|number| + floor)`, here with a
//! tolerance of 1e-13; the floor is 1 for attitudes and angles, 0.01 for lengths, speeds and rates.
//! The estimate is that of a lower order than the method's, so a step's own error is less. Errors
//! of steps add up, and one of a rate grows with the time into one of an angle. Where the closed
//! form is a polynomial of low degree, what is left is rounding. Each bound says which of these it
//! is, and what has been measured; it is above that by less than ten times.

use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::ControlFlow;
use std::path::Path;

use precess::engine::run;
use precess::file::from_file;
use precess::record::{End, Outcome, Samples};
use precess::scenario::Scenario;

#[path = "known_answers/published/mod.rs"]
mod published;

/// A scenario and its run.
struct ScenarioRun {
    scenario: Scenario,
    samples: Samples,
    outcome: Outcome,
}

impl ScenarioRun {
    /// Runs a file of `scenarios` to its duration.
    fn from_file(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
        let read = from_file(&folder.join(name), &[]);
        let (scenario, _) = read.unwrap_or_else(|errors| panic!("{errors}"));
        let ran = Self::of(scenario);
        assert!(ran.samples.rows.len() > 100, "{name}: {} samples", ran.samples.rows.len());
        ran
    }

    /// Runs a scenario to its duration.
    fn of(scenario: Scenario) -> Self {
        let name = scenario.name.clone();
        let mut samples = Samples::default();
        let outcome = run(&scenario, &mut samples, &mut |_| ControlFlow::Continue(()));
        let outcome = outcome.unwrap_or_else(|error| panic!("{error}"));
        assert!(matches!(outcome.end, End::Finished), "{name}: {}", outcome.end);
        Self { scenario, samples, outcome }
    }

    /// Columns by name, sample by sample; the time first.
    fn columns<const N: usize>(&self, names: [&str; N]) -> impl Iterator<Item = (f64, [f64; N])> {
        let header = self.samples.header.as_ref().expect("the run has begun");
        let indices = names.map(|name| header.index(name).unwrap_or_else(|| panic!("{name}")));
        self.samples.rows.iter().map(move |row| (row[0], indices.map(|index| row[index])))
    }

    /// The largest magnitude of a difference over all samples.
    fn worst<const N: usize>(
        &self,
        names: [&str; N],
        mut difference: impl FnMut(f64, [f64; N]) -> f64,
    ) -> f64 {
        // `f64::max` ignores a NaN, which must not pass.
        let larger = |a: f64, b: f64| if b.is_nan() || b > a { b } else { a };
        self.columns(names).fold(0.0, |most, (time, row)| larger(most, difference(time, row).abs()))
    }
}

/// Passes where a difference is within a bound; says both where it is not.
fn within(what: &str, difference: f64, bound: f64) {
    println!("{what}: {difference:.1e}, bound {bound:.1e}");
    assert!(difference <= bound, "{what}: {difference:e} is above {bound:e}");
}

/// The arithmetic-geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 4.0 * f64::EPSILON * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// Jacobi's sn, cn, dn of the modulus k, by the arithmetic-geometric mean (Abramowitz and Stegun
/// 16.4).
fn jacobi(u: f64, k: f64) -> [f64; 3] {
    let mut levels = vec![(1.0, (1.0 - k * k).sqrt(), k)];
    while let Some(&(a, b, c)) = levels.last() {
        if c <= f64::EPSILON * a {
            break;
        }
        levels.push((0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b)));
    }
    let depth = levels.len() - 1;
    let (a, ..) = levels[depth];
    let mut phi = f64::from(1_u32 << depth) * a * u;
    for &(a, _, c) in levels[1..].iter().rev() {
        phi = 0.5 * (phi + (c / a * phi.sin()).asin());
    }
    let (sn, cn) = phi.sin_cos();
    [sn, cn, (1.0 - k * k * sn * sn).sqrt()]
}

/// The angle of a pendulum `u'' = -w^2 sin u` that starts at rest: `sin(u/2) = k cd(w t)`.
fn pendulum(w: f64, start: f64, time: f64) -> f64 {
    let k = (start / 2.0).sin();
    let [_, cn, dn] = jacobi(w * time, k);
    2.0 * (k * cn / dn).asin()
}

/// An angle brought to within half a turn.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// `sn` at a quarter of the period is 1, and the functions are those of a circle for k = 0.
#[test]
fn jacobis_functions_have_their_period() {
    for k in [0.1_f64, 0.5, 0.9, 0.99] {
        let quarter = FRAC_PI_2 / agm(1.0, (1.0 - k * k).sqrt());
        let [sn, cn, dn] = jacobi(quarter, k);
        assert!((sn - 1.0).abs() < 1e-15 && cn.abs() < 1e-14, "{k}: {sn} {cn}");
        assert!((dn - (1.0 - k * k).sqrt()).abs() < 1e-14, "{k}: {dn}");
        // sn' = cn dn, by a central difference: its own error is h^2 / 6 times a derivative of
        // order 1.
        let h = 1e-5;
        let [[before, ..], [after, ..]] = [0.7 - h, 0.7 + h].map(|u| jacobi(u, k));
        let [_, cn, dn] = jacobi(0.7, k);
        assert!(((after - before) / (2.0 * h) - cn * dn).abs() < 1e-10);
    }
    let [sn, cn, dn] = jacobi(0.3, 0.0);
    assert_eq!([sn, cn, dn], [0.3_f64.sin(), 0.3_f64.cos(), 1.0]);
}

/// `T omega_y' = -(H_x - T omega_x) omega_z` and `T omega_z' = (H_x - T omega_x) omega_y`, with
/// `H_x` and `omega_x` constant: rates across the axis turn at `H_x / T - omega_x`. The attitude is
/// a turn about the angular momentum at `|H| / T`, after one about the axis at minus that rate.
#[test]
fn a_gyrostat_nutates_at_its_rate() {
    let ran = ScenarioRun::from_file("known-nutation.toml");
    let (hub, wheel) = (&ran.scenario.hub, ran.scenario.devices.0[0].parameters().bodies[0]);
    let start = &ran.scenario.initial;
    let spin = start.devices.0[0][0][1];
    let transverse = hub.i_b_bc.m22 + wheel.inertia.m22;
    let (axial, across) = (start.omega.x, start.omega.y);
    let h_x = hub.i_b_bc.m11 * axial + wheel.inertia.m11 * (axial + spin);
    let (h, rate) = (h_x.hypot(transverse * across), h_x / transverse - axial);
    let duration = ran.scenario.settings.duration;
    assert!(rate * duration > 4.0 * TAU, "more than four nutations");

    let rates = ran.worst(["omega_x", "omega_y", "omega_z"], |time, [x, y, z]| {
        let (sin, cos) = (rate * time).sin_cos();
        (x - axial).hypot(y - across * cos).hypot(z - across * sin)
    });
    within("rates, rad/s", rates, NUTATION);

    let attitude = ran.worst(["q0", "q1", "q2", "q3"], |time, q| {
        let (sin_h, cos_h) = (0.5 * h / transverse * time).sin_cos();
        let (x, y) = (sin_h * h_x / h, sin_h * transverse * across / h);
        let (sin, cos) = (-0.5 * rate * time).sin_cos();
        // (cos_h, x, y, 0) times (cos, sin, 0, 0).
        let known = [cos_h * cos - x * sin, cos_h * sin + x * cos, y * cos, -y * sin];
        let sign = f64::copysign(1.0, q.iter().zip(known).map(|(a, b)| a * b).sum::<f64>());
        q.iter().zip(known).map(|(a, b)| (a - sign * b).powi(2)).sum::<f64>().sqrt()
    });
    within("attitude", attitude, NUTATION);
}

/// Twice the tolerance: the rates turn, so that errors of steps do not grow with the time.
/// Measured: 2.4e-14 rad/s, and 3.8e-14 of the quaternion.
const NUTATION: f64 = 2e-13;

/// The hub's centre of mass, B and the wheel's origin coincide, and the wheel has no products of
/// inertia. With the hub at rest in attitude the wheel exerts on it a force through its centre of
/// mass and no moment, so it stays so. Both masses keep their common centre at the origin of N:
/// `(m_B + m_W) r_B = -m_W d w_y`, with `w_y` at the wheel's angle, which grows evenly.
#[test]
fn a_hub_circles_with_an_imbalanced_wheel() {
    let ran = ScenarioRun::from_file("known-imbalanced-wheel.toml");
    let wheel = ran.scenario.devices.0[0].parameters().bodies[0];
    let spin = ran.scenario.initial.devices.0[0][0][1];
    let radius = wheel.mass * wheel.centre[1] / (ran.scenario.hub.m_b + wheel.mass);
    let duration = ran.scenario.settings.duration;
    assert!((radius - 3.2e-6).abs() < 1e-20 && spin * duration > 190.0 * TAU);

    let turning = ran.worst(["omega_x", "omega_y", "omega_z"], |_, [x, y, z]| x.hypot(y).hypot(z));
    within("hub's rate, rad/s", turning, AT_REST);
    let spinning = ran.worst(["wheel.spin"], |_, [rate]| rate / spin - 1.0);
    within("wheel's rate, relative", spinning, 0.0);
    let circle = ran.worst(["position_x", "position_y", "position_z"], |time, [x, y, z]| {
        let (sin, cos) = (spin * time).sin_cos();
        x.hypot(y + radius * cos).hypot(z + radius * sin)
    });
    within("circle, m", circle, CIRCLE);
}

/// Rounding of a moment that vanishes, rad/s. Measured: 1.6e-22; the wheel keeps its rate to the
/// bit.
const AT_REST: f64 = 1e-21;
/// The integrator's floor for a length, 1e-13 times 0.01 m: 3e-10 of the radius, m. Measured:
/// 1.7e-16.
const CIRCLE: f64 = 1e-15;

/// `I_z theta'' = -3/2 n^2 (I_y - I_x) sin(2 theta)` in the plane of a circular orbit, with the
/// second moments of the body only, as in the solver's field; what couples the orbit to the
/// attitude is `I / (m R^2)` = 3e-15 of it.
#[test]
fn a_body_librates_by_the_gravity_gradient() {
    let ran = ScenarioRun::from_file("known-libration.toml");
    let (inertia, start) = (&ran.scenario.hub.i_b_bc, &ran.scenario.initial);
    let n = start.omega.z;
    let w = n * (3.0 * (inertia.m22 - inertia.m11) / inertia.m33).sqrt();
    let angle = 2.0 * start.attitude.q3.atan2(start.attitude.q0);
    let duration = ran.scenario.settings.duration;
    let period = TAU / (w * agm(1.0, angle.cos()));
    assert!(duration > 3.0 * period, "more than three librations of {period} s");

    let names = ["position_x", "position_y", "q0", "q3"];
    let difference = ran.worst(names, |time, [x, y, q0, q3]| {
        let found = wrapped(2.0 * q3.atan2(q0) - y.atan2(x));
        found - 0.5 * pendulum(w, 2.0 * angle, time)
    });
    within("libration, rad", difference, LIBRATION);
    let plane = ran.worst(["position_z", "q1", "q2"], |_, [z, q1, q2]| z.hypot(q1).hypot(q2));
    within("out of the plane", plane, 0.0);
}

/// The phase of the orbit, with errors of 1e-13 of radius and speed in each step that grow with the
/// time, rad. Measured: 9.4e-13.
const LIBRATION: f64 = 5e-12;

/// `I_h phi'' = -m g L sin(phi)`: `I_h` about the hinge. The period is `2 pi / (w agm(1, cos(phi_0
/// / 2)))`; the bottom is passed at odd quarters of it.
#[test]
fn a_panel_swings_as_a_pendulum() {
    let ran = ScenarioRun::from_file("known-panel-pendulum.toml");
    let panel = ran.scenario.devices.0[0].parameters().bodies[0];
    let precess_dynamics::Gravity::Uniform(g) = ran.scenario.gravity else { panic!("no gravity") };
    let [start, _] = ran.scenario.initial.devices.0[0][0];
    let arm = panel.centre[0];
    let w = (panel.mass * g.x * arm / (panel.inertia.m33 + panel.mass * arm * arm)).sqrt();
    let period = TAU / (w * agm(1.0, (start / 2.0).cos()));
    let duration = ran.scenario.settings.duration;
    assert!(duration > 6.0 * period, "more than six swings of {period} s");

    let names = ["panel.phi"];
    let difference = ran.worst(names, |time, [phi]| phi - pendulum(w, start, time));
    // At rest at `phi_0`: the largest rate is 2 w sin(phi_0 / 2).
    within("angle, rad", difference, 2.0 * w * (start / 2.0).sin() * SWING);

    let passages: Vec<_> = ran.outcome.events.iter().map(|event| event.time).collect();
    let quarters = (0..).map(|half| period * (0.25 + 0.5 * f64::from(half)));
    let known: Vec<_> = quarters.take_while(|time| *time < duration).collect();
    assert_eq!(passages.len(), known.len());
    let pairs = passages.iter().zip(&known);
    let late = pairs.map(|(found, known)| (found - known).abs()).fold(0.0, f64::max);
    within("passage, s", late, SWING);
}

/// The phase of the swing, s: an error of a step in the amplitude changes the period, which grows
/// with the time. A passage is found to 1e-12 s. Measured: 3.1e-12 at the passages; 2.1e-11 rad,
/// that is 2.8e-12 s at the largest rate.
const SWING: f64 = 1e-11;

/// The reactions of the two motors cancel, so the hub is at rest and `J spin' = u`. Polynomials of
/// the second degree are exact for the method: what is left is rounding.
#[test]
fn opposite_wheels_spin_up_and_the_hub_stays_at_rest() {
    let ran = ScenarioRun::from_file("known-opposite-wheels.toml");
    let inertia = ran.scenario.devices.0[0].parameters().bodies[0].inertia.m11;
    let torque = ran.scenario.drives[0].profile().expect("a torque").at(0.0, false);
    let duration = ran.scenario.settings.duration;
    let rate = torque / inertia;
    for wheel in ["wheel", "opposite"] {
        let names = [format!("{wheel}.spin"), format!("{wheel}.theta")];
        let spin = ran.worst([names[0].as_str()], |time, [spin]| spin - rate * time);
        within("spin, relative", spin / (rate * duration), SPIN_UP);
        let angle =
            ran.worst([names[1].as_str()], |time, [theta]| theta - 0.5 * rate * time * time);
        within("angle, relative", angle / (0.5 * rate * duration * duration), SPIN_UP);
    }
    let names = ["omega_x", "omega_y", "omega_z", "position_x", "position_y", "position_z"];
    let hub = ran.worst(names, |_, row| row.iter().map(|x| x * x).sum::<f64>().sqrt());
    // Half a turn costs no rounding, so the reactions cancel to the bit.
    within("hub, rad/s and m", hub, 0.0);
}

/// Fifty roundings, relative to the end. Measured: 1.2e-15, which is five.
const SPIN_UP: f64 = 1e-14;
