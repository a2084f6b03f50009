//! Where one kind is the limit of another, its equations are the limits of the other's: term by
//! term, by normal form. Both sides are sums over bodies, derived for each kind by itself.

use std::collections::BTreeSet;
use std::rc::Rc;

use precess_codegen::derivation::chain::Chain;
use precess_codegen::derivation::reference::{momenta, share};
use precess_codegen::graph::{Expr, Graph, Node, Stage};
use precess_codegen::kinds::{
    BALANCED_DGCMG, BALANCED_DGVSCMG, BALANCED_REACTION_WHEEL, BALANCED_SGCMG, BALANCED_VSCMG,
    DGCMG, DGVSCMG, HINGED_PANEL, Kind, REACTION_WHEEL, SGCMG, SLOSH_MASS, VSCMG,
};
use precess_codegen::normal::{Polynomial, Ring};
use precess_codegen::space::{ENTRIES, Vector};

/// A kind, the joints that are left of it, and what its symbols become: a number, or a sum of
/// symbols.
struct Limit {
    kind: &'static Kind,
    joints: &'static [usize],
    values: Vec<(String, String)>,
}

impl Limit {
    fn new(kind: &'static Kind, joints: &'static [usize]) -> Self {
        Self { kind, joints, values: Vec::new() }
    }

    fn with(mut self, symbol: &str, value: &str) -> Self {
        self.values.push((symbol.to_owned(), value.to_owned()));
        self
    }

    /// Every symbol of a stem by its endings, likewise named on both sides.
    fn renamed(self, from: &str, to: &str, endings: &[&str]) -> Self {
        let rename =
            |limit: Self, end: &&str| limit.with(&format!("{from}{end}"), &to.replace("..", end));
        endings.iter().fold(self, rename)
    }

    /// No mass, no inertia.
    fn massless(self, mass: &str, inertia: &str) -> Self {
        self.with(mass, "0").renamed(&format!("{inertia}_"), "0", &ENTRIES)
    }

    /// Held where its axes are those of the parent body.
    fn locked(self, angle: &str, rate: &str) -> Self {
        let held = self.with(&format!("sin_{angle}"), "0").with(&format!("cos_{angle}"), "1");
        held.with(rate, "0")
    }

    fn angle(self, from: &str, to: &str) -> Self {
        let renamed = self.renamed("sin_", &format!("sin_{to}"), &[from]);
        renamed.renamed("cos_", &format!("cos_{to}"), &[from])
    }

    /// Terms of every block of the mass matrix, of the bias, and of energy and momenta.
    fn blocks(&self) -> Vec<BTreeSet<String>> {
        let graph = Graph::new();
        let chain = Chain::new(&graph, self.kind);
        // The one angle that is called otherwise in another kind.
        let _ = graph.angle("gamma", graph.symbol("gamma_dot", Stage::Rate));
        let values: Vec<_> = self.values.iter().map(|value| replaced(&graph, value)).collect();
        let (share, momenta) = (share(&chain), momenta(&chain));
        let mut all = vec![share.mass, momenta.energy];
        let hub = [share.first_moment, share.bias_force, share.bias_moment];
        all.extend(
            [momenta.linear, momenta.angular].into_iter().chain(hub).flat_map(Vector::components),
        );
        all.extend(share.inertia.entries());
        for (place, &i) in self.joints.iter().enumerate() {
            all.extend([share.force[i], share.moment[i]].into_iter().flat_map(Vector::components));
            all.push(share.bias_joint[i]);
            all.extend(self.joints[place..].iter().map(|&j| share.joint[i][j - i]));
        }
        let mut ring = Ring::new(&graph);
        let normals = all.into_iter().map(|e| ring.normal(e.with(&values)).unwrap());
        let normals: Vec<_> = normals.collect();
        let terms = |normal: &Rc<Polynomial>| {
            normal.terms().map(|(monomial, k)| ring.show(monomial, *k)).collect()
        };
        normals.iter().map(terms).collect()
    }
}

fn replaced<'g>(
    graph: &'g Graph,
    (symbol, value): &(String, String),
) -> (precess_codegen::graph::SymbolId, Expr<'g>) {
    let replaced = graph.find(symbol).unwrap_or_else(|| panic!("`{symbol}` is no symbol"));
    let Node::Symbol(id) = replaced.node() else { unreachable!("a symbol is a symbol") };
    let stage = graph.symbol_info(id).stage;
    let summand = |text: &str| match text.parse::<i64>() {
        Ok(number) => graph.constant(number),
        Err(_) => graph.symbol(text, stage),
    };
    (id, value.split(" + ").map(summand).reduce(|sum, summand| sum + summand).unwrap())
}

#[track_caller]
fn assert_same(wide: &Limit, narrow: &Limit) {
    let (wide, narrow) = (wide.blocks(), narrow.blocks());
    assert_eq!(wide.len(), narrow.len());
    assert!(narrow.iter().map(BTreeSet::len).sum::<usize>() > 50, "there is something to compare");
    for (block, (wide, narrow)) in wide.iter().zip(&narrow).enumerate() {
        assert_eq!(wide, narrow, "block {block}");
    }
}

#[test]
fn a_vscmg_is_a_dgvscmg_with_its_inner_gimbal_massless_and_locked() {
    let wide =
        Limit::new(&DGVSCMG, &[0, 2]).massless("m_gi", "i_gi").locked("gamma_i", "gamma_i_dot");
    let wide = wide.angle("gamma_o", "gamma").with("gamma_o_dot", "gamma_dot").with("m_go", "m_g");
    let wide = wide.renamed("i_go_", "i_g_..", &ENTRIES);
    let wide = wide.renamed("r_go_b_b", "r_g_b_b..", &["x", "y", "z"]);
    let wide = wide.renamed("r_goc_go_go", "r_gc_g_g..", &["x", "y", "z"]);
    let narrow = Limit::new(&VSCMG, &[0, 1]).renamed("l_g_", "l_o_.. + l_i_..", &["x", "y", "z"]);
    assert_same(&wide, &narrow);
}

#[test]
fn a_reaction_wheel_is_a_vscmg_with_its_gimbal_massless_and_locked() {
    let wide = Limit::new(&VSCMG, &[1]).massless("m_g", "i_g").locked("gamma", "gamma_dot");
    let narrow = Limit::new(&REACTION_WHEEL, &[0]);
    let narrow = narrow.renamed("r_w_b_b", "r_g_b_b.. + l_g_..", &["x", "y", "z"]);
    assert_same(&wide, &narrow);
}

/// (18): d = 0, no products, a symmetric rotor. The angle drops out of the imbalanced side.
#[test]
fn a_balanced_kind_is_its_imbalanced_twin_without_imbalance() {
    let twins: [(_, _, &[usize]); 5] = [
        (&REACTION_WHEEL, &BALANCED_REACTION_WHEEL, &[0]),
        (&VSCMG, &BALANCED_VSCMG, &[0, 1]),
        (&SGCMG, &BALANCED_SGCMG, &[0, 1]),
        (&DGVSCMG, &BALANCED_DGVSCMG, &[0, 1, 2]),
        (&DGCMG, &BALANCED_DGCMG, &[0, 1, 2]),
    ];
    for (imbalanced, balanced, joints) in twins {
        let wide = Limit::new(imbalanced, joints).with("d", "0").with("j_33", "j_22");
        let wide = wide.renamed("j_", "0", &["12", "13", "23"]);
        assert_same(&wide, &Limit::new(balanced, joints));
    }
}

/// Only what is solved for differs: every block is the same, those of the wheel's joint included. What
/// the elimination makes of them is held against the joint's mode in the tests of modes.
#[test]
fn a_prescribed_wheel_leaves_every_block_as_it_is() {
    assert_same(&Limit::new(&VSCMG, &[0, 1]), &Limit::new(&SGCMG, &[0, 1]));
    assert_same(&Limit::new(&DGVSCMG, &[0, 1, 2]), &Limit::new(&DGCMG, &[0, 1, 2]));
}

#[test]
fn a_hinged_panel_is_a_gimbal_that_carries_nothing() {
    let wide = Limit::new(&VSCMG, &[0]).massless("m_w", "j").locked("theta", "spin");
    let narrow = Limit::new(&HINGED_PANEL, &[0]).angle("phi", "gamma").with("phi_dot", "gamma_dot");
    let narrow = narrow.with("m_p", "m_g").renamed("i_p_", "i_g_..", &ENTRIES);
    let narrow = narrow.renamed("r_p_b_b", "r_g_b_b..", &["x", "y", "z"]);
    assert_same(&wide, &narrow.renamed("r_pc_p_p", "r_gc_g_g..", &["x", "y", "z"]));
}

/// A point mass that is held is a panel without extent that is held: what reaches the hub is equal.
#[test]
fn a_slosh_mass_that_is_held_is_a_point_fixed_in_the_hub() {
    let wide = Limit::new(&HINGED_PANEL, &[]).locked("phi", "phi_dot").with("m_p", "m_s");
    let wide = wide.renamed("i_p_", "0", &ENTRIES).renamed("r_pc_p_p", "0", &["x", "y", "z"]);
    let wide = wide.renamed("r_p_b_b", "r_s_b_b..", &["x", "y", "z"]);
    let narrow = Limit::new(&SLOSH_MASS, &[]).with("x", "0").with("x_dot", "0");
    assert_same(&wide, &narrow);
}

/// Newton's second law along the joint, and what the hub feels of it.
#[test]
fn a_slosh_mass_obeys_newton_along_its_joint() {
    let graph = Graph::new();
    let chain = Chain::new(&graph, &SLOSH_MASS);
    let [m, x] = ["m_s", "x"].map(|name| graph.find(name).unwrap());
    let zero = graph.zero();
    let axis = Vector::new([graph.constant(1), zero, zero]);
    let place = ["r_s_b_bx", "r_s_b_by", "r_s_b_bz"].map(|name| graph.find(name).unwrap());
    let (r, omega) = (Vector::new(place) + x * axis, chain.hub.omega);
    let share = share(&chain);
    let centrifugal = omega.cross(omega.cross(r));
    let mut pairs = vec![(share.joint[0][0], m), (share.bias_joint[0], m * axis.dot(centrifugal))];
    let vectors = [(share.force[0], m * axis), (share.moment[0], m * r.cross(axis))];
    pairs.extend(
        vectors.into_iter().flat_map(|(a, b)| a.components().into_iter().zip(b.components())),
    );
    let mut ring = Ring::new(&graph);
    for (derived, stated) in pairs {
        assert_eq!(ring.normal(derived), ring.normal(stated));
    }
}
