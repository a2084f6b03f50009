//! One emitted statement as C: the same operations in the same order, with operators only.

use syn::{BinOp, Expr, Lit, Member, Pat, Stmt, UnOp};

use crate::emit::text::{LINE, wrapped};

/// How tightly an expression binds in C.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    /// A reciprocal, which is a quotient here: in parentheses inside a product.
    Quotient,
    Product,
    Unary,
    Atom,
}

/// Text and how tightly it binds.
struct Written {
    text: String,
    binding: Binding,
}

/// A statement of an emitted function: `let a = b.recip();` to `const double a = 1.0 / b;`.
///
/// Nothing where it is not one that the emitter writes.
pub(super) fn statement(tokens: proc_macro2::TokenStream) -> Option<String> {
    let Ok(Stmt::Local(local)) = syn::parse2(tokens) else { return None };
    let Pat::Ident(name) = &local.pat else { return None };
    let value = written(&local.init?.expr)?;
    Some(format!("const double {} = {};", name.ident, value.text))
}

/// A statement in lines that begin `indent` columns to the right.
pub(super) fn lines(statement: &str, indent: usize) -> Vec<String> {
    if statement.chars().count() + indent <= LINE {
        return vec![statement.to_owned()];
    }
    let Some((name, value)) = statement.split_once(" = ") else {
        return vec![statement.to_owned()];
    };
    let value = wrapped(value, LINE - indent - 4).into_iter().map(|line| format!("    {line}"));
    std::iter::once(format!("{name} =")).chain(value).collect()
}

fn written(e: &Expr) -> Option<Written> {
    let done = match e {
        Expr::Paren(inner) => written(&inner.expr)?,
        Expr::Path(path) => atom(path.path.get_ident()?.to_string()),
        Expr::Field(field) => {
            let (record, Member::Named(name)) = (written(&field.base)?, &field.member) else {
                return None;
            };
            atom(format!("{}->{name}", record.text))
        }
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
            let text = format!("-{}", inside(written(&unary.expr)?, Binding::Unary));
            Written { text, binding: Binding::Unary }
        }
        Expr::Binary(binary) => {
            let (a, b) = (written(&binary.left)?, written(&binary.right)?);
            match binary.op {
                BinOp::Add(_) => sum(a, '+', b),
                BinOp::Sub(_) => sum(a, '-', b),
                BinOp::Mul(_) => product(a, b),
                _ => return None,
            }
        }
        Expr::MethodCall(call) => {
            let object = written(&call.receiver)?;
            let arguments: Vec<_> = call.args.iter().collect();
            match (call.method.to_string().as_str(), arguments.as_slice()) {
                ("recip", []) => {
                    let text = format!("1.0 / {}", inside(object, Binding::Unary));
                    Written { text, binding: Binding::Quotient }
                }
                // A constant of the same kind: here there is one kind.
                ("like", [Expr::Lit(literal)]) => match &literal.lit {
                    Lit::Float(value) => atom(value.to_string()),
                    _ => return None,
                },
                _ => return None,
            }
        }
        _ => return None,
    };
    Some(done)
}

fn sum(a: Written, sign: char, b: Written) -> Written {
    let text = format!("{} {sign} {}", inside(a, Binding::Sum), inside(b, Binding::Quotient));
    Written { text, binding: Binding::Sum }
}

fn product(a: Written, b: Written) -> Written {
    let text = format!("{} * {}", inside(a, Binding::Product), inside(b, Binding::Unary));
    Written { text, binding: Binding::Product }
}

/// In parentheses unless it binds at least as tightly as `outside` requires.
fn inside(e: Written, outside: Binding) -> String {
    if e.binding >= outside { e.text } else { format!("({})", e.text) }
}

fn atom(text: String) -> Written {
    Written { text, binding: Binding::Atom }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quote::quote;

    #[test]
    fn operators_keep_their_order() {
        let cases = [
            (quote!(let x = a - (b - c);), "a - (b - c)"),
            (quote!(let x = p.m_w * (a + b) * c;), "p->m_w * (a + b) * c"),
            (quote!(let x = a * (b * c);), "a * (b * c)"),
            (quote!(let x = -(a * b) + c;), "-(a * b) + c"),
            (quote!(let x = (a + b).recip() * c;), "(1.0 / (a + b)) * c"),
            (quote!(let x = -a.recip();), "-(1.0 / a)"),
            (quote!(let x = c + (a + b) * (d * e);), "c + (a + b) * (d * e)"),
            (quote!(let x = c + d - -a * b;), "c + d - -a * b"),
            (quote!(let x = q.sin_theta.like(0.5);), "0.5"),
        ];
        for (rust, c) in cases {
            assert_eq!(statement(rust), Some(format!("const double x = {c};")));
        }
    }

    #[test]
    fn what_the_emitter_never_writes_is_no_statement() {
        for other in [quote!(let x = a / b;), quote!(let x = a.sqrt();), quote!(f(x);)] {
            assert_eq!(statement(other), None);
        }
    }

    #[test]
    fn a_long_statement_is_broken_and_loses_nothing() {
        let long = format!("const double x = {};", vec!["abcdefgh"; 20].join(" + "));
        let broken = lines(&long, 4);
        assert!(broken.iter().all(|line| line.len() + 4 <= LINE), "{broken:?}");
        assert_eq!(broken.join(" ").split_whitespace().collect::<Vec<_>>().join(" "), long);
        assert_eq!(lines("const double x = a;", 4), ["const double x = a;"]);
    }
}
