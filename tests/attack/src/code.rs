//! A case as a test to paste: hub, devices, state and inputs as far as they are not the default.

use std::fmt::Write as _;

use nalgebra::{Matrix3, Vector3};
use precess_dynamics::{
    Attitude, BalancedDgcmg, BalancedDgvscmg, BalancedReactionWheel, BalancedSgcmg, BalancedVscmg,
    BuiltIn, Dgcmg, Dgvscmg, Each, FlexibleReactionWheel, FlexibleVscmg, Gravity, HingedPanel,
    HubMode, ImbalanceModel, Inputs, JointStates, Mode, Passive, Quaternion, ReactionWheel, Sgcmg,
    SloshMass, State, Vscmg, Wrench,
};

use super::case::{Case, List};

/// A number as a literal that is exactly it.
fn number(x: f64) -> String {
    if x.is_nan() {
        "f64::NAN".to_owned()
    } else if x.is_infinite() {
        if x > 0.0 { "f64::INFINITY" } else { "f64::NEG_INFINITY" }.to_owned()
    } else {
        format!("{x:?}")
    }
}

fn vector(v: &Vector3<f64>) -> String {
    if v.iter().all(|x| x.to_bits() == 0) {
        return "Vector3::zeros()".to_owned();
    }
    let [x, y, z] = [v.x, v.y, v.z].map(number);
    format!("Vector3::new({x}, {y}, {z})")
}

fn matrix(m: &Matrix3<f64>) -> String {
    if *m == Matrix3::identity() {
        return "Matrix3::identity()".to_owned();
    }
    if m.iter().all(|x| x.to_bits() == 0) {
        return "Matrix3::zeros()".to_owned();
    }
    if *m == Matrix3::from_diagonal(&m.diagonal()) {
        return format!("Matrix3::from_diagonal(&{})", vector(&m.diagonal()));
    }
    let rows: Vec<_> = m.transpose().iter().map(|x| number(*x)).collect();
    format!("Matrix3::new({})", rows.join(", "))
}

/// Something that is printed as code.
trait Code {
    fn code(&self) -> String;
}

impl Code for f64 {
    fn code(&self) -> String {
        number(*self)
    }
}

impl Code for Vector3<f64> {
    fn code(&self) -> String {
        vector(self)
    }
}

impl Code for Matrix3<f64> {
    fn code(&self) -> String {
        matrix(self)
    }
}

impl Code for Passive {
    fn code(&self) -> String {
        let Self { stiffness, rest, viscous, coulomb, coulomb_rate } = *self;
        let all = [
            ("stiffness", stiffness),
            ("rest", rest),
            ("viscous", viscous),
            ("coulomb", coulomb),
            ("coulomb_rate", coulomb_rate),
        ];
        if all.iter().all(|(_, x)| *x == 0.0) {
            return "Passive::none()".to_owned();
        }
        let fields = all.iter().filter(|(_, x)| *x != 0.0);
        let fields: Vec<_> = fields.map(|(name, x)| format!("{name}: {}", number(*x))).collect();
        format!("Passive {{ {}, ..Passive::none() }}", fields.join(", "))
    }
}

fn wrench(wrench: &Wrench) -> String {
    format!("Wrench {{ force: {}, moment: {} }}", vector(&wrench.force), vector(&wrench.moment))
}

/// Each kind by what it starts from, its other fields and its joints.
macro_rules! kinds {
    ($($kind:ident $module:ident $start:ident($($of:ident),*) [$($field:ident)*] [$($joint:ident)*]
        $($model:ident)?;)*) => {
        /// A device as an expression.
        fn device(device: &BuiltIn) -> String {
            match device {
                $(BuiltIn::$kind(given) => {
                    let bare = $kind::$start($(given.$of),*);
                    let mut fields: Vec<String> = Vec::new();
                    $(if given.$field != bare.$field {
                        fields.push(format!("{}: {}", stringify!($field), given.$field.code()));
                    })*
                    if given.passive != bare.passive {
                        let joints = [$((stringify!($joint), given.passive.$joint)),*];
                        let joints = joints.map(|(name, own)| format!("{name}: {}", own.code()));
                        let module = concat!("precess_dynamics::", stringify!($module), "::PerJoint");
                        fields.push(format!("passive: {module} {{ {} }}", joints.join(", ")));
                    }
                    $(if given.$model == ImbalanceModel::Lumped {
                        fields.push("model: ImbalanceModel::Lumped".to_owned());
                    })?
                    let of = [$(given.$of.code()),*].join(", ");
                    let kind = stringify!($kind);
                    let bare = format!("{kind}::{}({of})", stringify!($start));
                    if fields.is_empty() {
                        bare
                    } else {
                        format!("{kind} {{ {}, ..{bare} }}", fields.join(", "))
                    }
                })*
            }
        }
    };
}

kinds! {
    ReactionWheel reaction_wheel bare_wheel(m_w, i_w_wc) [mount r_w_b d] [wheel] model;
    BalancedReactionWheel balanced_reaction_wheel bare_wheel(m_w, j_11, j_22) [mount r_w_b] [wheel];
    FlexibleReactionWheel flexible_reaction_wheel bare_wheel(m_w, i_w_wc) [mount r_sx_b d]
        [axial_slide radial_slide_y radial_slide_z tilt_y tilt_z wheel] model;
    FlexibleVscmg flexible_vscmg bare_wheel(m_w, i_w_wc) [mount r_g_b m_g r_gc_g i_g_gc l_g d]
        [gimbal axial_slide radial_slide_y radial_slide_z tilt_y tilt_z wheel] model;
    HingedPanel hinged_panel bare_panel(m_p, i_p_pc) [mount r_p_b r_pc_p] [panel];
    SloshMass slosh_mass bare_slosh_mass(m_s) [mount r_s_b] [slosh_mass];
    Sgcmg sgcmg bare_wheel(m_w, i_w_wc) [mount r_g_b m_g r_gc_g i_g_gc l_g d] [gimbal wheel] model;
    BalancedSgcmg balanced_sgcmg bare_wheel(m_w, j_11, j_22)
        [mount r_g_b m_g r_gc_g i_g_gc l_g] [gimbal wheel];
    Vscmg vscmg bare_wheel(m_w, i_w_wc) [mount r_g_b m_g r_gc_g i_g_gc l_g d] [gimbal wheel] model;
    BalancedVscmg balanced_vscmg bare_wheel(m_w, j_11, j_22)
        [mount r_g_b m_g r_gc_g i_g_gc l_g] [gimbal wheel];
    Dgcmg dgcmg bare_wheel(m_w, i_w_wc)
        [mount r_go_b m_go r_goc_go i_go_goc l_o m_gi r_gic_gi i_gi_gic l_i d]
        [outer_gimbal inner_gimbal wheel] model;
    BalancedDgcmg balanced_dgcmg bare_wheel(m_w, j_11, j_22)
        [mount r_go_b m_go r_goc_go i_go_goc l_o m_gi r_gic_gi i_gi_gic l_i]
        [outer_gimbal inner_gimbal wheel];
    Dgvscmg dgvscmg bare_wheel(m_w, i_w_wc)
        [mount r_go_b m_go r_goc_go i_go_goc l_o m_gi r_gic_gi i_gi_gic l_i d]
        [outer_gimbal inner_gimbal wheel] model;
    BalancedDgvscmg balanced_dgvscmg bare_wheel(m_w, j_11, j_22)
        [mount r_go_b m_go r_goc_go i_go_goc l_o m_gi r_gic_gi i_gi_gic l_i]
        [outer_gimbal inner_gimbal wheel];
}

/// How a device's data are reached in the set: `[2]` in an array of one kind, `.2` in a tuple.
fn paths(list: &List) -> Vec<String> {
    let alike = list.windows(2).all(|pair| pair[0].kind() == pair[1].kind());
    let path = |index| match (alike, list.len() > 8) {
        (true, _) => format!("[{index}]"),
        (false, false) => format!(".{index}"),
        (false, true) => format!(".{}.{}", index / 8, index % 8),
    };
    (0..list.len()).map(path).collect()
}

fn devices(list: &List) -> String {
    let all: Vec<_> = list.iter().map(device).collect();
    let alike = list.windows(2).all(|pair| pair[0].kind() == pair[1].kind());
    let row = |all: &[String]| {
        all.iter().fold(String::new(), |text, device| format!("{text}        {device},\n"))
    };
    match (list.is_empty(), alike, list.len() > 8) {
        (true, ..) => "    let devices: [ReactionWheel; 0] = [];\n".to_owned(),
        (_, true, _) => format!("    let devices = [\n{}    ];\n", row(&all)),
        (_, false, false) => format!("    let devices = (\n{}    );\n", row(&all)),
        (_, false, true) => {
            let rows: Vec<_> = all.chunks(8).map(|all| format!("(\n{})", row(all))).collect();
            format!("    let devices = ({});\n", rows.join(", "))
        }
    }
}

/// Assignments that make one state of another.
fn state(name: &str, case: &Case, from: &State<List>, to: &State<List>) -> String {
    let mut text = String::new();
    let mut set = |field: &str, value: String| {
        let _ = writeln!(text, "    {name}.{field} = {value};");
    };
    for (field, from, to) in [
        ("r_b_n", &from.r_b_n, &to.r_b_n),
        ("r_b_n_dot", &from.r_b_n_dot, &to.r_b_n_dot),
        ("omega", &from.omega, &to.omega),
    ] {
        if from != to {
            set(field, vector(to));
        }
    }
    if from.attitude != to.attitude {
        let Quaternion { q0, q1, q2, q3 } = to.attitude;
        let [q0, q1, q2, q3] = [q0, q1, q2, q3].map(number);
        set("attitude", format!("Quaternion {{ q0: {q0}, q1: {q1}, q2: {q2}, q3: {q3} }}"));
    }
    let joints = from.devices.states().zip(to.devices.states()).zip(joints(case));
    for (([q, rate], [to_q, to_rate]), (path, info)) in joints {
        for (field, from, to) in [(info.coordinate, q, to_q), (info.rate, rate, to_rate)] {
            if from.to_bits() != to.to_bits() {
                set(&format!("devices{path}.{field}"), number(to));
            }
        }
    }
    text
}

type Joint = (String, &'static precess_dynamics::kind::JointInfo);

/// Each joint by the path of its device.
fn joints(case: &Case) -> Vec<Joint> {
    let devices = case.devices.iter().zip(paths(&case.devices));
    let joints = devices.flat_map(|(device, path)| {
        device.kind().joints().iter().map(move |info| (path.clone(), info))
    });
    joints.collect()
}

/// Assignments that make some inputs of others.
fn inputs(name: &str, case: &Case, from: &Inputs<List>, to: &Inputs<List>) -> String {
    let mut text = String::new();
    let mut line = |line: String| {
        let _ = writeln!(text, "    {line}");
    };
    for (field, from, to) in
        [("force", &from.force, &to.force), ("torque_b", &from.torque_b, &to.torque_b)]
    {
        if from != to {
            line(format!("{name}.{field} = {};", vector(to)));
        }
    }
    let motors = from.motors.values().zip(to.motors.values()).zip(joints(case));
    for ((from, to), (path, info)) in motors {
        if from.to_bits() != to.to_bits() {
            line(format!("{name}.motors{path}.{} = {};", info.motor, number(to)));
        }
    }
    let modes = from.modes.values().zip(to.modes.values()).zip(joints(case));
    for ((from, to), (path, info)) in modes {
        if from != to {
            let mode = match to {
                Mode::Driven => "Mode::Driven".to_owned(),
                Mode::Locked => "Mode::Locked".to_owned(),
                Mode::Prescribed(x) => format!("Mode::Prescribed({})", number(x)),
            };
            line(format!("{name}.modes{path}.{} = {mode};", field(info.body)));
        }
    }
    if from.hub != to.hub {
        let mode = match &to.hub {
            HubMode::Free => "HubMode::Free".to_owned(),
            HubMode::Fixed => "HubMode::Fixed".to_owned(),
            HubMode::Prescribed { r_b_n_ddot, omega_dot } => {
                let [linear, angular] = [r_b_n_ddot, omega_dot].map(vector);
                format!("HubMode::Prescribed {{ r_b_n_ddot: {linear}, omega_dot: {angular} }}")
            }
        };
        line(format!("{name}.hub = {mode};"));
    }
    if from.gravity != to.gravity {
        let gravity = match &to.gravity {
            Gravity::None => "Gravity::None".to_owned(),
            Gravity::Uniform(g) => format!("Gravity::Uniform({})", vector(g)),
            Gravity::Central { mu } => format!("Gravity::Central {{ mu: {} }}", number(*mu)),
        };
        line(format!("{name}.gravity = {gravity};"));
    }
    match &to.bodies {
        None if from.bodies.is_some() => line(format!("{name}.bodies = None;")),
        Some(bodies) if from.bodies != to.bodies => {
            line("let mut bodies = Inputs::no_wrenches_for(&craft);".to_owned());
            for (found, (path, info)) in bodies.values().zip(joints(case)) {
                if found != Wrench::none() {
                    line(format!("bodies{path}.{} = {};", field(info.body), wrench(&found)));
                }
            }
            line(format!("{name}.bodies = Some(bodies);"));
        }
        _ => {}
    }
    text
}

/// A body's name as a field's.
fn field(body: &str) -> String {
    body.replace(' ', "_")
}

/// Names that printed code may use.
const NAMES: [&str; 27] = [
    "BalancedDgcmg",
    "BalancedDgvscmg",
    "BalancedReactionWheel",
    "BalancedSgcmg",
    "BalancedVscmg",
    "BuiltIn",
    "Dgcmg",
    "Dgvscmg",
    "FlexibleReactionWheel",
    "FlexibleVscmg",
    "Gravity",
    "HingedPanel",
    "Hub",
    "HubMode",
    "ImbalanceModel",
    "Inputs",
    "Mode",
    "Passive",
    "Quaternion",
    "ReactionWheel",
    "Sgcmg",
    "SloshMass",
    "Spacecraft",
    "State",
    "Vscmg",
    "Wrench",
    "LoadAxes",
];

/// Whether code uses a name by itself.
fn uses(code: &str, name: &str) -> bool {
    let part = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(name)
        .any(|(at, _)| !code[..at].ends_with(part) && !code[at + name.len()..].starts_with(part))
}

/// The lines that a file of printed tests begins with.
#[must_use]
pub fn imports(code: &str) -> String {
    let algebra: Vec<_> =
        ["Matrix3", "Vector3"].into_iter().filter(|name| uses(code, name)).collect();
    let names: Vec<_> = NAMES.into_iter().filter(|name| uses(code, name)).collect();
    format!(
        "use nalgebra::{{{}}};\nuse precess_attack::Case;\nuse precess_dynamics::{{{}}};\n",
        algebra.join(", "),
        names.join(", "),
    )
}

/// A test that calls this function of `attack` on the case.
#[must_use]
pub fn test(name: &str, function: &str, case: &Case) -> String {
    let mut text = format!("#[test]\nfn {name}() {{\n");
    let add = |text: &mut String, line: &str| {
        let _ = writeln!(text, "    {line}");
    };
    let (m_b, r_bc_b) = (number(case.hub.m_b), vector(&case.hub.r_bc_b));
    let i_b_bc = matrix(&case.hub.i_b_bc);
    add(&mut text, &format!("let hub = Hub {{ m_b: {m_b}, r_bc_b: {r_bc_b}, i_b_bc: {i_b_bc} }};"));
    text += &devices(&case.devices);
    add(&mut text, "let craft = Spacecraft::new(&hub, &devices).unwrap();");
    let none = Case::still(case.hub, case.devices.clone());
    debug_assert!(none.state.attitude.is_valid());
    let of_state = state("state", case, &none.state, &case.state);
    let of_inputs = inputs("inputs", case, &none.inputs, &case.inputs);
    let mutable = |text: &str| if text.is_empty() { "" } else { "mut " };
    let line = format!("let {}state: State<_> = State::at_rest_for(&craft);", mutable(&of_state));
    add(&mut text, &line);
    text += &of_state;
    add(&mut text, &format!("let {}inputs = Inputs::none_for(&craft);", mutable(&of_inputs)));
    text += &of_inputs;
    let list = paths(&case.devices).into_iter().map(|path| format!("devices{path}.into()"));
    let list = list.collect::<Vec<_>>().join(", ");
    add(&mut text, &format!("let list: Vec<BuiltIn> = vec![{list}];"));
    let dt = number(case.dt);
    let mutable = if case.steps != 1 || !case.more.is_empty() { "mut " } else { "" };
    let last = if case.more.is_empty() { "list" } else { "list.clone()" };
    let line = format!("let {mutable}case = Case::from_set(&hub, {last}, &state, &inputs, {dt});");
    add(&mut text, &line);
    if case.steps != 1 {
        add(&mut text, &format!("case.steps = {};", case.steps));
    }
    let mutable = |changed: &str| if changed.is_empty() { "" } else { "mut " };
    for (index, (of_state, of_inputs)) in case.more.iter().enumerate() {
        let [s, i] = ["state", "inputs"].map(|name| format!("{name}_{}", index + 1));
        let changed = state(&s, case, &case.state, of_state);
        add(&mut text, &format!("let {}{s} = state;", mutable(&changed)));
        text += &changed;
        let changed = inputs(&i, case, &case.inputs, of_inputs);
        add(&mut text, &format!("let {}{i} = inputs;", mutable(&changed)));
        text += &changed;
        let line = format!("let other = Case::from_set(&hub, list.clone(), &{s}, &{i}, {dt});");
        add(&mut text, &line);
        add(&mut text, "case.more.push((other.state, other.inputs));");
    }
    add(&mut text, "println!(\"{:?}\", craft.accelerations(&state, &inputs));");
    add(&mut text, &format!("precess_attack::{function}(&case).unwrap();"));
    text + "}\n"
}
