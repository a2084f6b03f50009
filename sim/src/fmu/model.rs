//! `model.h` and `model.c`: what a scenario adds to the C that is the same in every unit, which is numbers.

use std::fmt::Write as _;

use precess_dynamics::{Gravity, HubMode};

use super::SOLVER;
use super::layout::{GRAVITY, Layout};
use super::variables::{Variable, gravity, nominals};
use crate::scenario::{Drive, Scenario, Target, WrenchAxes};

/// Numbers that are no variables.
#[derive(Clone, Debug)]
pub(super) struct Constants {
    hub: &'static str,
    field: &'static str,
    gravity: [f64; 4],
    nominals: Vec<f64>,
    names: Vec<String>,
    joints: Vec<String>,
    wrenches: Vec<String>,
}

impl Constants {
    pub(super) fn new(scenario: &Scenario, layout: &Layout) -> Self {
        let mut joints = Vec::new();
        for (joint, (((.., info), drive), input)) in
            scenario.joints().zip(&scenario.drives).zip(&layout.motors).enumerate()
        {
            let mode = match drive {
                _ if !info.driven => "PRECESS_PRESCRIBED",
                Drive::Torque { .. } => "PRECESS_DRIVEN",
                Drive::Acceleration(_) => "PRECESS_PRESCRIBED",
                Drive::Locked => "PRECESS_LOCKED",
            };
            let input = input.map_or_else(|| "-1".to_owned(), |input| input.to_string());
            let stop = scenario.stops.iter().find(|stop| stop.joint == joint);
            let [lower, upper] =
                stop.map_or([f64::NEG_INFINITY, f64::INFINITY], |stop| [stop.lower, stop.upper]);
            let limit = drive.limits().torque.map_or(f64::INFINITY, f64::abs);
            let [limit, lower, upper] = [limit, lower, upper].map(number);
            joints.push(format!("{{ {mode}, {input}, {limit}, {lower}, {upper} }}"));
        }
        let wrench = |of: &crate::scenario::AppliedWrench| {
            let joint = match of.body {
                Target::Joint(joint) => joint.to_string(),
                Target::Hub | Target::Node(_) => "FMU_JOINTS".to_owned(),
            };
            let inertial = u8::from(of.axes == WrenchAxes::Inertial);
            let [x, y, z] = [of.point.x, of.point.y, of.point.z].map(number);
            format!("{{ {joint}, {inertial}, {{ {x}, {y}, {z} }} }}")
        };
        let names = scenario.names.iter().map(String::as_str).chain(["hub"]);
        let none = "{ FMU_JOINTS, 0, { 0.0, 0.0, 0.0 } }".to_owned();
        Self {
            hub: match scenario.hub_mode {
                HubMode::Free => "PRECESS_HUB_FREE",
                HubMode::Fixed => "PRECESS_HUB_FIXED",
                HubMode::Prescribed { .. } => "PRECESS_HUB_PRESCRIBED",
            },
            field: match scenario.gravity {
                Gravity::None => "PRECESS_NO_FIELD",
                Gravity::Uniform(_) => "PRECESS_UNIFORM_FIELD",
                Gravity::Central { .. } => "PRECESS_CENTRAL_FIELD",
            },
            gravity: gravity(scenario),
            nominals: nominals(scenario),
            names: names.map(|name| format!("\"{name}\"")).collect(),
            joints,
            wrenches: scenario.wrenches.iter().map(wrench).chain([none]).collect(),
        }
    }

    /// `model.c`, from the value of each place.
    pub(super) fn source(&self, start: &[f64]) -> String {
        let mut text = "/* Written by `precess export fmu`: the numbers of the scenario. */\n\n\
                        #include <float.h>\n\n#include \"precess_fmu.h\"\n"
            .to_owned();
        let numbers = |values: &[f64]| values.iter().copied().map(number).collect::<Vec<_>>();
        for (declaration, elements) in [
            ("double precess_fmu_start[FMU_VALUES]", &numbers(start)),
            ("double precess_fmu_nominal[FMU_STATES]", &numbers(&self.nominals)),
            ("char *const precess_fmu_names[FMU_DEVICES + 1]", &self.names),
            ("struct precess_fmu_joint precess_fmu_joints[FMU_JOINTS]", &self.joints),
            ("struct precess_fmu_wrench precess_fmu_wrenches[FMU_WRENCHES + 1]", &self.wrenches),
        ] {
            // Writing into a text does not fail.
            let _ = write!(text, "\nconst {declaration} = {{\n    ");
            text += &elements.join(",\n    ");
            text += "\n};\n";
        }
        text
    }
}

/// `model.h`.
pub(super) fn header(layout: &Layout, constants: &Constants, token: &str) -> String {
    let Layout { wrenches, .. } = layout;
    let (driven, upper) = (layout.driven(), SOLVER.to_uppercase());
    let Constants { hub, field, .. } = constants;
    format!(
        "/* Written by `precess export fmu`: the solver, and what is fixed of the spacecraft. */\n\n\
         #ifndef MODEL_H\n#define MODEL_H\n\n#include \"{SOLVER}.h\"\n#include \"precess_wrap.h\"\n\n\
         #define FMU_SOLVER_PARAMETERS {SOLVER}_parameters\n\
         #define FMU_SOLVER_SPACECRAFT {SOLVER}_spacecraft\n\
         #define FMU_SOLVER_STATE {SOLVER}_state\n\
         #define FMU_SOLVER_INPUTS {SOLVER}_inputs\n\
         #define FMU_SOLVER_ACCELERATIONS {SOLVER}_accelerations\n\
         #define FMU_SOLVER_INIT {SOLVER}_init\n\
         #define FMU_SOLVER_EVALUATE {SOLVER}_accelerations\n\
         #define FMU_SOLVER_DIRECTION {SOLVER}_direction\n\
         #define FMU_SOLVER_JVP {SOLVER}_jvp\n\
         #define FMU_SOLVER_STEP {SOLVER}_step\n\
         #define FMU_SOLVER_WRAP {SOLVER}_wrap\n\
         #define FMU_DEVICES {upper}_DEVICES\n\
         #define FMU_JOINTS {upper}_JOINTS\n\
         #define FMU_DRIVEN {driven}\n\
         #define FMU_WRENCHES {wrenches}\n\
         #define FMU_HUB {hub}\n\
         #define FMU_FIELD {field}\n\
         #define FMU_TOKEN \"{token}\"\n\n#endif\n"
    )
}

/// The value of each place: those of the variables, and what is none.
pub(super) fn values(layout: &Layout, constants: &Constants, variables: &[Variable]) -> Vec<f64> {
    let mut values = vec![0.0; layout.length()];
    for (index, value) in constants.gravity.into_iter().enumerate() {
        if let Some(place) = values.get_mut(layout.parameter(GRAVITY + index)) {
            *place = value;
        }
    }
    for variable in variables {
        if let Some(place) = values.get_mut(variable.place) {
            *place = variable.start;
        }
    }
    values
}

/// A number of C with the same bits; infinity as the largest.
pub(super) fn number(value: f64) -> String {
    if value.is_infinite() {
        return if value > 0.0 { "DBL_MAX" } else { "-DBL_MAX" }.to_owned();
    }
    format!("{value:?}")
}
