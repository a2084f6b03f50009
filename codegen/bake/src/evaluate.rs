//! Emitted functions evaluated as they are written: statement by statement, each operation rounded
//! by itself, as the emitted crate does on every target.
//!
//! Strict: a form that kernels do not have is an error.

use std::collections::BTreeMap;

use quote::ToTokens;
use syn::{BinOp, Expr, ExprLit, Lit, Member, Pat, Stmt, UnOp};

use crate::error::BakeError;

/// Numbers by their names.
pub(crate) type Numbers = BTreeMap<String, f64>;

/// What a function returns, field by field in the order of the text; `p` are the fields of its
/// argument.
pub(crate) fn evaluate(
    file: &syn::File,
    function: &str,
    p: &Numbers,
) -> Result<Vec<(String, f64)>, BakeError> {
    let wrong = |what: String| BakeError::Statement(function.to_owned(), what);
    let found = file.items.iter().find_map(|item| match item {
        syn::Item::Fn(own) if own.sig.ident == function => Some(own),
        _ => None,
    });
    let found = found.ok_or_else(|| wrong("no function of this name".to_owned()))?;
    let mut scope = Scope { p, bound: Numbers::new() };
    for statement in &found.block.stmts {
        match statement {
            Stmt::Local(local) => {
                let (Pat::Ident(name), Some(init)) = (&local.pat, &local.init) else {
                    return Err(wrong(shown(local)));
                };
                let value = scope.value(&init.expr).map_err(wrong)?;
                scope.bound.insert(name.ident.to_string(), value);
            }
            Stmt::Expr(Expr::Struct(literal), None) => {
                let field = |field: &syn::FieldValue| match &field.member {
                    Member::Named(name) => Ok((name.to_string(), scope.value(&field.expr)?)),
                    Member::Unnamed(_) => Err(shown(field)),
                };
                let fields: Result<_, _> = literal.fields.iter().map(field).collect();
                return fields.map_err(wrong);
            }
            other => return Err(wrong(shown(other))),
        }
    }
    Err(wrong("it returns no record".to_owned()))
}

/// What names stand for so far.
struct Scope<'a> {
    p: &'a Numbers,
    bound: Numbers,
}

impl Scope<'_> {
    /// The value of an expression, or its text where it is none.
    fn value(&self, expr: &Expr) -> Result<f64, String> {
        let unknown = || shown(expr);
        match expr {
            Expr::Paren(inner) => self.value(&inner.expr),
            Expr::Path(path) => {
                let name = path.path.get_ident().ok_or_else(unknown)?.to_string();
                self.bound.get(&name).copied().ok_or_else(unknown)
            }
            Expr::Field(field) => match (&*field.base, &field.member) {
                (Expr::Path(base), Member::Named(name)) if base.path.is_ident("p") => {
                    self.p.get(&name.to_string()).copied().ok_or_else(unknown)
                }
                _ => Err(unknown()),
            },
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => Ok(-self.value(&unary.expr)?),
            Expr::Binary(binary) => {
                let (left, right) = (self.value(&binary.left)?, self.value(&binary.right)?);
                match binary.op {
                    BinOp::Add(_) => Ok(left + right),
                    BinOp::Sub(_) => Ok(left - right),
                    BinOp::Mul(_) => Ok(left * right),
                    _ => Err(unknown()),
                }
            }
            Expr::MethodCall(call) => {
                let own = self.value(&call.receiver)?;
                let arguments: Vec<_> = call.args.iter().collect();
                match (call.method.to_string().as_str(), arguments.as_slice()) {
                    ("recip", []) => Ok(1.0 / own),
                    ("like", [constant]) => literal(constant).ok_or_else(unknown),
                    _ => Err(unknown()),
                }
            }
            _ => Err(unknown()),
        }
    }
}

/// A number as it is written.
fn literal(expr: &Expr) -> Option<f64> {
    match expr {
        Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => literal(&unary.expr).map(|x| -x),
        Expr::Lit(ExprLit { lit: Lit::Float(digits), .. }) => digits.base10_parse().ok(),
        _ => None,
    }
}

fn shown(tokens: &impl ToTokens) -> String {
    tokens.to_token_stream().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evaluated(text: &str) -> Result<Vec<(String, f64)>, BakeError> {
        let p = [("a".to_owned(), 0.1), ("b".to_owned(), 0.2)].into();
        evaluate(&syn::parse_file(text).unwrap(), "f", &p)
    }

    #[test]
    fn each_operation_is_rounded_by_itself() {
        let found = evaluated(
            "fn f() -> R { let x = -(p.a + p.b) * p.a; let y = x + p.b * p.b; \
                        R { y, z: y.like(0.5).recip(), w: x - y } }",
        );
        let x = -(0.1 + 0.2) * 0.1;
        let y = x + 0.2 * 0.2;
        let names = ["y", "z", "w"].map(str::to_owned);
        let expected: Vec<_> = names.into_iter().zip([y, 2.0, x - y]).collect();
        assert_eq!(found.unwrap(), expected);
    }

    #[test]
    fn what_no_kernel_has_is_an_error() {
        for text in
            ["fn f() -> R { R { x: p.a / p.b } }", "fn f() -> R { R { x: p.c } }", "fn g() {}"]
        {
            assert!(matches!(evaluated(text), Err(BakeError::Statement(..))), "{text}");
        }
    }
}
