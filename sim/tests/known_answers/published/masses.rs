//! Mass properties of JEOD: inertia about other axes, composite bodies, principal axes.

use std::fs;
use std::path::Path;
use std::process::Command;

use nalgebra::{Matrix3, Vector3};
use precess::scenario::{MassProperties, Scenario};

use super::super::within;
use super::{largest, read, rows};

/// The tests of JEOD, `models/dynamics/mass/docs/tex/ivv_tests.tex`: plates of 1 m by 2 m and 1 kg across the y axis.
const PLATE: &str = "0.33333333333333333, 0.41666666666666667, 0.08333333333333333 kg m^2";

/// From the structural axes to those of the body, test `mass_09`: a turn by -30 deg about z, then by 45 deg about x.
fn tilted() -> Matrix3<f64> {
    let (half, r8, r2) = (3_f64.sqrt() / 2.0, 8_f64.sqrt(), 0.5_f64.sqrt());
    let r3 = 3_f64.sqrt();
    rows([[half, -0.5, 0.0], [1.0 / r8, r3 / r8, r2], [-1.0 / r8, -r3 / r8, r2]])
}

/// Mass, centre of mass, and inertia about the centre of mass.
fn whole(scenario: &Scenario) -> (MassProperties, Matrix3<f64>) {
    let spacecraft = scenario.spacecraft().expect("a spacecraft");
    let properties = MassProperties::from_spacecraft(scenario, &spacecraft).expect("its mass");
    let c = properties.centre_of_mass.cross_matrix();
    (properties, properties.inertia_b + properties.mass * c * c)
}

/// How far axes, columns, are from known ones, of which either sense is one.
fn aside(axes: &Matrix3<f64>, known: &[Vector3<f64>; 3]) -> f64 {
    let off = axes.column_iter().zip(known).map(|(found, known)| found.cross(known).norm());
    off.fold(0.0, |most, off| if off.is_nan() || off > most { off } else { most })
}

/// A body fixed to the hub: a panel whose hinge is locked.
fn fixed(name: &str, position: &str, mount: &str) -> String {
    format!(
        "[[device]]\nname = \"{name}\"\nkind = \"hinged_panel\"\nposition = \"{position} m\"\n\
         mount = {mount}\npanel = {{ mass = \"1 kg\", inertia = \"{PLATE}\", locked = true }}\n"
    )
}

fn hub(inertia: &str, devices: &str) -> Scenario {
    let text = format!(
        "format = 1\n[hub]\nmass = \"1 kg\"\n{inertia}\n[run]\nduration = \"1 s\"\n{devices}"
    );
    read("hub", &text)
}

/// Test `mass_09`, the plate alone: its inertia about its own axes, which are written in two ways.
#[test]
fn an_inertia_about_other_axes_is_jeods() {
    let r6 = 3_f64.sqrt() / (48.0 * 2_f64.sqrt());
    let known = rows([
        [17.0 / 48.0, -r6, r6],
        [-r6, 23.0 / 96.0, -5.0 / 32.0],
        [r6, -5.0 / 32.0, 23.0 / 96.0],
    ]);
    let t = tilted();
    let row = |k: usize| format!("[{:e}, {:e}, {:e}]", t[(k, 0)], t[(k, 1)], t[(k, 2)]);
    let matrix = format!("{{ matrix = [{}, {}, {}] }}", row(0), row(1), row(2));
    let euler =
        r#"{ euler = "-30, 0, 45 deg", sequence = "ZYX", direction = "axes to body" }"#.to_owned();
    let back =
        r#"{ euler = "-45, 0, 30 deg", sequence = "XYZ", direction = "body to axes" }"#.to_owned();
    for axes in [matrix, euler, back] {
        let scenario = hub(&format!("inertia = \"{PLATE}\"\ninertia_axes = {axes}"), "");
        let found = largest((scenario.hub.i_b_bc - known).iter());
        within(&format!("JEOD mass_09, {axes}, kg m^2"), found, ROUNDING);
        // The structural axes are principal: the least moment is about z, the greatest about y.
        let (moments, found) = whole(&scenario).0.principal();
        let order = [2, 0, 1].map(|k| t.column(k).into_owned());
        within("JEOD mass_09, principal axes", aside(&found, &order), ROUNDING);
        let known = Vector3::new(1.0 / 12.0, 1.0 / 3.0, 5.0 / 12.0);
        within(
            "JEOD mass_09, principal moments, kg m^2",
            largest((moments - known).iter()),
            ROUNDING,
        );
    }
}

/// Test `mass_09`, two plates side by side, the hub's axes tilted.
#[test]
fn two_plates_are_jeods_square() {
    let t = tilted();
    let place: Vector3<f64> = -t.column(0);
    let mount = r#"{ euler = "-30, 0, 45 deg", sequence = "ZYX", direction = "device to hub" }"#;
    let position = format!("{:e}, {:e}, {:e}", place.x, place.y, place.z);
    let inertia = format!(
        "inertia = \"{PLATE}\"\n\
         inertia_axes = {{ euler = \"-30, 0, 45 deg\", sequence = \"ZYX\", direction = \"axes to body\" }}"
    );
    let (properties, inertia) = whole(&hub(&inertia, &fixed("child", &position, mount)));
    let r = 1.0 / (2.0 * 6_f64.sqrt());
    let known = rows([[5.0 / 6.0, -r, r], [-r, 11.0 / 12.0, -0.25], [r, -0.25, 11.0 / 12.0]]);
    within("JEOD mass_09, composite, kg m^2", largest((inertia - known).iter()), ROUNDING);
    let centre = properties.centre_of_mass - t * Vector3::new(-0.5, 0.0, 0.0);
    within("JEOD mass_09, centre of mass, m", largest(centre.iter()), ROUNDING);
}

/// Test `mass_08`, three plates, two of them on their sides: a composite with a product of inertia.
#[test]
fn three_plates_have_jeods_product_of_inertia() {
    let mount = r#"{ axis = [0, 1, 0], angle = "90 deg" }"#;
    let plates = fixed("child2", "0.5, 0, 1.5", mount) + &fixed("child3", "0.5, 0, 2.5", mount);
    let (properties, inertia) = whole(&hub(&format!("inertia = \"{PLATE}\""), &plates));
    let known = rows([
        [11.0 / 3.0, 0.0, -2.0 / 3.0],
        [0.0, 55.0 / 12.0, 0.0],
        [-2.0 / 3.0, 0.0, 11.0 / 12.0],
    ]);
    within("JEOD mass_08, composite, kg m^2", largest((inertia - known).iter()), ROUNDING);
    let centre = properties.centre_of_mass - Vector3::new(1.0 / 3.0, 0.0, 4.0 / 3.0);
    within("JEOD mass_08, centre of mass, m", largest(centre.iter()), ROUNDING);
}

/// Test `mass_07`: the tensor of a plate about axes that are turned by 30 deg about z (`Modified_data/child1_mass.py` of
/// `models/dynamics/body_action/verif/SIM_verif_attach_mass` has its digits).
const TURNED: &str = r#"format = 1
[hub]
mass = "1 kg"
inertia = "0.35416666666667, 0.39583333333333, 0.08333333333333 kg m^2"
products_of_inertia = "0.03608439182435, 0, 0 kg m^2"
[run]
duration = "1 s"
"#;

/// The plate's axes are principal. The printed matrix has the turned axes as columns, by which the printed tensor follows;
/// by the printed formula, which takes them for rows, its product of inertia would have the other sign.
#[test]
fn principal_axes_are_jeods() {
    let (moments, axes) = whole(&read("turned", TURNED)).0.principal();
    let known = Vector3::new(1.0 / 12.0, 1.0 / 3.0, 5.0 / 12.0);
    within("JEOD mass_07, principal moments, kg m^2", largest((moments - known).iter()), MOMENTS);
    let half = 3_f64.sqrt() / 2.0;
    let known = [[0.0, 0.0, 1.0], [half, -0.5, 0.0], [0.5, half, 0.0]].map(Vector3::from);
    within("JEOD mass_07, principal axes", aside(&axes, &known), AXES);
}

#[test]
fn check_prints_jeods_principal_axes() {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("published-turned.toml");
    fs::write(&path, TURNED).expect("it is written");
    let output = Command::new(env!("CARGO_BIN_EXE_precess")).arg("check").arg(&path).output();
    let text = String::from_utf8(output.expect("it runs").stdout).expect("text");
    for (name, numbers) in [
        ("principal moments about the centre of mass", "0.0833333, 0.333333, 0.416667 kg m^2"),
        ("axis of the first, B axes", "0, 0, 1"),
        ("axis of the second, B axes", "0.866025, -0.5, 0"),
        ("axis of the third, B axes", "0.5, 0.866025, 0"),
    ] {
        let line = text.lines().find_map(|line| line.strip_prefix(name));
        assert_eq!(line.map(str::trim), Some(numbers), "{name} in\n{text}");
    }
}

/// The body of three points of mass in `models/interactions/gravity_torque/docs/tex/gravity_torqueChapters.tex`, table `sc_masses`, beside a sphere of
/// 10 kg m^2 at its centre of mass.
#[test]
fn points_of_mass_have_jeods_products_of_inertia() {
    let point = |name: &str, mass: &str, position: &str| {
        format!(
            "[[device]]\nname = \"{name}\"\nkind = \"slosh_mass\"\nposition = \"{position} m\"\n\
             slosh_mass = {{ mass = \"{mass} kg\", locked = true }}\n"
        )
    };
    let points = point("one", "50", "1.625, 1.250, -1.750")
        + &point("two", "20", "-2.375, -1.750, 3.250")
        + &point("three", "10", "-3.375, -2.750, 2.250");
    let (properties, inertia) = whole(&hub("inertia = \"10, 10, 10 kg m^2\"", &points));
    let known = rows([[640.0, -277.5, 372.5], [-277.5, 783.75, 285.0], [372.5, 285.0, 583.75]]);
    within(
        "JEOD gravity_torque, composite, relative",
        largest((inertia - known).iter()) / 640.0,
        ROUNDING,
    );
    within(
        "JEOD gravity_torque, centre of mass, m",
        largest(properties.centre_of_mass.iter()),
        ROUNDING,
    );
}

/// Nine roundings. Measured: 8.9e-16 of 4.6 kg m^2 for three plates, elsewhere 2.2e-16.
const ROUNDING: f64 = 2e-15;
/// Half a unit of the last printed decimal of two elements, kg m^2. Measured: 3.3e-15.
const MOMENTS: f64 = 1e-14;
/// That, over the least difference of the principal moments, 1/12 kg m^2. Measured: 2.5e-14.
const AXES: f64 = 1.2e-13;
