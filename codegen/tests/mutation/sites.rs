//! The places of an expression at which a term can be dropped or flipped.

use syn::{BinOp, Expr, UnOp, parse_quote};

/// What is done to one operand of a sum or difference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Change {
    /// The operand is left out.
    Drop,
    /// Its sign is changed.
    Flip,
}

/// How many operands of sums the expression has, at any depth.
pub(crate) fn count(expr: &Expr) -> usize {
    let mut number = usize::MAX;
    visit(&mut expr.clone(), &mut number, Change::Drop);
    usize::MAX - number
}

/// The expression with operand number `site` changed.
pub(crate) fn changed(expr: &Expr, site: usize, change: Change) -> Expr {
    let mut made = expr.clone();
    let mut number = site;
    assert!(visit(&mut made, &mut number, change), "there is a site {site}");
    made
}

/// The operands of a sum or of a difference, and whether it is one.
fn sum(expr: &Expr) -> Option<(Expr, Expr, bool)> {
    let Expr::Binary(binary) = expr else { return None };
    let minus = matches!(binary.op, BinOp::Sub(_));
    let sum = minus || matches!(binary.op, BinOp::Add(_));
    sum.then(|| ((*binary.left).clone(), (*binary.right).clone(), minus))
}

/// Counts `number` down over the operands in order and changes the one at which it is zero.
fn visit(expr: &mut Expr, number: &mut usize, change: Change) -> bool {
    if let Some((left, right, minus)) = sum(expr) {
        let changed: [Expr; 2] = match (change, minus) {
            (Change::Drop, false) => [parse_quote!(#right), parse_quote!(#left)],
            (Change::Drop, true) => [parse_quote!(-(#right)), parse_quote!(#left)],
            (Change::Flip, false) => {
                [parse_quote!(-(#left) + #right), parse_quote!(#left - (#right))]
            }
            (Change::Flip, true) => {
                [parse_quote!(-(#left) - (#right)), parse_quote!(#left + (#right))]
            }
        };
        for made in changed {
            if *number == 0 {
                *expr = parse_quote!((#made));
                return true;
            }
            *number -= 1;
        }
    }
    match expr {
        Expr::Binary(binary) => {
            visit(&mut binary.left, number, change) || visit(&mut binary.right, number, change)
        }
        Expr::Paren(inside) => visit(&mut inside.expr, number, change),
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            visit(&mut unary.expr, number, change)
        }
        Expr::Call(call) => call.args.iter_mut().any(|a| visit(a, number, change)),
        Expr::MethodCall(call) => {
            visit(&mut call.receiver, number, change)
                || call.args.iter_mut().any(|a| visit(a, number, change))
        }
        Expr::Array(array) => array.elems.iter_mut().any(|e| visit(e, number, change)),
        _ => false,
    }
}

#[test]
fn both_operands_of_each_sum_are_sites() {
    let expr: Expr = parse_quote!(a * (b - c) + d);
    let shown = |site, change| {
        let made = changed(&expr, site, change);
        quote::quote!(#made).to_string()
    };
    assert_eq!(count(&expr), 4);
    assert_eq!(shown(0, Change::Drop), "(d)");
    assert_eq!(shown(1, Change::Drop), "(a * (b - c))");
    assert_eq!(shown(2, Change::Drop), "a * ((- (c))) + d");
    assert_eq!(shown(3, Change::Flip), "a * ((b + (c))) + d");
}
