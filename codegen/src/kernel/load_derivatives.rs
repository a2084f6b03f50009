//! The kernel `load_derivatives`: inverse dynamics, differentiated.
//!
//! What the hub exerts on a device and what its motors exert depend on the device's own coordinates, rates and
//! accelerations and on the hub's motion. By an angle it is cos ∂/∂sin - sin ∂/∂cos; by accelerations it is the mass
//! matrix. The references are differentiated so, as sums over bodies along B; the statements are a recursion in local
//! frames, from the tip to the hub.

use super::function::{along_joint, inputs};
use super::{Claim, Kernel, Record, records};
use crate::derivation::chain::Chain;
use crate::derivation::chain::wrench::Wrench;
use crate::derivation::heading::Heading;
use crate::derivation::recursions::load_derivatives::{LoadDerivatives, load_derivatives};
use crate::derivation::reference::exerted;
use crate::derivation::script::{Script, triple};
use crate::graph::Expr;
use crate::kinds::{Kind, Motion};
use crate::space::Hub;

/// What a derivative is taken by: its name and how.
struct By<'g> {
    name: String,
    unit: &'static str,
    derivative: Box<dyn Fn(Expr<'g>) -> Expr<'g> + 'g>,
}

/// Derivatives of force and moment on the device, and of what its motors exert.
#[must_use]
pub(super) fn kernel<'g>(chain: &Chain<'g>) -> Kernel<'g> {
    let kind = chain.kind;
    let mut script = Script::new(chain.graph);
    let found = load_derivatives(chain, &mut script);
    let differentiated: Vec<_> = differentiated(kind);
    let variables = variables(chain);
    for (by, values) in variables.iter().zip(stated(chain, &found)) {
        let heading = Heading::new(format!("By {}", by.name)).cited("from", "(16), (75)");
        script.section("by", heading.note(format!("per {}", by.unit)));
        for ((name, ..), value) in differentiated.iter().zip(values) {
            script.name(derivative_name(name, &by.name), value);
        }
    }
    Kernel {
        name: "load_derivatives".to_owned(),
        doc: vec![
            "Derivatives of `loads`: of force and moment that the hub exerts on the device about B, and of"
                .into(),
            "what each motor exerts, by coordinates, rates and accelerations of the joints, by the hub's".into(),
            "angular velocity and by its angular acceleration.".into(),
        ],
        inputs: inputs(
            kind,
            [
                ("w", records::body_rate()),
                ("a", records::body_acceleration()),
                ("j", records::joint_accelerations(kind)),
            ],
        ),
        sections: script.sections,
        output: output(&differentiated, &variables),
        hoisted: false,
        claims: claims(chain, &differentiated, &variables),
    }
}

/// What is differentiated: its name in derivatives, the name that `loads` gives it, what it is.
fn differentiated(kind: &Kind) -> Vec<(String, String, String)> {
    let mut list = Vec::new();
    for (letter, what) in [('f', "Force on the device"), ('n', "Moment about B on the device")] {
        for name in triple(&format!("{letter}_load"), "b") {
            let axis = name.rsplit('_').next().unwrap_or_default().to_owned();
            list.push((format!("{letter}_{axis}"), name, format!("{what}, along {axis}")));
        }
    }
    list.extend(kind.driven().map(|link| {
        let doc = format!("What the motor of the {} exerts", link.body.title);
        (link.joint.torque.to_owned(), along_joint("load", link), doc)
    }));
    list
}

/// The derivatives by each of the variables, of what is differentiated.
fn stated<'g>(chain: &Chain<'g>, found: &LoadDerivatives<'g>) -> Vec<Vec<Expr<'g>>> {
    let moving = || (0..chain.links.len()).filter(|k| !chain.kind.links[*k].is_locked());
    let driven = || (0..chain.links.len()).filter(|k| chain.kind.links[*k].is_driven());
    let column = |load: &Wrench<'g, Hub>, motors: Vec<Expr<'g>>| {
        let load = load.force.components().into_iter().chain(load.moment.components());
        load.chain(motors).collect::<Vec<_>>()
    };
    let mut list = Vec::new();
    for part in 0..3 {
        list.extend(moving().map(|j| {
            let motors = driven().map(|k| found.motors[k][j].each()[part]);
            column(&found.by_joint[j].each()[part], motors.collect())
        }));
    }
    for (part, loads) in [&found.by_omega, &found.by_omega_dot].into_iter().enumerate() {
        list.extend(loads.iter().enumerate().map(|(axis, load)| {
            column(
                load,
                driven().map(|k| found.motors_by_hub[k][part].components()[axis]).collect(),
            )
        }));
    }
    list
}

fn derivative_name(of: &str, by: &str) -> String {
    format!("{of}_by_{by}")
}

/// Coordinates, rates and accelerations of the joints, angular velocity and acceleration of the hub.
fn variables<'g>(chain: &Chain<'g>) -> Vec<By<'g>> {
    let links = || chain.links.iter().zip(chain.kind.links).filter(|(_, data)| !data.is_locked());
    let mut list: Vec<_> = links()
        .map(|(link, data)| {
            let (coordinate, name) = (link.coordinate, data.joint.coordinate.to_owned());
            let unit = match data.joint.motion {
                Motion::Turn(_) => "rad",
                Motion::Slide(_) => "m",
            };
            By { name, unit, derivative: Box::new(move |e| coordinate.partial(e)) }
        })
        .collect();
    list.extend(links().map(|(link, data)| {
        let (rate, name) = (link.rate, data.joint.rate.to_owned());
        let unit = data.joint.motion.units().rate;
        By { name, unit, derivative: Box::new(move |e: Expr<'g>| e.partial(rate)) }
    }));
    list.extend(links().map(|(link, data)| {
        let (acceleration, name) = (link.acceleration, data.joint.acceleration.to_owned());
        let unit = data.joint.motion.units().acceleration;
        By { name, unit, derivative: Box::new(move |e: Expr<'g>| e.partial(acceleration)) }
    }));
    let hub = &chain.hub;
    for (v, stem, unit) in [(hub.omega, "omega", "rad/s"), (hub.omega_dot, "omega_dot", "rad/s²")]
    {
        list.extend(v.components().into_iter().zip(triple(stem, "b")).map(|(component, name)| {
            By { name, unit, derivative: Box::new(move |e: Expr<'g>| e.partial(component)) }
        }));
    }
    list
}

fn output(differentiated: &[(String, String, String)], variables: &[By<'_>]) -> Record {
    let doc = "Derivatives of the loads, expressed in the device's axes, moments about B.";
    let mut record = Record::new("LoadDerivatives", doc);
    for by in variables {
        for (name, _, what) in differentiated {
            let doc = format!("{what}, by `{}`.", by.name);
            record.field(derivative_name(name, &by.name), doc);
        }
    }
    record
}

fn claims<'g>(
    chain: &Chain<'g>,
    differentiated: &[(String, String, String)],
    variables: &[By<'g>],
) -> Vec<Claim<'g>> {
    let whole = exerted::whole(chain);
    let motors = exerted::motors(chain).into_iter().zip(chain.kind.links);
    let mut references: Vec<_> = whole.force.components().into();
    references.extend(whole.moment.components());
    references.extend(motors.filter(|(_, link)| link.is_driven()).map(|(torque, _)| torque));
    let claim = |by: &By<'g>| {
        let components = differentiated.iter().zip(&references).map(|((name, ..), reference)| {
            (derivative_name(name, &by.name), (by.derivative)(*reference))
        });
        let name = format!("loads by {}", by.name);
        Claim { tag: "(16), (75)".to_owned(), name, components: components.collect() }
    };
    variables.iter().map(claim).collect()
}
