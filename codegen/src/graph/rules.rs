//! The simplifications made while an expression is built.
//!
//! Each rule is one named, directional rewrite: the left form is never built. A
//! rule may only make an expression smaller or move a sign outwards, so building always ends.
//! All of them hold in exact arithmetic; the unit test evaluates both sides of each.

use super::{Expr, Node, Rational, rational};

/// Name and law of every rule, as the tests and the documentation print them.
pub const RULES: [(&str, &str); 15] = [
    ("fold_sum", "k + l -> (k+l)"),
    ("zero_plus", "0 + a -> a"),
    ("opposites", "a + -a -> 0"),
    ("neg_out_of_sum", "-a + -b -> -(a + b)"),
    ("fold_product", "k * l -> (kl)"),
    ("zero_times", "0 * a -> 0"),
    ("one_times", "1 * a -> a"),
    ("minus_one_times", "-1 * a -> -a"),
    ("two_times", "2 * a -> a + a"),
    ("neg_out_of_product", "-a * b -> -(a * b)"),
    ("gather", "k * (l * a) -> (kl) * a"),
    ("fold_neg", "-(k) -> (-k)"),
    ("double_neg", "--a -> a"),
    ("fold_recip", "1/(k) -> (1/k)"),
    ("double_recip", "1/(1/a) -> a"),
];

pub(super) fn sum<'g>(a: Expr<'g>, b: Expr<'g>) -> Expr<'g> {
    match (a.node(), b.node()) {
        (Node::Constant(k), Node::Constant(l)) => match rational::sum(k, l) {
            Some(folded) => a.graph.constant(folded), // fold_sum
            None => a.apply(Node::Sum(a.id.min(b.id), a.id.max(b.id))),
        },
        (Node::Constant(k), _) if k == Rational::ZERO => b, // zero_plus
        (_, Node::Constant(k)) if k == Rational::ZERO => a, // zero_plus
        (Node::Neg(x), Node::Neg(y)) => neg(sum(a.graph.expr(x), a.graph.expr(y))), // neg_out_of_sum
        (Node::Neg(x), _) if x == b.id => a.graph.zero(),                           // opposites
        (_, Node::Neg(y)) if y == a.id => a.graph.zero(),                           // opposites
        _ => a.apply(Node::Sum(a.id.min(b.id), a.id.max(b.id))),
    }
}

pub(super) fn product<'g>(a: Expr<'g>, b: Expr<'g>) -> Expr<'g> {
    match (a.node(), b.node()) {
        (Node::Constant(k), Node::Constant(l)) => match rational::product(k, l) {
            Some(folded) => a.graph.constant(folded), // fold_product
            None => a.apply(Node::Product(a.id.min(b.id), a.id.max(b.id))),
        },
        (Node::Constant(k), _) => scale(k, b),
        (_, Node::Constant(k)) => scale(k, a),
        (Node::Neg(x), _) => neg(product(a.graph.expr(x), b)), // neg_out_of_product
        (_, Node::Neg(y)) => neg(product(a, a.graph.expr(y))), // neg_out_of_product
        _ => a.apply(Node::Product(a.id.min(b.id), a.id.max(b.id))),
    }
}

fn scale(k: Rational, a: Expr<'_>) -> Expr<'_> {
    let graph = a.graph;
    if k == Rational::ZERO {
        return graph.zero(); // zero_times
    }
    if k < Rational::ZERO {
        return neg(scale(-k, a)); // minus_one_times, neg_out_of_product
    }
    if k == Rational::ONE {
        return a; // one_times
    }
    match a.node() {
        Node::Neg(x) => neg(scale(k, graph.expr(x))), // neg_out_of_product
        Node::Product(x, y) => match (graph.node(x), graph.node(y)) {
            (Node::Constant(l), _) => gathered(k, l, graph.expr(y), a), // gather
            (_, Node::Constant(l)) => gathered(k, l, graph.expr(x), a), // gather
            _ => scaled(k, a),
        },
        _ => scaled(k, a),
    }
}

/// `(k l) rest`, or `k whole` where the product of the constants is too large to be one.
fn gathered<'g>(k: Rational, l: Rational, rest: Expr<'g>, whole: Expr<'g>) -> Expr<'g> {
    match rational::product(k, l) {
        Some(product) => scale(product, rest),
        None => scaled(k, whole),
    }
}

fn scaled(k: Rational, a: Expr<'_>) -> Expr<'_> {
    if k == Rational::from(2) {
        return sum(a, a); // two_times
    }
    let constant = a.graph.constant(k);
    a.apply(Node::Product(constant.id.min(a.id), constant.id.max(a.id)))
}

pub(super) fn neg(a: Expr<'_>) -> Expr<'_> {
    match a.node() {
        Node::Constant(k) => a.graph.constant(-k), // fold_neg
        Node::Neg(x) => a.graph.expr(x),           // double_neg
        _ => a.apply(Node::Neg(a.id)),
    }
}

pub(super) fn recip(a: Expr<'_>) -> Expr<'_> {
    match a.node() {
        Node::Constant(k) if k != Rational::ZERO => a.graph.constant(k.recip()), // fold_recip
        Node::Recip(x) => a.graph.expr(x),                                       // double_recip
        _ => a.apply(Node::Recip(a.id)),
    }
}
