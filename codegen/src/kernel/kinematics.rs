//! The kernels of kinematics: one per body, seen from B, and one for the device's centre of mass.
//!
//! Vectors of a body are expressed in the parent body's axes, as the paper prints them; angular
//! velocity and inertia in the body's own. Second derivatives are returned as what the
//! second-order states multiply and the remainder.

use super::function::inputs;
use super::{Claim, Kernel, Record};
use crate::derivation::chain::Chain;
use crate::derivation::chain::framed_value::FramedValue;
use crate::derivation::chain::motion::{Motion, Observer, motions};
use crate::derivation::heading::Heading;
use crate::derivation::recursions::composite;
use crate::derivation::reference::{BodyInHub, bodies};
use crate::derivation::script::{Script, pairs, sextuple, triple};
use crate::graph::{Expr, Node, Stage};
use crate::kinds;
use crate::space::{Frame, Hub, ParentFrame, Symmetric, Vector};

/// One kernel per body, then the centre of mass.
#[must_use]
pub(super) fn kernels<'g>(chain: &Chain<'g>) -> Vec<Kernel<'g>> {
    let seen_from_b = motions(chain, &Observer::on_hub(chain.graph));
    let references = bodies(chain);
    let mut list: Vec<_> = seen_from_b
        .iter()
        .zip(&references)
        .enumerate()
        .map(|(k, (motion, reference))| body(chain, k, motion, reference))
        .collect();
    list.push(first_moment(chain, &references));
    list
}

/// Statements, fields and claims of one kernel, built together. What is zero in every state of the
/// kind is claimed, but neither computed nor returned.
struct Builder<'g> {
    script: Script<'g>,
    record: Record,
    claims: Vec<Claim<'g>>,
}

impl<'g> Builder<'g> {
    fn new(chain: &Chain<'g>, record: Record) -> Self {
        Self { script: Script::new(chain.graph), record, claims: Vec::new() }
    }

    /// A vector: section, statements, fields, and what its components must be equal to.
    fn vector<F: Frame>(
        &mut self,
        [prefix, tag, stem, frame, unit]: [&str; 5],
        heading: Heading,
        v: Vector<'g, F>,
        reference: [Expr<'g>; 3],
    ) {
        let names = triple(stem, frame);
        if !v.components().into_iter().all(Expr::is_zero) {
            self.record.vector(stem, frame, &heading.label(), unit);
            self.script.section(prefix, heading.unit(unit));
            self.script.names(pairs(names.clone(), v.components()));
        }
        self.claim(tag, stem, pairs(names, reference).collect());
    }

    fn tensor<F: Frame>(
        &mut self,
        [prefix, tag, stem, unit]: [&str; 4],
        heading: Heading,
        t: Symmetric<'g, F>,
        reference: [Expr<'g>; 6],
    ) {
        let names = sextuple(stem);
        if !t.entries().into_iter().all(Expr::is_zero) {
            self.record.tensor(stem, &heading.label(), unit);
            self.script.section(prefix, heading.unit(unit));
            self.script.names(pairs(names.clone(), t.entries()));
        }
        self.claim(tag, stem, pairs(names, reference).collect());
    }

    fn claim(&mut self, tag: &str, name: &str, components: Vec<(String, Expr<'g>)>) {
        self.claims.push(Claim { tag: tag.to_owned(), name: name.to_owned(), components });
    }
}

/// Position, velocity, acceleration, angular velocity and inertia of one body, seen from B.
fn body<'g>(
    chain: &Chain<'g>,
    k: usize,
    motion: &Motion<'g>,
    reference: &BodyInHub<'g>,
) -> Kernel<'g> {
    let (link, data) = (&chain.links[k], &chain.kind.links[k].body);
    let (own, point) = (data.frame, data.point);
    let carrier = if k == 0 { "b" } else { chain.kind.links[k - 1].body.frame };
    let [body_letter, point_letter] = data.letters;
    let record = Record::new(&type_name(data.title), &format!("The {} seen from B.", data.title));
    let mut b = Builder::new(chain, record);
    // The same by plain differentiation in B, then expressed in the current axes.
    let vector = |v: Vector<'g, Hub>, frame: usize| match FramedValue::Vector(v.components(), 0)
        .along(chain, frame)
    {
        FramedValue::Vector(v, _) => Vector::<Hub>::new(v),
        _ => unreachable!("a vector stays a vector"),
    };
    let tensor =
        |t: Symmetric<'g, Hub>| match FramedValue::Tensor(t.entries(), 0).along(chain, k + 1) {
            FramedValue::Tensor(t, _) => t,
            _ => unreachable!("a tensor stays a tensor"),
        };
    let r_prime = reference.r.component_rates();

    let equations = &data.equations;
    let stem = format!("omega_{own}_b");
    let heading = Heading::new(format!("ω_{{{body_letter}/B}}")).equation(equations.omega);
    let omega = vector(reference.omega_b, k + 1).components();
    b.vector(["rate", equations.omega, &stem, own, "rad/s"], heading, motion.omega, omega);

    arm(&mut b.script, chain, k, motion);
    let r = format!("r_{point}_b");
    let tag = equations.r_dprime;
    let heading = Heading::new(format!("r_{{{point_letter}/B}}")).cited("see", tag);
    let whole = vector(reference.r, k).components();
    b.vector(["pos", "(step)", &r, carrier, "m"], heading, motion.centre.position, whole);
    let prime = format!("{r}_prime");
    let heading = Heading::new(format!("r′_{{{point_letter}/B}}")).cited("see", tag);
    let whole = vector(r_prime, k).components();
    b.vector(["vel", "(step)", &prime, carrier, "m/s"], heading, motion.centre.velocity, whole);

    let whole = vector(r_prime.component_rates(), k);
    let acceleration = motion.centre.acceleration;
    for (joint, data) in chain.links.iter().zip(chain.kind.links).take(k + 1) {
        let stem = format!("{r}_dprime_{}", data.joint.tag);
        let symbol = data.joint.symbols[1];
        let heading = Heading::new(format!("r″_{{{point_letter}/B}} per {symbol}")).equation(tag);
        let unit = match data.joint.motion {
            kinds::Motion::Turn(_) => "m",
            kinds::Motion::Slide(_) => "1",
        };
        let q_ddot = joint.acceleration;
        let per_joint = whole.partial(q_ddot).components();
        let names = ["col", tag, &stem, carrier, unit];
        b.vector(names, heading, acceleration.partial(q_ddot), per_joint);
    }
    let stem = format!("{r}_dprime_rest");
    let heading = format!("r″_{{{point_letter}/B}} with no joint accelerating");
    let heading = Heading::new(heading).equation(tag);
    let whole = whole.without(Stage::Acceleration).components();
    let rest = acceleration.without(Stage::Acceleration);
    b.vector(["acc", tag, &stem, carrier, "m/s²"], heading, rest, whole);

    let tensor_of = |what: String, numbers: &str| {
        Heading::new(what).equation(numbers).axes(format!("the axes of the {}", data.title))
    };
    let i_prime = link.inertia.prime(motion.axes);
    let stem = format!("i_{own}_{point}_prime");
    let heading = tensor_of(format!("[I_{{{body_letter},{point_letter}}}]′"), equations.i_prime);
    let whole = tensor(reference.inertia.component_rates());
    b.tensor(["turn", equations.i_prime, &stem, "kg m²/s"], heading, i_prime, whole);

    let r_own = motion.centre.position.turned(link.turn);
    let r_prime_own = motion.centre.velocity.turned(link.turn);
    let stem = format!("i_{own}_b");
    let heading = tensor_of(format!("[I_{{{body_letter},B}}]"), equations.i_b);
    let about_b = reference.inertia + reference.mass * Symmetric::tilde_squared(reference.r);
    let i_b = link.inertia + link.mass * Symmetric::tilde_squared(r_own);
    b.tensor(["axis", equations.i_b, &stem, "kg m²"], heading, i_b, tensor(about_b));
    let stem = format!("i_{own}_b_prime");
    let heading = tensor_of(format!("[I_{{{body_letter},B}}]′"), equations.i_b_prime);
    let whole = tensor(about_b.component_rates());
    let i_b_prime = i_prime + link.mass * Symmetric::tilde_pair(r_prime_own, r_own);
    b.tensor(["shift", equations.i_b_prime, &stem, "kg m²/s"], heading, i_b_prime, whole);

    Kernel {
        name: data.title.replace(' ', "_"),
        doc: vec![format!(
            "The {}: position, angular velocity, inertia and their derivatives.",
            data.title
        )],
        inputs: inputs(chain.kind, []),
        sections: b.script.sections,
        output: b.record,
        hoisted: true,
        claims: b.claims,
    }
}

/// Names the centre of mass from its joint's origin, as far as a component is a sum that is also a
/// part of an acceleration, after which it would otherwise be named.
fn arm<'g>(script: &mut Script<'g>, chain: &Chain<'g>, k: usize, motion: &Motion<'g>) {
    let (link, body) = (&chain.links[k], &chain.kind.links[k].body);
    let carrier = k.checked_sub(1).map_or("b", |parent| chain.kind.links[parent].body.frame);
    let acceleration = motion.centre.acceleration;
    let accelerations = chain.links.iter().map(|joint| joint.acceleration);
    let parts: Vec<_> =
        accelerations.flat_map(|q_ddot| acceleration.partial(q_ddot).components()).collect();
    let is_part = |e: Expr<'g>| {
        matches!(e.node(), Node::Sum(..)) && parts.iter().any(|part| *part == e || *part == -e)
    };
    let stem = format!("r_{}_{}", body.point, body.origin);
    let centre = link.centre.turned::<ParentFrame>(link.turn.inverse());
    let components = pairs(triple(&stem, carrier), centre.components());
    let named: Vec<_> = components.filter(|(_, component)| is_part(*component)).collect();
    if named.is_empty() {
        return;
    }
    let [origin, point] = body.letters;
    let equation = body.equations.r_dprime;
    let heading = Heading::new(format!("r_{{{point}/{origin}}}")).cited("as in", equation);
    script.section("arm", heading.unit("m"));
    script.names(named);
}

/// The device's share of `m_sc c` (9), of its derivatives (11), and the f of (17), expressed in B.
fn first_moment<'g>(chain: &Chain<'g>, references: &[BodyInHub<'g>]) -> Kernel<'g> {
    let graph = chain.graph;
    let observer = Observer::on_hub(graph);
    let joints = chain.kind.links.iter().map(|link| &link.joint);
    let terms: Vec<_> =
        joints.map(|joint| format!("mc_dprime_{} {}", joint.tag, joint.symbols[1])).collect();
    let record = Record::new(
        "FirstMoment",
        &format!(
            "A device's share of `m_sc c` and its derivatives seen from B, expressed in the \
             device's axes: `m_sc c″ = {} + f̃`.",
            terms.join(" + ")
        ),
    );
    let mut b = Builder::new(chain, record);
    let share = composite::share(chain, &observer, &mut b.script);
    let momenta = composite::momenta(chain, &observer, &mut b.script);
    let zero = Vector::zero(graph);
    let mc = references.iter().fold(zero, |sum, body| sum + body.mass * body.r);
    let mc_prime = mc.component_rates();
    let mc_dprime = mc_prime.component_rates();
    let heading = Heading::new("Σ m r, share of m_sc c").equation("(9)");
    let reference = mc.components();
    b.vector(["mom", "(9)", "mc", "b", "kg m"], heading, share.first_moment, reference);
    let heading = Heading::new("Σ m r′, share of m_sc c′").cited("see", "(11)");
    let reference = mc_prime.components();
    b.vector(["rate", "(step)", "mc_prime", "b", "kg m/s"], heading, momenta.linear, reference);
    for (k, data) in chain.kind.links.iter().enumerate() {
        // Expressed in the device's axes; expressed in B, the same is f of the system.
        let stem = format!("mc_dprime_{}", data.joint.tag);
        let (tag, symbol) = (data.joint.tag, data.joint.symbols[1]);
        let heading = Heading::new(format!("f_{tag} = Σ m r″ per {symbol}")).equation("(17)");
        let reference = mc_dprime.partial(chain.links[k].acceleration).components();
        let unit = data.joint.motion.units().force;
        b.vector(["col", "(17)", &stem, "b", unit], heading, share.force[k], reference);
    }
    let heading = Heading::new("f̃ = Σ m r″ with no joint accelerating").equation("(17)");
    let reference = mc_dprime.without(Stage::Acceleration).components();
    b.vector(["acc", "(17)", "f_tilde", "b", "N"], heading, share.bias_force, reference);
    Kernel {
        name: "first_moment".to_owned(),
        doc: vec!["Centre of mass of the device and its derivatives, seen from B.".to_owned()],
        inputs: inputs(chain.kind, []),
        sections: b.script.sections,
        output: b.record,
        hoisted: true,
        claims: b.claims,
    }
}

/// `outer gimbal` -> `OuterGimbal`.
fn type_name(title: &str) -> String {
    let capital = |word: &str| word[..1].to_uppercase() + &word[1..];
    title.split(' ').map(capital).collect()
}
