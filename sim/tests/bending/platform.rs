//! An isolated platform on a node of a structure: two springs in series against their closed form, in
//! time and in frequency, and as it is written out.

use nalgebra::{Complex, Matrix2, Matrix3, Vector2, Vector3};
use precess::file::from_toml;
use precess::jitter::device::Steady;
use precess::jitter::model::{Model, Output};
use precess::structure::dynamic_mass::Motor;

use super::{columns, folder, ran, text};

/// Mass of platform and wheel, kg; stiffness, N/m, and damping, N s/m, of the slide.
const ISOLATOR: [f64; 3] = [3.0, 6000.0, 8.0];
/// Frequency, rad/s, and shape at the node, kg^-1/2, of the mode.
const MODE: [f64; 2] = [60.0, 0.8];

/// A panel with one mode along z, on a base too heavy to move; a wheel on a platform that slides along z.
fn panel(damping: f64, hub_mode: &str, rate: f64, start: &str) -> String {
    let ([_, stiffness, dashpot], [frequency, shape]) = (ISOLATOR, MODE);
    let dashpot = dashpot * damping;
    format!(
        r#"
format = 1
[hub]
mass = "1e12 kg"
inertia = "1e12, 1e12, 1e12 kg m^2"
{hub_mode}
[structure]
contains_devices = false
[[structure.point]]
name = "tip"
[[structure.node]]
name = "tip"
position = "1.2, 0, 0 m"
[[structure.mode]]
frequency = "{frequency} rad/s"
damping = {damping_ratio}
linear_momentum = [0, 0, 0.5]
angular_momentum = [0, -0.4, 0]
[[structure.mode.shape]]
node = "tip"
translation = [0, 0, {shape}]
rotation = [0, 0, 0]
[[platform]]
name = "iso"
node = "tip"
mass = "1 kg"
inertia = "1, 1, 1 g m^2"
x_slide = {{ locked = true }}
y_slide = {{ locked = true }}
z_slide = {{ stiffness = "{stiffness} N/m", damping = "{dashpot} N s/m"{start} }}
x_turn = {{ locked = true }}
y_turn = {{ locked = true }}
z_turn = {{ locked = true }}
[[device]]
name = "rw"
kind = "reaction_wheel"
on = "iso"
mount = {{ spin_axis = [1, 0, 0] }}
imbalance = {{ static = "{imbalance} g cm" }}
[device.wheel]
mass = "2 kg"
inertia = "40, 25, 25 kg cm^2"
rate = "{rate} rad/s"
[run]
duration = "0.5 s"
integrator = "dop853"
tolerance = 1e-13
[output]
rate = "200 Hz"
"#,
        damping_ratio = 0.02 * damping,
        imbalance = if rate == 0.0 { 0.0 } else { 20.0 },
    )
}

/// eta'' + w^2 eta = phi k z, M (phi eta'' + z'') = -k z.
#[test]
fn two_springs_in_series_swing_as_their_closed_form() {
    let scenario = text(&panel(0.0, "mode = \"fixed\"", 0.0, ", displacement = \"3 mm\""));
    let ([mass, k, _], [w, phi]) = (ISOLATOR, MODE);
    // Acceleration by coordinates (eta, z).
    let a = Matrix2::new(-w * w, phi * k, phi * w * w, -k / mass - phi * phi * k);
    let (samples, _) = ran(&scenario);
    let half = 0.5 * a.trace();
    let root = (half * half - a.determinant()).sqrt();
    let squares = [-half - root, -half + root];
    let start = Vector2::new(0.0, 3e-3);
    let mut worst: f64 = 0.0;
    for [t, tip, z] in columns(&samples, ["time", "tip.displacement_z", "iso.z"]) {
        // (A + s_2) / (s_2 - s_1) projects on the mode with frequency squared s_1.
        let [one, two] = squares;
        let part = |own: f64, other: f64| {
            (a + Matrix2::identity() * other) / (other - own) * start * (own.sqrt() * t).cos()
        };
        let now = part(one, two) + part(two, one);
        worst = worst.max((tip - phi * now.x).abs().max((z - now.y).abs()) / 3e-3);
    }
    println!("{worst:.1e}");
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn a_wheel_on_an_isolator_shakes_the_mode_as_two_masses_in_series() {
    let scenario = text(&panel(1.0, "", 100.0, ""));
    let steady = Steady { motor: Motor::ConstantTorque, sprung: true, swept: Some(&[]) };
    let along_z = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let outputs = [Output { name: "tip z".to_owned(), terms: vec![("tip".to_owned(), along_z)] }];
    let model = Model::new(&scenario, &outputs, &steady).expect("valid");
    assert_eq!(model.contributors().len(), 1);
    let ([mass, k, c], [w, phi]) = (ISOLATOR, MODE);
    for speed in [20.0, 41.0, 58.0, 90.0, 300.0_f64] {
        let line = &model.lines(speed).expect("bounded")[0];
        let spring = Complex::new(k, c * speed);
        let s = -speed * speed;
        let own = Complex::new(w * w + s, 2.0 * 0.02 * w * speed);
        let system = Matrix2::new(
            own,
            -spring * phi,
            Complex::from(mass * phi * s),
            Complex::from(mass * s) + spring,
        );
        let force = Vector2::new(Complex::from(0.0), Complex::from(2e-4 * speed * speed));
        let solved = system.try_inverse().expect("damped") * force;
        let expected = (solved.x * phi).norm();
        let miss = (line.values[0].norm() / expected - 1.0).abs();
        println!("{speed}: {expected:.3e} m, {miss:.1e}");
        // The base moves by its own mass: 1e-12.
        assert!(miss < 1e-9, "{speed}: {miss:e}");
    }
}

/// The text with every default reads back as the same scenario.
#[test]
fn the_node_of_a_platform_is_written_out() {
    let scenario = text(&panel(1.0, "", 100.0, ""));
    let structure = scenario.structure.as_ref().expect("a structure");
    assert_eq!(structure.on_node, [0, 0]);
    let filled = scenario.source.filled.clone();
    let again = from_toml("test.toml", &filled, &folder());
    let (again, _) = again.unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(again.source.filled, filled);
    assert_eq!(again.structure, scenario.structure);
}

/// What the model contains of a platform is its body with that of its devices.
#[test]
fn contained_platforms_are_subtracted_with_their_devices() {
    let whole =
        panel(1.0, "", 0.0, "").replace("contains_devices = false", "contains_devices = true");
    let craft = text(&whole).flexible().expect("a structure").expect("valid");
    let mass = craft.mass();
    assert!((mass - 1e12).abs() < 1e-3, "{mass}");
    let apart = text(&panel(1.0, "", 0.0, "")).flexible().expect("a structure").expect("valid");
    assert!((apart.mass() - 1e12 - ISOLATOR[0]).abs() < 1e-3, "{}", apart.mass());
}

/// Mass of the platform below, kg; stiffness, N/m, and damping, N s/m, of its slide.
const BELOW: [f64; 3] = [2.0, 9000.0, 5.0];

/// The platform with the wheel on another platform, which is on the node.
fn stacked(text: &str) -> String {
    let [mass, stiffness, dashpot] = BELOW;
    let below = format!(
        r#"[[platform]]
name = "below"
node = "tip"
mass = "{mass} kg"
inertia = "1, 1, 1 g m^2"
x_slide = {{ locked = true }}
y_slide = {{ locked = true }}
z_slide = {{ stiffness = "{stiffness} N/m", damping = "{dashpot} N s/m" }}
x_turn = {{ locked = true }}
y_turn = {{ locked = true }}
z_turn = {{ locked = true }}
[[device]]
"#
    );
    text.replace("name = \"iso\"\nnode = \"tip\"", "name = \"iso\"\non = \"below\"").replacen(
        "[[device]]\n",
        &below,
        1,
    )
}

/// With s the square of the frequency, less than zero:
///
/// ```text
/// (w^2 + s) eta - phi k_1 z_1 = 0
/// m_1 (s phi eta + s z_1) + k_1 z_1 - k_2 z_2 = 0
/// m_2 (s phi eta + s z_1 + s z_2) + k_2 z_2 = F
/// ```
#[test]
fn a_wheel_on_two_isolators_shakes_the_mode_as_three_masses_in_series() {
    let scenario = text(&stacked(&panel(1.0, "", 100.0, "")));
    assert_eq!(scenario.names, ["below", "iso", "rw"]);
    assert_eq!(scenario.structure.as_ref().expect("a structure").on_node, [0, 0, 0]);
    let steady = Steady { motor: Motor::ConstantTorque, sprung: true, swept: Some(&[]) };
    let along_z = [0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
    let outputs = [Output { name: "tip z".to_owned(), terms: vec![("tip".to_owned(), along_z)] }];
    let model = Model::new(&scenario, &outputs, &steady).expect("valid");
    assert_eq!(model.contributors().len(), 1);
    let ([upper, k, c], [lower, k_below, c_below], [w, phi]) = (ISOLATOR, BELOW, MODE);
    for speed in [20.0, 41.0, 58.0, 90.0, 300.0_f64] {
        let line = &model.lines(speed).expect("bounded")[0];
        let [spring, below] = [[k, c], [k_below, c_below]].map(|[k, c]| Complex::new(k, c * speed));
        let s = -speed * speed;
        let own = Complex::new(w * w + s, 2.0 * 0.02 * w * speed);
        let none = Complex::from(0.0);
        let system = Matrix3::new(
            own,
            -below * phi,
            none,
            Complex::from(lower * phi * s),
            Complex::from(lower * s) + below,
            -spring,
            Complex::from(upper * phi * s),
            Complex::from(upper * s),
            Complex::from(upper * s) + spring,
        );
        let force = Vector3::new(none, none, Complex::from(2e-4 * speed * speed));
        let solved = system.try_inverse().expect("damped") * force;
        let expected = (solved.x * phi).norm();
        let miss = (line.values[0].norm() / expected - 1.0).abs();
        println!("{speed}: {expected:.3e} m, {miss:.1e}");
        // The base moves by its own mass: 1e-12.
        assert!(miss < 1e-9, "{speed}: {miss:e}");
    }
    // Written out, and as a part of what the model contains.
    let filled = scenario.source.filled.clone();
    let (again, _) = from_toml("test.toml", &filled, &folder()).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((&again.source.filled, &again.structure), (&filled, &scenario.structure));
    let whole = stacked(&panel(1.0, "", 0.0, ""));
    let whole = text(&whole.replace("contains_devices = false", "contains_devices = true"));
    let mass = whole.flexible().expect("a structure").expect("valid").mass();
    assert!((mass - 1e12).abs() < 1e-3, "{mass}");
}
