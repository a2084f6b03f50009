//! One sum of products, and how few operations it can be written with.

use crate::graph::Expr;

/// A sum with all its terms side by side.
#[derive(Clone, Debug)]
pub(super) struct Sum<'g> {
    terms: Vec<Term<'g>>,
}

/// A product with its sign.
#[derive(Clone, Debug, Default)]
pub(super) struct Term<'g> {
    negative: bool,
    /// Known beforehand: their product is one factor at most.
    hoisted: Vec<Expr<'g>>,
    /// All others.
    running: Vec<Expr<'g>>,
}

/// A sum as it is to be written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Written<'g> {
    pub(super) value: Expr<'g>,
    pub(super) operations: usize,
}

impl<'g> Sum<'g> {
    /// The sum of one term or more.
    pub(super) fn new(terms: Vec<Term<'g>>) -> Self {
        Self { terms }
    }

    /// The sum with common factors taken out, the one that saves most first, as long as one saves.
    pub(super) fn written(mut self) -> Written<'g> {
        let mut operations = 0;
        while let Some(factor) = self.common() {
            let (place, cofactors) = self.take(factor);
            let hoisted = cofactors.is_hoisted();
            let inside = cofactors.written();
            operations += inside.operations;
            self.terms[place].push(inside.value, hoisted);
        }
        Written { value: self.value(), operations: operations + self.operations() }
    }

    /// What it costs unchanged; what is known beforehand is one addend at most.
    fn operations(&self) -> usize {
        let products: usize = self.terms.iter().map(Term::operations).sum();
        let running = self.terms.iter().filter(|term| !term.is_hoisted()).count();
        let addends = running + usize::from(running < self.terms.len());
        products + addends - 1
    }

    fn is_hoisted(&self) -> bool {
        self.terms.iter().all(Term::is_hoisted)
    }

    /// The factor whose taking out saves most; of equals, the first.
    fn common(&self) -> Option<Expr<'g>> {
        let mut best = None;
        let all = self.terms.iter().flat_map(|term| term.running.iter().chain(&term.hoisted));
        let mut tried: Vec<Expr<'g>> = Vec::new();
        for factor in all {
            if tried.contains(factor) {
                continue;
            }
            tried.push(*factor);
            let saved = self.saved(*factor);
            if saved > best.map_or(0, |(saved, _)| saved) {
                best = Some((saved, *factor));
            }
        }
        best.map(|(_, factor)| factor)
    }

    /// The operations that are saved by taking this factor out.
    fn saved(&self, factor: Expr<'g>) -> usize {
        if self.terms.iter().filter(|term| term.has(factor)).count() < 2 {
            return 0;
        }
        let mut rest = self.clone();
        let (place, cofactors) = rest.take(factor);
        // Whatever it will be, it is one factor.
        rest.terms[place].push(factor, cofactors.is_hoisted());
        self.operations().saturating_sub(rest.operations() + cofactors.operations())
    }

    /// Takes out the terms with a factor, which stays where the first of them was: its place, and the
    /// sum that it is to be multiplied by.
    fn take(&mut self, factor: Expr<'g>) -> (usize, Self) {
        let place = self.terms.iter().position(|term| term.has(factor));
        let place = place.expect("a factor that is taken out is there");
        let hoisted = self.terms[place].hoisted.contains(&factor);
        let terms = std::mem::take(&mut self.terms);
        let (with, rest): (Vec<_>, Vec<_>) = terms.into_iter().partition(|term| term.has(factor));
        let negative = with.iter().all(|term| term.negative);
        let without = with.into_iter().map(|term| term.without(factor, negative));
        let cofactors = Self { terms: without.collect() };
        self.terms = rest;
        let mut single = Term::signed(negative);
        single.push(factor, hoisted);
        self.terms.insert(place, single);
        (place, cofactors)
    }

    fn value(&self) -> Expr<'g> {
        let (hoisted, running): (Vec<_>, Vec<_>) =
            self.terms.iter().partition(|term| term.is_hoisted());
        let sum = |terms: Vec<&Term<'g>>| {
            terms.into_iter().map(Term::value).reduce(|sum, term| sum + term)
        };
        let parts = [sum(running), sum(hoisted)].into_iter().flatten();
        parts.reduce(|sum, part| sum + part).expect("a sum has a term")
    }
}

impl<'g> Term<'g> {
    /// A sign without a factor yet.
    pub(super) fn signed(negative: bool) -> Self {
        Self { negative, ..Self::default() }
    }

    fn operations(&self) -> usize {
        let factors = self.running.len() + usize::from(!self.hoisted.is_empty());
        if self.is_hoisted() { 0 } else { factors - 1 }
    }

    fn is_hoisted(&self) -> bool {
        self.running.is_empty()
    }

    /// Whether this is one of several factors.
    fn has(&self, factor: Expr<'g>) -> bool {
        let several = self.running.len() + self.hoisted.len() > 1;
        several && (self.running.contains(&factor) || self.hoisted.contains(&factor))
    }

    /// One factor more.
    pub(super) fn push(&mut self, factor: Expr<'g>, hoisted: bool) {
        if hoisted { &mut self.hoisted } else { &mut self.running }.push(factor);
    }

    /// The other factors; the sign is turned where it is taken out, too.
    fn without(mut self, factor: Expr<'g>, turned: bool) -> Self {
        let list =
            if self.running.contains(&factor) { &mut self.running } else { &mut self.hoisted };
        if let Some(place) = list.iter().position(|other| *other == factor) {
            list.remove(place);
        }
        self.negative ^= turned;
        self
    }

    fn value(&self) -> Expr<'g> {
        let product = |factors: &[Expr<'g>]| factors.iter().copied().reduce(|a, b| a * b);
        let parts = [product(&self.running), product(&self.hoisted)].into_iter().flatten();
        let value = parts.reduce(|a, b| a * b).expect("a product has a factor");
        if self.negative { -value } else { value }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::{Graph, Stage};

    fn term<'g>(negative: bool, hoisted: &[Expr<'g>], running: &[Expr<'g>]) -> Term<'g> {
        Term { negative, hoisted: hoisted.to_vec(), running: running.to_vec() }
    }

    #[test]
    fn the_factor_that_saves_most_goes_first() {
        let g = Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name, Stage::Rate));
        let terms = [[a, b], [a, c], [b, d], [b, c]].map(|factors| term(false, &[], &factors));
        let written = Sum::new(terms.to_vec()).written();
        assert_eq!((written.value, written.operations), (b * (a + d + c) + a * c, 5));
    }

    #[test]
    fn a_sign_that_all_have_goes_outside() {
        let g = Graph::new();
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| g.symbol(name, Stage::Rate));
        let terms =
            vec![term(false, &[], &[d]), term(true, &[], &[a, b]), term(true, &[], &[a, c])];
        assert_eq!(Sum::new(terms).written().value, d - a * (b + c));
    }

    #[test]
    fn a_factor_by_itself_is_no_product() {
        let g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Stage::Rate));
        let terms = vec![term(false, &[], &[a]), term(false, &[], &[a, b])];
        assert_eq!(Sum::new(terms).written().value, a + a * b);
    }

    #[test]
    fn what_is_known_beforehand_costs_no_operation() {
        let g = Graph::new();
        let x = g.symbol("x", Stage::Rate);
        let [k, l, m] = ["k", "l", "m"].map(|name| g.symbol(name, Stage::Parameter));
        let terms =
            vec![term(false, &[k, l], &[x]), term(true, &[m], &[x]), term(false, &[m], &[])];
        let written = Sum::new(terms).written();
        assert_eq!((written.value, written.operations), (x * (k * l - m) + m, 2));
    }
}
