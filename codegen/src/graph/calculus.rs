//! Time derivative, partial derivative, substitution by zero, evaluation: one loop each.

use rustc_hash::FxHashMap;

use super::{Expr, Graph, Node, NodeId, Stage, SymbolId, float};

impl Graph {
    /// What becomes of every node that `roots` are made of when each symbol is replaced of which
    /// `value` says something.
    pub(crate) fn rebuilt<'g>(
        &'g self,
        roots: impl IntoIterator<Item = NodeId>,
        mut value: impl FnMut(SymbolId) -> Option<Expr<'g>>,
    ) -> FxHashMap<NodeId, Expr<'g>> {
        self.rebuilt_in(self, roots, |symbol| value(symbol).unwrap_or_else(|| self.named(symbol)))
    }

    /// What every node that `roots` are made of is in `graph`, where `value` says what each symbol
    /// is.
    pub(crate) fn rebuilt_in<'g>(
        &self,
        graph: &'g Graph,
        roots: impl IntoIterator<Item = NodeId>,
        mut value: impl FnMut(SymbolId) -> Expr<'g>,
    ) -> FxHashMap<NodeId, Expr<'g>> {
        let mut made: FxHashMap<NodeId, Expr<'g>> = FxHashMap::default();
        for id in self.reachable(roots) {
            let new = match self.node(id) {
                Node::Constant(constant) => graph.constant(constant),
                Node::Symbol(symbol) => value(symbol),
                Node::Sum(a, b) => made[&a] + made[&b],
                Node::Product(a, b) => made[&a] * made[&b],
                Node::Neg(a) => -made[&a],
                Node::Recip(a) => made[&a].recip(),
            };
            made.insert(id, new);
        }
        made
    }
}

impl<'g> Expr<'g> {
    /// `d self / dt`, by the rates of the symbols.
    ///
    /// # Panics
    /// When a symbol without a stated rate is met: the derivation differentiates once too often.
    #[must_use]
    pub fn time_derivative(self) -> Self {
        self.derivative(|graph, symbol| {
            let info = graph.symbol_info(symbol);
            graph.expr(info.rate.unwrap_or_else(|| panic!("`{}` has no stated rate", info.name)))
        })
    }

    /// `d self / d x` for a symbol `x`, all other symbols held.
    #[must_use]
    pub fn partial(self, x: Self) -> Self {
        self.derivative(|graph, symbol| graph.constant(i64::from(x.node() == Node::Symbol(symbol))))
    }

    /// `self` with every symbol of `stage` set to zero.
    #[must_use]
    pub fn without(self, stage: Stage) -> Self {
        let graph = self.graph;
        self.rebuild(|symbol| (graph.symbol_info(symbol).stage == stage).then(|| graph.zero()))
    }

    /// `self` with the symbols of a list replaced, all at once.
    #[must_use]
    pub fn with(self, values: &[(SymbolId, Self)]) -> Self {
        self.rebuild(|symbol| {
            let given = values.iter().find(|(replaced, _)| *replaced == symbol);
            given.map(|(_, value)| *value)
        })
    }

    /// `self` with every symbol replaced of which `value` says something.
    #[must_use]
    pub fn rebuild(self, value: impl FnMut(SymbolId) -> Option<Self>) -> Self {
        self.graph.rebuilt([self.id], value)[&self.id]
    }

    fn derivative(self, mut rate: impl FnMut(&'g Graph, SymbolId) -> Expr<'g>) -> Self {
        let graph = self.graph;
        let mut made: FxHashMap<NodeId, Self> = FxHashMap::default();
        for id in graph.reachable([self.id]) {
            let e = |id| graph.expr(id);
            let new = match graph.node(id) {
                Node::Constant(_) => graph.zero(),
                Node::Symbol(symbol) => rate(graph, symbol),
                Node::Sum(a, b) => made[&a] + made[&b],
                Node::Product(a, b) => made[&a] * e(b) + e(a) * made[&b],
                Node::Neg(a) => -made[&a],
                Node::Recip(a) => -(made[&a] * e(id).squared()),
            };
            made.insert(id, new);
        }
        made[&self.id]
    }

    /// The value of `self` in floating point.
    #[must_use]
    pub fn evaluate(self, value: &dyn Fn(&str) -> f64) -> f64 {
        let graph = self.graph;
        let mut made: FxHashMap<NodeId, f64> = FxHashMap::default();
        for id in graph.reachable([self.id]) {
            let new = match graph.node(id) {
                Node::Constant(k) => float(k),
                Node::Symbol(symbol) => value(&graph.symbol_info(symbol).name),
                Node::Sum(a, b) => made[&a] + made[&b],
                Node::Product(a, b) => made[&a] * made[&b],
                Node::Neg(a) => -made[&a],
                Node::Recip(a) => made[&a].recip(),
            };
            made.insert(id, new);
        }
        made[&self.id]
    }

    /// The latest stage among the symbols of `self`.
    #[must_use]
    pub fn stage(self) -> Stage {
        let graph = self.graph;
        let stages = graph.reachable([self.id]).into_iter().filter_map(|id| match graph.node(id) {
            Node::Symbol(symbol) => Some(graph.symbol_info(symbol).stage),
            _ => None,
        });
        stages.max().unwrap_or(Stage::Parameter)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::RULES;

    fn sample(name: &str) -> f64 {
        name.bytes().fold(0.37, |x, byte| (x * 3.1 + f64::from(byte)).sin() + 1.3)
    }

    #[test]
    fn every_rule_keeps_the_value() {
        let g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Stage::Rate));
        let (x, y) = (sample("a"), sample("b"));
        let k = |value: i64| g.constant(value);
        let sides = [
            ("fold_sum", k(2) + k(3), 5.0),
            ("zero_plus", k(0) + a, x),
            ("opposites", a + -a, 0.0),
            ("neg_out_of_sum", -a + -b, -(x + y)),
            ("fold_product", k(2) * k(3), 6.0),
            ("zero_times", k(0) * a, 0.0),
            ("one_times", k(1) * a, x),
            ("minus_one_times", k(-1) * a, -x),
            ("two_times", k(2) * a, x + x),
            ("neg_out_of_product", -a * b, -(x * y)),
            ("gather", k(3) * (k(5) * a), 15.0 * x),
            ("fold_neg", -k(4), -4.0),
            ("double_neg", -(-a), x),
            ("fold_recip", k(4).recip(), 0.25),
            ("double_recip", a.recip().recip(), x),
        ];
        assert_eq!(sides.map(|side| side.0), RULES.map(|rule| rule.0), "a rule is untested");
        for (rule, built, value) in sides {
            let error = (built.evaluate(&sample) - value).abs();
            assert!(error <= 4.0 * f64::EPSILON * value.abs(), "{rule}: off by {error:e}");
        }
    }

    #[test]
    fn every_rule_fires() {
        let g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Stage::Rate));
        let k = |value: i64| g.constant(value);
        assert_eq!(k(2) + k(3), k(5));
        assert_eq!(k(0) + a, a);
        assert_eq!(a + -a, k(0));
        assert_eq!(-a + -b, -(a + b));
        assert_eq!(k(0) * a, k(0));
        assert_eq!(k(1) * a, a);
        assert_eq!(k(-1) * a, -a);
        assert_eq!(k(2) * a, a + a);
        assert_eq!(-a * b, -(a * b));
        assert_eq!(k(3) * (k(5) * a), k(15) * a);
        assert_eq!(-(-a), a);
        assert_eq!(k(4).recip() * k(4), k(1));
        assert_eq!(a.recip().recip(), a);
    }

    #[test]
    fn time_derivative_agrees_with_a_difference() {
        let g = Graph::new();
        let rate = g.symbol("rate", Stage::Rate);
        g.set_rate(rate, g.symbol("accel", Stage::Acceleration));
        let (s, c) = g.angle("q", rate);
        let e = (s * rate + c.squared()) * (c + g.constant(3)).recip();
        let at = |t: f64| {
            move |name: &str| {
                let q = 0.3 + 0.7 * t + 0.2 * t * t;
                match name {
                    "sin_q" => q.sin(),
                    "cos_q" => q.cos(),
                    "rate" => 0.7 + 0.4 * t,
                    "accel" => 0.4,
                    other => panic!("{other}"),
                }
            }
        };
        let h = 1e-5;
        let difference = (e.evaluate(&at(h)) - e.evaluate(&at(-h))) / (2.0 * h);
        // Central difference: error h^2 times a third derivative of order one, plus rounding eps/h.
        assert!((e.time_derivative().evaluate(&at(0.0)) - difference).abs() < 1e-9);
    }

    #[test]
    fn a_parameter_does_not_change() {
        let g = Graph::new();
        let m = g.symbol("m", Stage::Parameter);
        assert!(m.squared().time_derivative().is_zero());
        assert_eq!(m.stage(), Stage::Parameter);
    }
}
