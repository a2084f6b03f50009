//! Special cases: `given j_12 = 0, j_33 = j_22, theta = 0;` at the head of a block.

use super::ReadError;
use crate::graph::{Expr, Graph, Node, SymbolId};

/// What a block is given, and the lines of its body.
type Given<'t> = (Vec<(String, String)>, &'t [&'t str]);

/// Takes a `given` line, which may be wrapped, from the head of a block's lines.
pub(super) fn parse_given<'t>(lines: &'t [&'t str]) -> Result<Given<'t>, ReadError> {
    if !lines.first().is_some_and(|line| line.starts_with("given ")) {
        return Ok((Vec::new(), lines));
    }
    let last = lines.iter().position(|line| line.trim_end().ends_with(';'));
    let last = last.ok_or_else(|| ReadError::Given(lines.join(" ")))?;
    let text = lines[..=last].join(" ");
    let list = text.trim_end().trim_start_matches("given ").trim_end_matches(';');
    let pair = |item: &str| match item.split_once(" = ") {
        Some((symbol, value)) => Ok((symbol.trim().to_owned(), value.trim().to_owned())),
        None => Err(ReadError::Given(item.trim().to_owned())),
    };
    Ok((list.split(',').map(pair).collect::<Result<_, _>>()?, &lines[last + 1..]))
}

/// The substitutions of a special case: a symbol becomes a number or another symbol, and an angle
/// that is zero takes its sine and cosine with it.
///
/// # Errors
/// When a name is no symbol, a value is neither, or an angle is given another value than zero.
pub(super) fn substitutions<'g>(
    graph: &'g Graph,
    given: &[(String, String)],
) -> Result<Vec<(SymbolId, Expr<'g>)>, ReadError> {
    let symbol = |name: &str| match graph.find(name).map(Expr::node) {
        Some(Node::Symbol(id)) => Ok(id),
        _ => Err(ReadError::Unknown(name.to_owned())),
    };
    let mut made = Vec::new();
    for (name, value) in given {
        let angle = [format!("sin_{name}"), format!("cos_{name}")];
        if let [Ok(sin), Ok(cos)] = angle.map(|name| symbol(&name)) {
            if value != "0" {
                return Err(ReadError::Given(format!("{name} = {value}")));
            }
            made.extend([(sin, graph.zero()), (cos, graph.constant(1))]);
            continue;
        }
        let value = match value.parse::<i32>() {
            Ok(number) => graph.constant(i64::from(number)),
            Err(_) => graph.find(value).ok_or_else(|| ReadError::Unknown(value.clone()))?,
        };
        made.push((symbol(name)?, value));
    }
    Ok(made)
}

/// `components` in the special case.
///
/// # Errors
/// As `substitutions`.
pub fn in_the_case<'g>(
    graph: &'g Graph,
    given: &[(String, String)],
    components: Vec<(String, Expr<'g>)>,
) -> Result<Vec<(String, Expr<'g>)>, ReadError> {
    if given.is_empty() {
        return Ok(components);
    }
    let made = substitutions(graph, given)?;
    Ok(components.into_iter().map(|(label, e)| (label, e.with(&made))).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graph::Stage;

    fn vanishes(e: Expr<'_>, given: &[(&str, &str)]) -> Result<bool, ReadError> {
        let own = |(a, b): &(&str, &str)| ((*a).to_owned(), (*b).to_owned());
        let given: Vec<_> = given.iter().map(own).collect();
        let made = in_the_case(e.graph(), &given, vec![(String::new(), e)])?;
        Ok(made[0].1.is_zero())
    }

    #[test]
    fn symbols_and_angles_take_their_values_together() {
        let g = Graph::new();
        let [a, b] = ["a", "b"].map(|name| g.symbol(name, Stage::Parameter));
        let (s, c) = g.angle("q", g.symbol("q_dot", Stage::Rate));
        let e = a * s + c * (a - b);
        assert_eq!(vanishes(e, &[("a", "b"), ("q", "0")]), Ok(true));
        assert_eq!(vanishes(e, &[("a", "b"), ("b", "a"), ("q", "0")]), Ok(false));
        assert_eq!(vanishes(a - b, &[("a", "1"), ("b", "1")]), Ok(true));
    }

    #[test]
    fn what_is_no_symbol_or_no_right_angle_is_refused() {
        let g = Graph::new();
        let a = g.symbol("a", Stage::Parameter);
        let _ = g.angle("q", g.symbol("q_dot", Stage::Rate));
        assert_eq!(vanishes(a, &[("x", "0")]), Err(ReadError::Unknown("x".into())));
        assert_eq!(vanishes(a, &[("a", "x")]), Err(ReadError::Unknown("x".into())));
        assert_eq!(vanishes(a, &[("q", "1")]), Err(ReadError::Given("q = 1".into())));
    }
}
