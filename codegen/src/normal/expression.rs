//! A normal form as an expression again: a sum of products.

use super::Polynomial;
use super::ring::{Factor, Ring};
use crate::graph::Expr;

impl<'g> Ring<'g> {
    /// The polynomial as an expression: a sum of products.
    ///
    /// Reciprocals and powers are written out; the order is that of the terms.
    #[must_use]
    pub fn expression(&self, polynomial: &Polynomial) -> Expr<'g> {
        let one = self.graph.constant(1);
        let power = |factor: &Factor| {
            let symbol = self
                .graph
                .find(&factor.name)
                .map_or(one, |symbol| if factor.recip { symbol.recip() } else { symbol });
            (0..factor.exponent).fold(one, |product, _| product * symbol)
        };
        polynomial.terms().fold(self.graph.zero(), |sum, (monomial, coefficient)| {
            let factors = self.factors(monomial);
            let product = factors.iter().map(power).fold(one, |product, factor| product * factor);
            sum + self.graph.constant(*coefficient) * product
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Graph, Stage};

    #[test]
    fn what_cancels_is_not_written_again() {
        let g = Graph::new();
        let [m, x, y] = ["m", "x", "y"].map(|name| g.symbol(name, Stage::Parameter));
        let mut ring = Ring::new(&g);
        let long = m * (x.squared() + y.squared()) - m * y.squared();
        let normal = ring.normal(long).unwrap();
        let short = ring.expression(&normal);
        assert_eq!(ring.normal(short).unwrap(), normal);
        assert!(g.reachable([short.id()]).len() < g.reachable([long.id()]).len());
    }
}
