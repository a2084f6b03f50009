//! Symbols: what has a name in the paper, how fast it may change, and its time derivative.

use super::{Expr, Graph, Node, NodeId};

/// Index of a symbol in its graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SymbolId(pub(crate) u16);

impl SymbolId {
    /// Its number among the symbols of its graph.
    #[must_use]
    pub fn index(self) -> usize {
        usize::from(self.0)
    }
}

/// At which stage of an evaluation a quantity becomes known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Known once per spacecraft: mass, length, inertia.
    Parameter,
    /// Known with the angles.
    Configuration,
    /// Known with the rates and the drives (motor torques).
    Rate,
    /// The second-order states.
    Acceleration,
}

/// A named quantity.
#[derive(Clone, Debug)]
pub struct Symbol {
    /// Its name in code.
    pub name: String,
    /// When it is known.
    pub stage: Stage,
    /// Its time derivative, where it has one.
    pub(crate) rate: Option<NodeId>,
    /// For the sine of an angle: the symbol of its cosine.
    pub(crate) cosine: Option<SymbolId>,
    /// For an abbreviation: the sum of symbols it stands for.
    pub(crate) sum: Option<NodeId>,
}

impl Graph {
    /// The symbol `name`, made on first use. A parameter is constant in time.
    ///
    /// # Panics
    /// When the name is taken by a symbol of another stage.
    #[must_use]
    pub fn symbol(&self, name: &str, stage: Stage) -> Expr<'_> {
        let known = self.arena.borrow().names.get(name).copied();
        let id = known.unwrap_or_else(|| {
            let rate = (stage == Stage::Parameter).then(|| self.zero().id());
            let mut arena = self.arena.borrow_mut();
            let id = SymbolId(u16::try_from(arena.symbols.len()).expect("fewer than 2^16 symbols"));
            arena.symbols.push(Symbol {
                name: name.to_owned(),
                stage,
                rate,
                cosine: None,
                sum: None,
            });
            arena.names.insert(name.to_owned(), id);
            id
        });
        assert_eq!(self.symbol_info(id).stage, stage, "symbol `{name}` was made at another stage");
        self.intern(Node::Symbol(id))
    }

    /// States that `d symbol / dt = rate`.
    pub(crate) fn set_rate(&self, symbol: Expr<'_>, rate: Expr<'_>) {
        let Node::Symbol(id) = symbol.node() else { panic!("only a symbol has a stated rate") };
        self.arena.borrow_mut().symbols[usize::from(id.0)].rate = Some(rate.id());
    }

    /// Sine and cosine of the angle `name`, whose rate is `rate`: two symbols with
    /// `s' = c rate`, `c' = -s rate`.
    #[must_use]
    pub fn angle<'g>(&'g self, name: &str, rate: Expr<'g>) -> (Expr<'g>, Expr<'g>) {
        let sin = self.symbol(&format!("sin_{name}"), Stage::Configuration);
        let cos = self.symbol(&format!("cos_{name}"), Stage::Configuration);
        self.set_rate(sin, cos * rate);
        self.set_rate(cos, -(sin * rate));
        self.pair(sin, cos);
        (sin, cos)
    }

    /// Sine and cosine of an angle that never changes: two parameters.
    #[must_use]
    pub fn constant_angle(&self, name: &str) -> (Expr<'_>, Expr<'_>) {
        let [sin, cos] =
            ["sin", "cos"].map(|of| self.symbol(&format!("{of}_{name}"), Stage::Parameter));
        self.pair(sin, cos);
        (sin, cos)
    }

    /// States that these symbols are sine and cosine of one angle.
    fn pair(&self, sin: Expr<'_>, cos: Expr<'_>) {
        let (Node::Symbol(s), Node::Symbol(c)) = (sin.node(), cos.node()) else { unreachable!() };
        self.arena.borrow_mut().symbols[usize::from(s.0)].cosine = Some(c);
    }

    /// The symbol `name` for a sum of parameters, so that its reciprocal has a normal form: `m_d`.
    ///
    /// # Panics
    /// If the sum was made after a symbol of that name.
    #[must_use]
    pub fn abbreviation<'g>(&'g self, name: &str, sum: Expr<'g>) -> Expr<'g> {
        let symbol = self.symbol(name, Stage::Parameter);
        assert!(sum.id() < symbol.id(), "a sum is made before its abbreviation");
        let Node::Symbol(id) = symbol.node() else { unreachable!("a symbol is a symbol") };
        self.arena.borrow_mut().symbols[usize::from(id.0)].sum = Some(sum.id());
        symbol
    }

    /// What is known of a symbol.
    #[must_use]
    pub fn symbol_info(&self, id: SymbolId) -> Symbol {
        self.arena.borrow().symbols[usize::from(id.0)].clone()
    }

    /// How many symbols there are.
    #[must_use]
    pub fn symbols(&self) -> usize {
        self.arena.borrow().symbols.len()
    }

    /// The symbol itself, as an expression.
    #[must_use]
    pub fn named(&self, id: SymbolId) -> Expr<'_> {
        self.intern(Node::Symbol(id))
    }

    /// The symbol called `name`, where there is one.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<Expr<'_>> {
        let id = self.arena.borrow().names.get(name).copied();
        id.map(|id| self.intern(Node::Symbol(id)))
    }
}
