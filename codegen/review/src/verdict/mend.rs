//! Mends: pieces of the printed text replaced, token by token.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::fault::Fault;

/// `body` with each printed piece replaced by the right one; for `0` the right one is added to the
/// value. A piece must occur in the body exactly once.
pub(super) fn mended(body: &str, changes: &[(String, String)]) -> Result<String, Fault> {
    let mut text = tokens(body)?;
    for (printed, right) in changes {
        let right = tokens(right)?;
        if printed == "0" {
            // The value is what follows the last `let`.
            let value = text.iter().rposition(|token| token == ";").map_or(0, |end| end + 1);
            text.insert(value, "(".to_owned());
            text.extend([")", "+", "("].map(str::to_owned));
            text.extend(right);
            text.push(")".to_owned());
            continue;
        }
        let piece = tokens(printed)?;
        let places: Vec<_> =
            (0..text.len()).filter(|place| text[*place..].starts_with(&piece)).collect();
        let [place] = places[..] else { return Err(Fault::Found(printed.clone(), places.len())) };
        text.splice(place..place + piece.len(), right);
    }
    Ok(text.join(" "))
}

/// The tokens of a piece of code, brackets among them.
fn tokens(code: &str) -> Result<Vec<String>, Fault> {
    let stream: TokenStream = code.parse().map_err(|_| Fault::Code(code.to_owned()))?;
    let mut found = Vec::new();
    flatten(stream, &mut found);
    Ok(found)
}

fn flatten(stream: TokenStream, found: &mut Vec<String>) {
    for token in stream {
        let TokenTree::Group(group) = token else {
            found.push(token.to_string());
            continue;
        };
        let (open, close) = match group.delimiter() {
            Delimiter::Parenthesis => ("(", ")"),
            Delimiter::Bracket => ("[", "]"),
            Delimiter::Brace => ("{", "}"),
            Delimiter::None => ("", ""),
        };
        found.push(open.to_owned());
        flatten(group.stream(), found);
        found.push(close.to_owned());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn change(printed: &str, right: &str) -> [(String, String); 1] {
        [(printed.to_owned(), right.to_owned())]
    }

    #[test]
    fn a_piece_is_replaced_whatever_its_spaces() {
        let made = mended("let s = sin(a);\nb*s\n    - c*(d + s)", &change("(d+s)", "d"));
        assert_eq!(made.unwrap(), "let s = sin ( a ) ; b * s - c * d");
    }

    #[test]
    fn what_is_added_is_added_to_the_value() {
        let made = mended("let s = sin(a);\nb - s", &change("0", "-c")).unwrap();
        assert_eq!(made, "let s = sin ( a ) ; ( b - s ) + ( - c )");
    }

    #[test]
    fn a_piece_that_stands_there_twice_or_not_at_all_is_named() {
        assert_eq!(mended("a*b + a*b", &change("a*b", "c")), Err(Fault::Found("a*b".into(), 2)));
        assert_eq!(mended("a*b", &change("b*a", "c")), Err(Fault::Found("b*a".into(), 0)));
        assert_eq!(mended("a*b", &change("(b", "c")), Err(Fault::Code("(b".into())));
    }
}
