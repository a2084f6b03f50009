//! Named statements in sections: what a derivation yields for the emitter and the proof.
//!
//! A *named* value keeps the name the paper gives it and is expanded like any other in the proof.
//! A *cut* value becomes a symbol for all that follows: the proof shows once what it stands for.

use super::heading::Heading;
use crate::graph::{Expr, Graph, Node};
use crate::space::{ENTRIES, XYZ};

/// One named value.
#[derive(Clone, Debug)]
pub struct Statement<'g> {
    /// Its name.
    pub name: String,
    /// What it is.
    pub value: Expr<'g>,
    /// The symbol that stands for it afterwards.
    pub cut: Option<Expr<'g>>,
}

/// Statements under one heading.
#[derive(Clone, Debug)]
pub struct Section<'g> {
    /// What they compute.
    pub heading: Heading,
    /// Prefix of the numbered temporaries.
    pub prefix: String,
    /// In order.
    pub statements: Vec<Statement<'g>>,
}

/// Collects sections.
pub struct Script<'g> {
    graph: &'g Graph,
    /// What was collected.
    pub sections: Vec<Section<'g>>,
}

impl<'g> Script<'g> {
    /// An empty script.
    #[must_use]
    pub fn new(graph: &'g Graph) -> Self {
        Self { graph, sections: Vec::new() }
    }

    /// Opens a section; its temporaries are called `prefix_0`, `prefix_1`.
    pub fn section(&mut self, prefix: &str, heading: Heading) {
        let prefix = prefix.to_owned();
        self.sections.push(Section { heading, prefix, statements: Vec::new() });
    }

    /// Names a value.
    pub fn name(&mut self, name: impl Into<String>, value: Expr<'g>) {
        self.push(name.into(), value, None);
    }

    /// Names several values.
    pub fn names(&mut self, values: impl IntoIterator<Item = (String, Expr<'g>)>) {
        for (name, value) in values {
            self.name(name, value);
        }
    }

    /// Names a value and puts a symbol in its place; a bare symbol or constant stands for itself.
    pub fn cut(&mut self, name: impl Into<String>, value: Expr<'g>) -> Expr<'g> {
        let name = name.into();
        if matches!(value.node(), Node::Symbol(_) | Node::Constant(_)) {
            self.push(name, value, None);
            return value;
        }
        let symbol = self.graph.symbol(&name, value.stage());
        self.push(name, value, Some(symbol));
        symbol
    }

    /// Names a value that `symbol` stands for afterwards.
    pub fn define(&mut self, name: &str, value: Expr<'g>, symbol: Expr<'g>) {
        self.push(name.to_owned(), value, Some(symbol));
    }

    fn push(&mut self, name: String, value: Expr<'g>, cut: Option<Expr<'g>>) {
        let section = self.sections.last_mut().expect("a section is open");
        section.statements.push(Statement { name, value, cut });
    }
}

/// Names of three components: `omega_gi_n_gix`.
pub(crate) fn triple(stem: &str, frame: &str) -> [String; 3] {
    XYZ.map(|axis| format!("{stem}_{frame}{axis}"))
}

/// Names of the six entries of a symmetric tensor: `i_w_w_11`.
pub(crate) fn sextuple(stem: &str) -> [String; 6] {
    ENTRIES.map(|entry| format!("{stem}_{entry}"))
}

/// Pairs names with values.
pub(crate) fn pairs<'g, const K: usize>(
    names: [String; K],
    values: [Expr<'g>; K],
) -> impl Iterator<Item = (String, Expr<'g>)> {
    names.into_iter().zip(values)
}
