//! Derivatives by parameters against differences in double-double of spacecraft that are made of
//! changed parameters.

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::kind::{Kind, ParameterValue, Shape};
use precess_dynamics::set::Change;
use precess_dynamics::{
    Angle, Axis, BuiltIn, Component, Imbalance, ParameterVariable, Passive, ReactionWheel, Scalar,
    Spacecraft, WheelImbalance,
};
use precess_tests::blocks::Figures;
use precess_tests::cases;
use precess_tests::derivative_blocks::Blocks;
use precess_tests::differences::{difference, index};
use precess_tests::double_double::DoubleDouble as Wide;

use crate::accuracy::{MEDIAN, WORST};
use crate::draw::{Case, Drawn, SEED};
use crate::outputs::{OUTPUTS, derivatives, values};

/// How many spacecraft: each has some sixty parameters.
pub(crate) const SPACECRAFT: u64 = 60;

/// A parameter, with the names that it needs.
pub(crate) type Owned = (String, Component);

/// The parameters of one device that are numbers, and whether it has an imbalance.
fn parameters_of(device: &BuiltIn) -> (Vec<Owned>, bool) {
    let mut names = Vec::new();
    for info in device.kind().parameters() {
        let components = match info.shape {
            Shape::Scalar => vec![Component::Number],
            Shape::Vector => Axis::ALL.map(Component::Along).to_vec(),
            Shape::Symmetric => {
                let rows = Axis::ALL.into_iter().enumerate();
                let upper = rows.flat_map(|(k, row)| {
                    Axis::ALL.into_iter().skip(k).map(move |column| Component::Element(row, column))
                });
                upper.collect()
            }
            Shape::Rotation | Shape::Model => vec![],
        };
        names.extend(components.into_iter().map(|component| (info.name.to_owned(), component)));
    }
    for joint in device.kind().joints() {
        for (name, _) in Passive::<f64>::PARAMETERS {
            let name = format!("passive.{}.{name}", joint.body.replace(' ', "_"));
            // Where both vanish, friction has no derivative by `coulomb`; a rate below zero is none.
            let dry = matches!(
                device.parameter(&name),
                Ok(ParameterValue::Scalar(value)) if value > 0.0
            );
            if dry {
                names.push((name, Component::Number));
            }
        }
    }
    let imbalance = device.parameter("d").is_ok();
    (names, imbalance)
}

/// Changes one parameter of one device.
struct Changed<'a> {
    device: usize,
    variable: &'a ParameterVariable<'a>,
    by: Wide,
}

impl Change<Wide> for Changed<'_> {
    fn change<K: Kind<Scalar = Wide>>(&mut self, device: &mut K) {
        let number = self.device;
        self.device = self.device.wrapping_sub(1);
        if number == 0 {
            change(device, self.variable, self.by);
        }
    }
}

fn change<K: Kind<Scalar = Wide>>(device: &mut K, variable: &ParameterVariable<'_>, by: Wide) {
    let expect = "a parameter of the kind";
    match *variable {
        ParameterVariable::Device { name, component, .. } => {
            let mut value = device.parameter(name).expect(expect);
            match (&mut value, component) {
                (ParameterValue::Scalar(x), Component::Number) => *x = *x + by,
                (ParameterValue::Vector(v), Component::Along(axis)) => {
                    v[index(axis)] = v[index(axis)] + by;
                }
                (ParameterValue::Matrix(m), Component::Element(row, column)) => {
                    let (row, column) = (index(row), index(column));
                    m[(row, column)] = m[(row, column)] + by;
                    m[(column, row)] = m[(row, column)];
                }
                _ => panic!("{name} has another shape"),
            }
            device.set_parameter(name, value).expect(expect);
        }
        ParameterVariable::MountRotation { about, .. } => {
            let rotation = rotation(index(about), by);
            let mount = *device.mount();
            let turned = Matrix3::from_fn(|row, column| {
                let [x, y, z] = [0, 1, 2].map(|k| rotation[(row, k)] * mount[(k, column)]);
                x + y + z
            });
            device.set_parameter("mount", ParameterValue::Matrix(turned)).expect(expect);
        }
        _ => change_imbalance(device, variable, by),
    }
}

/// The rotation about an axis.
fn rotation(axis: usize, angle: Wide) -> Matrix3<Wide> {
    let (sine, cosine) = angle.sin_cos();
    let (one, zero) = (Wide::from_f64(1.0), Wide::from_f64(0.0));
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut rotation = Matrix3::from_element(zero);
    rotation[(axis, axis)] = one;
    (rotation[(next, next)], rotation[(last, last)]) = (cosine, cosine);
    (rotation[(next, last)], rotation[(last, next)]) = (-sine, sine);
    rotation
}

fn change_imbalance<K: Kind<Scalar = Wide>>(
    device: &mut K,
    variable: &ParameterVariable<'_>,
    by: Wide,
) {
    let expect = "an imbalanced wheel";
    let ParameterValue::Scalar(m_w) = device.parameter("m_w").expect(expect) else { panic!() };
    let ParameterValue::Scalar(d) = device.parameter("d").expect(expect) else { panic!() };
    let ParameterValue::Matrix(mut j) = device.parameter("i_w_wc").expect(expect) else { panic!() };
    // By the definitions: U_s = m d; J_13 = U_d cos(phase), J_12 = -U_d sin(phase).
    let per_mass = precess_dynamics::Real::recip(m_w);
    let (j_12, j_13) = (j.m12, j.m13);
    let u_d = (j_12 * j_12 + j_13 * j_13).sqrt();
    let (mut offset, mut products) = (d, [j_12, j_13]);
    match variable {
        ParameterVariable::StaticImbalance { .. } => offset = d + by * per_mass,
        ParameterVariable::DynamicImbalance { .. } => {
            let ratio = (u_d + by) * precess_dynamics::Real::recip(u_d);
            products = [j_12 * ratio, j_13 * ratio];
        }
        _ => {
            let (sine, cosine) = by.sin_cos();
            products = [j_12 * cosine - j_13 * sine, j_13 * cosine + j_12 * sine];
        }
    }
    [j.m12, j.m13] = products;
    [j.m21, j.m31] = products;
    device.set_parameter("d", ParameterValue::Scalar(offset)).expect(expect);
    device.set_parameter("i_w_wc", ParameterValue::Matrix(j)).expect(expect);
}

/// The spacecraft with a parameter changed.
pub(crate) fn changed(case: &Case<Wide>, variable: &ParameterVariable<'_>, by: Wide) -> Case<Wide> {
    use precess_dynamics::set::WithNumbers;
    let mut case = case.clone();
    match *variable {
        ParameterVariable::HubMass => case.hub.m_b = case.hub.m_b + by,
        ParameterVariable::HubCentre(axis) => {
            let x = &mut case.hub.r_bc_b[index(axis)];
            *x = *x + by;
        }
        ParameterVariable::HubInertia(row, column) => {
            let (row, column) = (index(row), index(column));
            let inertia = &mut case.hub.i_b_bc;
            inertia[(row, column)] = inertia[(row, column)] + by;
            inertia[(column, row)] = inertia[(row, column)];
        }
        ParameterVariable::Device { device, .. }
        | ParameterVariable::MountRotation { device, .. }
        | ParameterVariable::StaticImbalance { device }
        | ParameterVariable::DynamicImbalance { device }
        | ParameterVariable::Phase { device } => {
            case.devices.change(&mut Changed { device, variable, by });
        }
    }
    case
}

/// The scale on which a parameter's effect changes: never so large that it changes its sign.
pub(crate) fn size(case: &Case<f64>, variable: &ParameterVariable<'_>) -> f64 {
    match variable {
        ParameterVariable::Device { device, name, .. } => {
            match case.devices[*device].parameter(name) {
                Ok(ParameterValue::Scalar(value)) if value != 0.0 => value.abs().min(1.0),
                _ => 1e-2,
            }
        }
        ParameterVariable::DynamicImbalance { .. } | ParameterVariable::StaticImbalance { .. } => {
            1e-4
        }
        _ => 1e-2,
    }
}

/// The parameters of each device, with the names that they need.
pub(crate) fn parameters(case: &Case<f64>) -> Vec<(Vec<Owned>, bool)> {
    case.devices.iter().map(parameters_of).collect()
}

/// Those of the hub and of these devices.
pub(crate) fn variables(of_devices: &[(Vec<Owned>, bool)]) -> Vec<ParameterVariable<'_>> {
    let mut variables = vec![ParameterVariable::HubMass];
    variables.extend(Axis::ALL.map(ParameterVariable::HubCentre));
    variables.extend(Axis::ALL.map(|axis| ParameterVariable::HubInertia(axis, axis)));
    variables.push(ParameterVariable::HubInertia(Axis::X, Axis::Z));
    for (device, (names, imbalance)) in of_devices.iter().enumerate() {
        variables.extend(names.iter().map(|(name, component)| ParameterVariable::Device {
            device,
            name,
            component: *component,
        }));
        variables.extend(Axis::ALL.map(|about| ParameterVariable::MountRotation { device, about }));
        if *imbalance {
            variables.push(ParameterVariable::StaticImbalance { device });
            variables.push(ParameterVariable::DynamicImbalance { device });
            variables.push(ParameterVariable::Phase { device });
        }
    }
    variables
}

/// The block of a parameter, and the size of a change of it.
pub(crate) fn block(case: &Case<f64>, variable: &ParameterVariable<'_>) -> (String, f64) {
    let kind = match *variable {
        ParameterVariable::Device { device, name, .. } => format!("{device} {name}"),
        ParameterVariable::MountRotation { device, .. } => format!("{device} mount"),
        ParameterVariable::HubCentre(_) => "hub centre".to_owned(),
        ParameterVariable::HubInertia(..) => "hub inertia".to_owned(),
        other => format!("{other:?}"),
    };
    let large = match *variable {
        ParameterVariable::HubMass => case.hub.m_b,
        ParameterVariable::HubInertia(..) => case.hub.i_b_bc.amax(),
        ParameterVariable::HubCentre(_) | ParameterVariable::MountRotation { .. } => 1.0,
        other => size(case, &other),
    };
    (kind, large)
}

/// The worst block of a spacecraft; a block has one parameter.
fn worst_block(drawn: &Drawn) -> (f64, String) {
    let (case, wide) = (drawn.case::<f64>(), drawn.case::<Wide>());
    let craft = case.craft();
    let of_devices = parameters(&case);
    let variables = variables(&of_devices);
    let mut blocks = Blocks::default();
    let mut given = Vec::new();
    let found = Spacecraft::parameter_derivatives(
        &case.hub,
        &case.devices,
        (&case.state, &case.inputs),
        &OUTPUTS,
        variables.iter().copied(),
        |variable, column| {
            given.push(variable);
            let of = |by| {
                let case = changed(&wide, &variable, by);
                values(&case.craft(), &case)
            };
            let expected = difference(size(&case, &variable), of);
            let (kind, large) = block(&case, &variable);
            blocks.add(&kind, large, &derivatives(&craft, case.inputs.hub, column), &expected);
        },
    );
    let found = found.unwrap_or_else(|error| panic!("seed {:#x}: {error}", drawn.seed));
    assert_eq!(given, variables, "columns in the order of the variables");
    assert_eq!(Ok(found), craft.accelerations(&case.state, &case.inputs));
    blocks.errors().fold((0.0, String::new()), |a, b| if b.0 > a.0 { b } else { a })
}

/// The same by parameters.
pub(crate) fn measured() -> (Figures, (f64, String, u64)) {
    let mut figures = Figures::default();
    let mut worst = (0.0, String::new(), 0);
    for seed in SEED..SEED + cases(SPACECRAFT) {
        let (error, name) = worst_block(&Drawn::new(seed));
        figures.add(error);
        if error > WORST {
            println!("seed {seed:#x}: {error:.1e} in {name}");
        }
        if error > worst.0 {
            worst = (error, name, seed);
        }
    }
    (figures, worst)
}

#[test]
fn derivatives_by_parameters_are_those_of_differences() {
    let (figures, (error, name, seed)) = measured();
    println!("worst {error:.1e} in {name}, seed {seed:#x}; median {:.1e}", figures.median());
    assert!(figures.worst() <= WORST, "{error:e} in {name} at seed {seed:#x}");
    assert!(figures.median() <= MEDIAN, "median {:e}", figures.median());
}

/// A wheel at this offset on a hub at rest: the load on the hub is that of the data sheet.
#[test]
fn derivatives_by_imbalance_are_those_of_the_data_sheet() {
    let disc = Matrix3::from_diagonal(&Vector3::new(0.02, 0.011, 0.011));
    let bare = ReactionWheel::bare_wheel(4.0, disc);
    let hub = precess_dynamics::Hub {
        m_b: 100.0,
        r_bc_b: Vector3::zeros(),
        i_b_bc: Matrix3::identity() * 10.0,
    };
    let (spin, phase) = (100.0, 0.3_f64);
    for d in [1e-4, -1e-4] {
        let mut wheel = ReactionWheel { d, ..bare };
        let products = Imbalance { u_s: 4e-4, u_d: 2e-6, phase }.in_wheel(4.0).unwrap();
        let WheelImbalance { j_12, j_13, .. } = products;
        [wheel.i_w_wc.m12, wheel.i_w_wc.m21] = [j_12; 2];
        [wheel.i_w_wc.m13, wheel.i_w_wc.m31] = [j_13; 2];
        let mut state = precess_dynamics::State::<[ReactionWheel; 1]>::at_rest();
        state.devices[0].spin = spin;
        let mut inputs = precess_dynamics::Inputs::<[ReactionWheel; 1]>::none();
        inputs.hub = precess_dynamics::HubMode::Fixed;
        let outputs = precess_dynamics::Outputs {
            loads: Some(precess_dynamics::LoadAxes::Body),
            ..precess_dynamics::Outputs::accelerations()
        };
        let variables = [
            ParameterVariable::StaticImbalance { device: 0 },
            ParameterVariable::DynamicImbalance { device: 0 },
            ParameterVariable::Phase { device: 0 },
        ];
        let mut loads = Vec::new();
        let column = |_, column: &precess_dynamics::Column<[ReactionWheel; 1]>| {
            loads.push(column.loads.expect("requested")[0].wheel);
        };
        let of = (&state, &inputs);
        Spacecraft::parameter_derivatives(&hub, &[wheel], of, &outputs, variables, column).unwrap();
        // The bearing exerts the opposite of what the wheel does, on a mount at rest: force
        // -Omega² U_s w_y, torque -Omega² U_d (cos w_y + sin w_z), turned by pi for a negative d.
        let sense = d.signum();
        let square = spin * spin;
        let (sine, cosine) = (phase.sin(), phase.cos());
        let close = |found: Vector3<f64>, y: f64, z: f64| {
            let expected = Vector3::new(0.0, y, z) * square;
            assert!((found - expected).amax() <= 1e-12 * square, "{found} is not {expected}");
        };
        close(loads[0].force, -sense, 0.0);
        close(loads[1].moment, -cosine, -sine);
        close(loads[2].moment, 2e-6 * sine, -2e-6 * cosine);
    }
}
