//! The joints eliminated into the hub's six equations: symmetric, from the tip, no square root.
//!
//! With `d` the pivot of joint j, `g_x = M_xj / d` its gains and `q = h_j / d` its acceleration
//! with all else at rest, every entry of the rest becomes `M_xy - g_x M_jy` and every right side
//! `h_x - M_xj q`. This is `M = L D L^T` with the gains for L; the proof multiplies the emitted
//! factors out again and does not use this file.
//!
//! Of a joint whose axis can be parallel to the tip's, the diagonal entry is another form of the same,
//! without a difference of large numbers there: see [`super::chain::parallel_axes`].
//!
//! A joint's mode is data. Where its acceleration is given instead of its torque, its gains are
//! zero and `q` is what is given: the same statements, with the weight `driven` zero. `held` is one
//! then, so that the reciprocal of an unused pivot is finite. A joint whose acceleration the kind
//! prescribes has no row.

use super::chain::{Chain, Mode};
use super::heading::Heading;
use super::script::Script;
use super::share::Share;
use crate::graph::Expr;
use crate::kinds::{cited, units};
use crate::space::Vector;

/// Suffixes of the six hub unknowns: acceleration of B, angular acceleration.
pub const HUB: [&str; 6] = ["v1", "v2", "v3", "w1", "w2", "w3"];

/// The quantity of the section with which the elimination begins.
const RIGHT_SIDE: &str = "Right side of each joint row";

/// Whether a section is of the elimination, or of the back substitution that follows it.
#[must_use]
pub fn is_of_elimination(heading: &Heading) -> bool {
    let ours = ["(D10)", "(D11)", "(D12)", "(D13)"];
    let cited = heading.equations().iter().any(|equation| ours.contains(&equation.as_str()));
    cited || heading.quantity() == RIGHT_SIDE
}

/// A name and its value.
pub type Entry<'g> = (String, Expr<'g>);

/// One joint after its elimination.
pub struct Pivot<'g> {
    /// The joint's tag.
    pub tag: &'static str,
    /// The pivot by the name of its entry.
    pub pivot: Entry<'g>,
    /// The same entry before anything was eliminated.
    pub diagonal: Entry<'g>,
    /// One per hub unknown, then one per inboard joint.
    pub gains: Vec<Entry<'g>>,
    /// The joint's acceleration with all else at rest, or the one it is given.
    pub free: Entry<'g>,
    divisor: Expr<'g>,
    couplings: Vec<Expr<'g>>,
}

/// What the elimination yields.
pub struct Eliminated<'g> {
    /// From the tip inwards.
    pub pivots: Vec<Pivot<'g>>,
}

/// One joint's current row: couplings to hub and inboard joints, diagonal, right side.
struct JointRow<'g> {
    joint: usize,
    tag: &'static str,
    /// Of the diagonal.
    unit: &'static str,
    couplings: Vec<Entry<'g>>,
    diagonal: Entry<'g>,
    right: Entry<'g>,
    mode: Mode<'g>,
}

/// Eliminates the joints of `share`, whose entries are symbols, writing the steps to `script`.
#[must_use]
pub fn eliminate<'g>(
    chain: &Chain<'g>,
    share: &Share<'g>,
    script: &mut Script<'g>,
) -> Eliminated<'g> {
    let mut rows = rows(chain, share, script);
    let diagonals: Vec<_> = rows.iter().map(|row| row.diagonal.clone()).collect();
    let mut made = Eliminated { pivots: Vec::new() };
    let mut done = String::new();
    while let Some(row) = rows.pop() {
        // With nothing eliminated before it, the tip.
        let across = share.perpendicular.filter(|_| done.is_empty());
        let diagonal = diagonals[rows.len()].clone();
        let pivot = gains(&row, &rows, diagonal, across.is_some(), script);
        done.push_str(pivot.tag);
        let what = format!("Joint {} eliminated from the rows of the inboard joints", pivot.tag);
        script.section("rest", Heading::new(what).equation("(D11)"));
        for (l, inner) in rows.iter_mut().enumerate() {
            let (gain, coupling) = (pivot.gains[HUB.len() + l].1, pivot.couplings[HUB.len() + l]);
            let across = across.filter(|across| inner.joint == across.joints.inner);
            let own = across.map_or(inner.diagonal.1 - gain * coupling, |across| {
                // Of a joint whose acceleration is given, nothing is subtracted: its divisor is one.
                let held = row.mode.held * (coupling * pivot.divisor.recip());
                let tip = across.coupling - held;
                across.diagonal - across.joints.cosine * tip - gain * across.coupling
            });
            let right = inner.right.1 - coupling * pivot.free.1;
            let others: Vec<_> = inner.couplings.iter().zip(&pivot.couplings).collect();
            let others = others.into_iter().map(|(entry, other)| entry.1 - gain * *other);
            let new: Vec<_> = others.chain([own, right]).collect();
            let entries = inner.couplings.iter_mut();
            let entries = entries.chain([&mut inner.diagonal, &mut inner.right]);
            for (entry, new) in entries.zip(new) {
                entry.1 = script.cut(format!("{}_{done}", entry.0), new);
            }
        }
        made.pivots.push(pivot);
    }
    hub(share, &made, script);
    made
}

/// The rows of the joints with a motor, with right sides `u - u_rest`.
fn rows<'g>(chain: &Chain<'g>, share: &Share<'g>, script: &mut Script<'g>) -> Vec<JointRow<'g>> {
    let kind = chain.kind;
    let equations = cited(kind.driven(), |equations| equations.torque);
    let heading = Heading::new(RIGHT_SIDE).equation(&equations);
    let unit = units(kind.driven(), |units| units.drive);
    script.section("tau", heading.part("motor torque less bias", unit));
    let tag = |k: usize| kind.links[k].joint.tag;
    let modes = chain.links.iter().enumerate().filter_map(|(k, link)| Some((k, link.mode?)));
    let modes: Vec<_> = modes.collect();
    let row = |(place, &(k, mode)): (usize, &(usize, Mode<'g>))| {
        let own = tag(k);
        let right = chain.links[k].torque - share.bias_joint[k];
        let hub = share.force[k].components().into_iter().chain(share.moment[k].components());
        let names = ["f", "n"]
            .into_iter()
            .flat_map(|block| ["bx", "by", "bz"].map(|axis| format!("{block}_{own}_{axis}")));
        let nearer = modes[..place].iter().map(|&(i, _)| i);
        let inner = nearer.map(|i| (format!("mass_{}{own}", tag(i)), share.joint[i][k - i]));
        JointRow {
            joint: k,
            tag: own,
            unit: kind.links[k].joint.motion.units().pivot,
            couplings: names.zip(hub).chain(inner).collect(),
            diagonal: (format!("mass_{own}{own}"), share.joint[k][0]),
            right: (format!("tau_{own}"), script.cut(format!("tau_{own}"), right)),
            mode,
        }
    };
    modes.iter().enumerate().map(row).collect()
}

/// Pivot, gains and free acceleration of one joint. Where another's axis can be parallel to it, the
/// divisor is one if the acceleration is given: it divides what is then left out.
fn gains<'g>(
    row: &JointRow<'g>,
    inner: &[JointRow<'g>],
    diagonal: Entry<'g>,
    across: bool,
    script: &mut Script<'g>,
) -> Pivot<'g> {
    let tag = row.tag;
    let pivot = match row.diagonal.1.node() {
        // A parameter that is an entry by itself goes by the entry's name.
        crate::graph::Node::Symbol(symbol) => {
            let name = row.diagonal.1.graph().symbol_info(symbol).name;
            let entry = name.starts_with(&row.diagonal.0);
            (if entry { name } else { row.diagonal.0.clone() }, row.diagonal.1)
        }
        _ => row.diagonal.clone(),
    };
    let heading =
        Heading::new(format!("Joint {tag}")).equation("(D10)").part("its pivot", row.unit);
    script.section("gain", heading.part("gains", ""));
    let Mode { driven, held, given } = row.mode;
    let own = if across { driven * pivot.1 } else { pivot.1 };
    let divisor = script.cut(format!("divisor_{tag}"), own + held);
    let recip = driven * divisor.recip();
    script.name(format!("recip_{tag}"), recip);
    let suffixes = HUB.into_iter().chain(inner.iter().map(|row| row.tag));
    let gains: Vec<_> = suffixes
        .zip(&row.couplings)
        .map(|(suffix, (_, value))| (format!("gain_{tag}_{suffix}"), *value * recip))
        .collect();
    script.names(gains.iter().cloned());
    let name = format!("free_{tag}");
    let free = (name.clone(), script.cut(name, row.right.1 * recip + given));
    Pivot {
        tag,
        pivot,
        diagonal,
        divisor,
        gains,
        free,
        couplings: row.couplings.iter().map(|coupling| coupling.1).collect(),
    }
}

/// What the joints subtract from the hub's block and from its right side.
fn hub<'g>(share: &Share<'g>, made: &Eliminated<'g>, script: &mut Script<'g>) {
    for (block, rows, columns) in [("vv", 0..3, 0..3), ("vw", 0..3, 3..6), ("ww", 3..6, 3..6)] {
        let heading = Heading::new("Subtracted from the hub's mass matrix").equation("(D12)");
        script.section("hub", heading.part(format!("M_{block}"), ""));
        for (row, column) in rows.flat_map(|row| columns.clone().map(move |column| (row, column))) {
            if column >= row {
                let taken = |pivot: &Pivot<'g>| pivot.gains[row].1 * pivot.couplings[column];
                let name = format!("m_{block}_{}{}", row % 3 + 1, column % 3 + 1);
                script.name(name, made.taken(share.mass.graph().zero(), taken));
            }
        }
    }
    let heading = Heading::new("Subtracted from the hub's right side").equation("(D12)");
    script.section("hub", heading.wrench(["N", "N m"], "B"));
    let rest = [share.bias_force, share.bias_moment].map(Vector::components).concat();
    for (row, rest) in rest.into_iter().enumerate() {
        let name = format!("h_{}_{}", ["v", "w"][row / 3], row % 3 + 1);
        script.name(name, made.taken(rest, |pivot| pivot.couplings[row] * pivot.free.1));
    }
}

impl<'g> Eliminated<'g> {
    /// `rest` and what each joint subtracts.
    fn taken(&self, rest: Expr<'g>, taken: impl Fn(&Pivot<'g>) -> Expr<'g>) -> Expr<'g> {
        self.pivots.iter().fold(rest, |sum, pivot| sum + taken(pivot))
    }
}
