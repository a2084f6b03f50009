//! Expression to polynomial: the variables, the reductions, and a memory of what was expanded.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::rc::Rc;

use rustc_hash::FxHashMap;

use super::polynomial::{Monomial, Polynomial, Sum, VARIABLES};
use crate::graph::{Expr, Graph, Node, NodeId, Rational, SymbolId, rational};

/// Why an expression has no normal form here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NormalError {
    /// The reciprocal of something that is not a symbol.
    Reciprocal,
    /// More variables than a monomial holds.
    Variables(usize),
    /// A power higher than a monomial holds.
    Exponent,
    /// A coefficient larger than can be calculated with.
    Coefficient,
}

impl fmt::Display for NormalError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reciprocal => {
                write!(f, "the reciprocal of a compound expression has no normal form; name it")
            }
            Self::Exponent => write!(f, "a product has a power above 15; lower it"),
            Self::Coefficient => {
                write!(f, "a coefficient with a part of 2^31 or more; use smaller constants")
            }
            Self::Variables(bound) => {
                write!(f, "more than {bound} variables in one proof; split it at named quantities")
            }
        }
    }
}

impl std::error::Error for NormalError {}

#[derive(Clone, Copy, PartialEq, Eq, Hash)]
enum Variable {
    Symbol(SymbolId),
    Recip(SymbolId),
}

#[derive(Clone)]
enum Reduction {
    /// `s^2 -> 1 - c^2`, by indices of the variables.
    Square { sin: usize, cos: usize },
    /// `y (1/y) -> 1`.
    Inverse { symbol: usize, recip: usize },
    /// `lead (1/y) -> 1 - sum of others (1/y)`, for `y = lead + others`.
    Share { recip: usize, lead: usize, others: Vec<usize> },
}

/// A power of a symbol or of its reciprocal.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Factor {
    /// Whether it is below the line.
    pub recip: bool,
    /// The symbol.
    pub name: String,
    /// The power.
    pub exponent: u32,
}

/// Expands expressions of one graph over a set of variables that grows as they are met.
pub struct Ring<'g> {
    pub(crate) graph: &'g Graph,
    variables: Vec<Variable>,
    index: FxHashMap<Variable, usize>,
    reductions: Vec<Reduction>,
    expanded: BTreeMap<NodeId, Rc<Polynomial>>,
    /// The next node when [`Ring::settle`] was first called.
    settled: Option<NodeId>,
}

impl<'g> Ring<'g> {
    /// A ring without variables yet.
    #[must_use]
    pub fn new(graph: &'g Graph) -> Self {
        Self {
            graph,
            variables: Vec::new(),
            index: FxHashMap::default(),
            reductions: Vec::new(),
            expanded: BTreeMap::new(),
            settled: None,
        }
    }

    /// The normal form of `e`.
    ///
    /// # Errors
    /// When `e` holds the reciprocal of a compound expression, or too many variables.
    pub fn normal(&mut self, e: Expr<'g>) -> Result<Rc<Polynomial>, NormalError> {
        for id in self.unexpanded(e.id()) {
            let polynomial = Rc::new(self.expand(id)?);
            self.expanded.insert(id, polynomial);
        }
        Ok(self.expanded[&e.id()].clone())
    }

    /// Keeps what is expanded now, and from the second call on forgets what came after the first:
    /// for comparing many variants of one text.
    pub fn settle(&mut self) {
        let mark = *self.settled.get_or_insert(self.graph.next());
        self.expanded.split_off(&mark);
    }

    /// What `root` is made of and has not been expanded yet, operands before their users.
    fn unexpanded(&self, root: NodeId) -> BTreeSet<NodeId> {
        let mut found = BTreeSet::new();
        let mut pending = vec![root];
        while let Some(id) = pending.pop() {
            if !self.expanded.contains_key(&id) && found.insert(id) {
                match self.graph.node(id) {
                    Node::Sum(..) | Node::Neg(_) => {
                        pending.extend(self.summands(id).into_iter().map(|(_, summand)| summand));
                    }
                    node => pending.extend(node.operands()),
                }
                pending.extend(self.abbreviated(id));
            }
        }
        found
    }

    /// What a sum adds up, each with its sign: through sums of sums, which need no normal form of
    /// their own, as far as none has been computed.
    fn summands(&self, sum: NodeId) -> Vec<(Rational, NodeId)> {
        let mut found = Vec::new();
        let mut pending = vec![(Rational::ONE, sum)];
        while let Some((sign, id)) = pending.pop() {
            match self.graph.node(id) {
                _ if self.expanded.contains_key(&id) => found.push((sign, id)),
                Node::Sum(a, b) => pending.extend([(sign, b), (sign, a)]),
                Node::Neg(a) => pending.push((-sign, a)),
                _ => found.push((sign, id)),
            }
        }
        found
    }

    /// The sum of expanded summands.
    fn total(&self, summands: &[(Rational, NodeId)]) -> Result<Polynomial, NormalError> {
        Polynomial::sum(summands.iter().map(|(sign, summand)| (*sign, &*self.expanded[summand])))
    }

    /// The sum that an abbreviation stands for.
    fn abbreviated(&self, id: NodeId) -> Option<NodeId> {
        match self.graph.node(id) {
            Node::Symbol(symbol) => self.graph.symbol_info(symbol).sum,
            _ => None,
        }
    }

    fn expand(&mut self, id: NodeId) -> Result<Polynomial, NormalError> {
        let one = Rational::ONE;
        if let Some(sum) = self.abbreviated(id) {
            return Ok((*self.expanded[&sum]).clone());
        }
        Ok(match self.graph.node(id) {
            Node::Constant(k) => {
                Polynomial::constant(rational::bounded(k).ok_or(NormalError::Coefficient)?)
            }
            Node::Symbol(symbol) => {
                let index = self.variable(Variable::Symbol(symbol))?;
                Polynomial::single(Monomial::variable(index), one)
            }
            Node::Sum(..) | Node::Neg(_) => self.total(&self.summands(id))?,
            Node::Product(a, b) => self.times(&self.expanded[&a], &self.expanded[&b])?,
            Node::Recip(a) => {
                let Node::Symbol(symbol) = self.graph.node(a) else {
                    return Err(NormalError::Reciprocal);
                };
                let known = self.index.contains_key(&Variable::Recip(symbol));
                let recip = self.variable(Variable::Recip(symbol))?;
                if let (false, Some(sum)) = (known, self.abbreviated(a)) {
                    let summands = self.plain_sum(&self.expanded[&sum]);
                    let (lead, others) = summands.split_last().ok_or(NormalError::Reciprocal)?;
                    let (lead, others) = (*lead, others.to_vec());
                    self.reductions.push(Reduction::Share { recip, lead, others });
                }
                Polynomial::single(Monomial::variable(recip), one)
            }
        })
    }

    /// The variables of a plain sum of symbols; nothing for any other polynomial.
    fn plain_sum(&self, sum: &Polynomial) -> Vec<usize> {
        let index = |monomial: &Monomial| {
            (0..self.variables.len()).find(|index| *monomial == Monomial::variable(*index))
        };
        let plain = |(monomial, coefficient): (&Monomial, &Rational)| {
            index(monomial).filter(|_| *coefficient == Rational::ONE)
        };
        sum.terms().map(plain).collect::<Option<_>>().unwrap_or_default()
    }

    /// The product of two normal forms.
    ///
    /// # Errors
    /// When a power or a coefficient gets too large.
    pub fn times(&self, a: &Polynomial, b: &Polynomial) -> Result<Polynomial, NormalError> {
        let mut made = Sum::default();
        for (x, k) in a.terms() {
            for (y, l) in b.terms() {
                let coefficient = rational::product(*k, *l).ok_or(NormalError::Coefficient)?;
                self.add_reduced(&mut made, x.times(y)?, coefficient)?;
            }
        }
        made.polynomial()
    }

    fn add_reduced(
        &self,
        sum: &mut Sum,
        monomial: Monomial,
        coefficient: Rational,
    ) -> Result<(), NormalError> {
        for reduction in &self.reductions {
            match reduction {
                &Reduction::Square { sin, cos } if monomial.exponent(sin) >= 2 => {
                    let rest = monomial.lowered(sin, 2);
                    let cosine = Monomial::variable(cos);
                    let squared = rest.times(&cosine)?.times(&cosine)?;
                    self.add_reduced(sum, rest, coefficient)?;
                    return self.add_reduced(sum, squared, -coefficient);
                }
                &Reduction::Inverse { symbol, recip }
                    if monomial.exponent(symbol) >= 1 && monomial.exponent(recip) >= 1 =>
                {
                    let rest = monomial.lowered(symbol, 1).lowered(recip, 1);
                    return self.add_reduced(sum, rest, coefficient);
                }
                Reduction::Share { recip, lead, others }
                    if monomial.exponent(*recip) >= 1 && monomial.exponent(*lead) >= 1 =>
                {
                    let rest = monomial.lowered(*lead, 1);
                    self.add_reduced(sum, rest.lowered(*recip, 1), coefficient)?;
                    for other in others {
                        let moved = rest.times(&Monomial::variable(*other))?;
                        self.add_reduced(sum, moved, -coefficient)?;
                    }
                    return Ok(());
                }
                _ => {}
            }
        }
        sum.add(monomial, coefficient)
    }

    fn variable(&mut self, variable: Variable) -> Result<usize, NormalError> {
        if let Some(&index) = self.index.get(&variable) {
            return Ok(index);
        }
        let index = self.variables.len();
        if index >= VARIABLES {
            return Err(NormalError::Variables(VARIABLES));
        }
        self.variables.push(variable);
        self.index.insert(variable, index);
        match variable {
            Variable::Symbol(symbol) => {
                if let Some(cosine) = self.graph.symbol_info(symbol).cosine {
                    let cos = self.variable(Variable::Symbol(cosine))?;
                    self.reductions.push(Reduction::Square { sin: index, cos });
                }
            }
            Variable::Recip(symbol) => {
                if self.graph.symbol_info(symbol).sum.is_none() {
                    let symbol = self.variable(Variable::Symbol(symbol))?;
                    self.reductions.push(Reduction::Inverse { symbol, recip: index });
                }
            }
        }
        Ok(index)
    }

    /// A term as it is written: `-2*d*spin*cos_theta`.
    #[must_use]
    pub fn show(&self, monomial: &Monomial, coefficient: Rational) -> String {
        let factors = self.factors(monomial);
        let sign = if coefficient < Rational::ZERO { "-" } else { "" };
        let size = if coefficient < Rational::ZERO { -coefficient } else { coefficient };
        let mut shown = Vec::new();
        if size != Rational::ONE || factors.is_empty() {
            shown.push(size.to_string());
        }
        for Factor { recip, name, exponent } in factors {
            let base = if recip { format!("1/{name}") } else { name };
            shown.push(if exponent == 1 { base } else { format!("{base}^{exponent}") });
        }
        format!("{sign}{}", shown.join("*"))
    }

    /// The powers of a term, in the order in which they are written.
    #[must_use]
    pub fn factors(&self, monomial: &Monomial) -> Vec<Factor> {
        let mut factors = BTreeMap::new();
        for (index, &variable) in self.variables.iter().enumerate() {
            let exponent = monomial.exponent(index);
            if exponent > 0 {
                let (stage, recip, name) = self.name(variable);
                factors.insert((stage, !recip, name.clone()), Factor { recip, name, exponent });
            }
        }
        factors.into_values().collect()
    }

    /// Parameters first, angles next, rates and accelerations last; by name within a stage.
    fn name(&self, variable: Variable) -> (u8, bool, String) {
        let (Variable::Symbol(symbol) | Variable::Recip(symbol)) = variable;
        let info = self.graph.symbol_info(symbol);
        (info.stage as u8, matches!(variable, Variable::Recip(_)), info.name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Stage;

    #[test]
    fn squares_of_sine_and_cosine_add_to_one() {
        let g = Graph::new();
        let (s, c) = g.angle("q", g.symbol("q_dot", Stage::Rate));
        let mut ring = Ring::new(&g);
        let e = s.squared() + c.squared() - g.constant(1);
        assert!(ring.normal(e).unwrap().is_empty());
    }

    #[test]
    fn a_reciprocal_cancels_its_symbol() {
        let g = Graph::new();
        let [m, x] = ["m", "x"].map(|name| g.symbol(name, Stage::Parameter));
        let mut ring = Ring::new(&g);
        assert_eq!(ring.normal(m.recip() * (m * x)), ring.normal(x));
        assert_eq!(ring.normal((m + x).recip()), Err(NormalError::Reciprocal));
    }

    #[test]
    fn what_gets_too_large_is_an_error() {
        let g = Graph::new();
        let x = g.symbol("x", Stage::Parameter);
        let mut ring = Ring::new(&g);
        let eighth = x.squared().squared().squared();
        let highest = eighth * x.squared().squared() * x.squared() * x;
        assert!(ring.normal(highest).is_ok());
        assert_eq!(ring.normal(highest * x), Err(NormalError::Exponent));
        let y = g.symbol("y", Stage::Parameter);
        assert_eq!(ring.normal((eighth * y) * (eighth * y)), Err(NormalError::Exponent));
        let large = g.constant(1 << 30);
        assert_eq!(ring.normal(large * (large * x)), Err(NormalError::Coefficient));
        assert_eq!(ring.normal(large * x + large * x), Err(NormalError::Coefficient));
    }

    #[test]
    fn the_shares_of_a_sum_add_to_one() {
        let g = Graph::new();
        let [a, b, c] = ["a", "b", "c"].map(|name| g.symbol(name, Stage::Parameter));
        let m = g.abbreviation("m", a + b + c);
        let mut ring = Ring::new(&g);
        let shares = a * m.recip() + b * m.recip() + c * m.recip();
        assert_eq!(ring.normal(shares), ring.normal(g.constant(1)));
        assert_eq!(ring.normal(m * m.recip()), ring.normal(g.constant(1)));
        assert_eq!(ring.normal(m), ring.normal(a + b + c));
    }

    #[test]
    fn a_product_expands() {
        let g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Stage::Parameter));
        let mut ring = Ring::new(&g);
        let left = ring.normal((a + b) * (a - b)).unwrap();
        assert_eq!(left, ring.normal(a.squared() - b.squared()).unwrap());
        let shown: Vec<_> = left.terms().map(|(m, k)| ring.show(m, *k)).collect();
        assert_eq!(shown, ["a^2", "-b^2"]);
    }
}
