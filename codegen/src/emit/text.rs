//! Pieces of text: formatted statements, literals, wrapped comments.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote;

/// A line of emitted text is at most this wide.
pub(super) const LINE: usize = 100;
/// Comments are wrapped here.
pub(super) const COMMENT: usize = 90;

/// Statements as formatted lines without indentation.
pub(super) fn pretty(statements: &[TokenStream]) -> Vec<String> {
    let function = quote!(fn section() { #(#statements)* });
    let file = syn::parse2(function).expect("statements are Rust");
    let text = prettyplease::unparse(&file);
    let lines: Vec<_> = text.lines().collect();
    lines[1..lines.len() - 1].iter().map(|line| line[4..].to_owned()).collect()
}

/// The text with its wide lines broken within their only string, which stays the same.
pub(super) fn within_lines(text: &str) -> String {
    let lines = text.lines().map(|line| {
        let quotes = line.matches('"').count();
        let comment = line.trim_start().starts_with("//");
        let wide = line.chars().count() > LINE && quotes == 2 && !line.contains('\\') && !comment;
        if wide { broken(line) } else { line.to_owned() }
    });
    let mut broken = lines.collect::<Vec<_>>().join("\n");
    if text.ends_with('\n') {
        broken.push('\n');
    }
    broken
}

/// A line in several: the string goes on after a backslash.
fn broken(line: &str) -> String {
    let opened = line.find('"').map_or(0, |at| line[..at].chars().count() + 1);
    let mut lines = vec![String::new()];
    for word in line.split_inclusive(' ') {
        let last = lines.last_mut().expect("there is a first line");
        if last.chars().count() + word.chars().count() < LINE || last.trim().is_empty() {
            last.push_str(word);
        } else {
            last.push('\\');
            lines.push(format!("{}{word}", " ".repeat(opened)));
        }
    }
    lines.join("\n")
}

/// What the first line of an item between empty lines begins with: all but imports and types.
const APART: [&str; 6] = ["///", "#[", "const ", "fn ", "impl", "pub "];

/// Items as formatted text, with the empty lines between them that tokens do not have.
///
/// # Panics
/// When the tokens are no items of Rust.
#[must_use]
pub fn pretty_items(items: TokenStream) -> String {
    let file = syn::parse2(items).expect("the items are Rust");
    let text = prettyplease::unparse(&file);
    let mut lines: Vec<&str> = Vec::new();
    for line in text.lines() {
        let ended = lines.last().is_some_and(|last| last.ends_with([';', '}']));
        if ended && APART.iter().any(|start| line.trim_start().starts_with(start)) {
            lines.push("");
        }
        lines.push(line);
    }
    lines.join("\n")
}

/// A name.
pub(super) fn ident(name: impl AsRef<str>) -> Ident {
    Ident::new(name.as_ref(), Span::call_site())
}

/// Documentation in lines of at most `width` characters; an empty line separates paragraphs.
pub(super) fn documented(text: &str, width: usize) -> TokenStream {
    let paragraphs: Vec<_> = text.split("\n\n").map(|text| wrapped(text, width)).collect();
    let lines = paragraphs.join(&String::new());
    let lines = lines.iter().map(|line| spaced(line));
    quote!(#(#[doc = #lines])*)
}

/// A structure literal, on one line where it fits beside as many columns as are `taken`.
pub(super) fn literal(name: &str, fields: &[(String, String)], taken: usize) -> Vec<String> {
    let shown = |(field, value): &(String, String)| {
        if field == value { field.clone() } else { format!("{field}: {value}") }
    };
    let shown: Vec<_> = fields.iter().map(shown).collect();
    let line = format!("{name} {{ {} }}", shown.join(", "));
    if line.len() + taken <= LINE && !line.contains('\n') {
        return vec![line];
    }
    let mut lines = vec![format!("{name} {{")];
    for field in shown {
        lines.extend(format!("{field},").lines().map(|line| format!("    {line}")));
    }
    lines.push("}".to_owned());
    lines
}

/// A documentation line, to follow its slashes.
pub(super) fn spaced(line: &str) -> String {
    if line.is_empty() { String::new() } else { format!(" {line}") }
}

/// Words in lines of at most `width` characters.
#[must_use]
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = vec![String::new()];
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) if line.chars().count() + 1 + word.chars().count() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_owned()),
        }
    }
    lines
}

/// The text with a capital first letter.
#[must_use]
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

/// Fowler-Noll-Vo hash of the inputs, as the header shows it.
pub(super) fn fnv1a64(text: &str) -> String {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    format!("{:016x}", text.bytes().fold(0xcbf2_9ce4_8422_2325, step))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_short_literal_stands_on_one_line() {
        let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
        let fields = [pair("x", "x"), pair("y", "p.y")];
        assert_eq!(literal("P", &fields, 4), ["P { x, y: p.y }"]);
        assert_eq!(literal("P", &fields, 86), ["P {", "    x,", "    y: p.y,", "}"]);
    }

    #[test]
    fn items_stand_apart_and_imports_do_not() {
        let doc = documented("One two.\n\nThree.", 8);
        let items = quote! {
            use a::B;
            use c::D;
            #doc
            struct E { #[doc = " Field."] x: F, #[doc = " Field."] y: G }
            impl E { type T = F; type U = G; fn f() {} fn g() {} }
        };
        let expected = "use a::B;\nuse c::D;\n\n\
            /// One two.\n///\n/// Three.\nstruct E {\n\
            \x20   /// Field.\n    x: F,\n    /// Field.\n    y: G,\n}\n\n\
            impl E {\n    type T = F;\n    type U = G;\n\n    fn f() {}\n\n    fn g() {}\n}";
        assert_eq!(pretty_items(items), expected);
    }

    #[test]
    fn a_wide_string_is_broken_and_stays_the_same() {
        let words = ["some words"; 20].join(" ");
        let text = format!("    const MEANING: &str = \"{words}\";\n");
        let broken = within_lines(&text);
        assert!(broken.lines().count() > 2 && broken.lines().all(|line| line.len() <= LINE));
        let value = |text: &str| {
            let item: syn::ItemConst = syn::parse_str(text).unwrap();
            let syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(value), .. }) = *item.expr else {
                panic!("a string")
            };
            value.value()
        };
        assert_eq!(value(&broken), words);
        assert_eq!(within_lines("let a = 1;\n"), "let a = 1;\n");
    }

    #[test]
    fn words_are_wrapped_and_none_is_lost() {
        assert_eq!(wrapped("one two three", 7), ["one two", "three"]);
    }

    #[test]
    fn the_hash_is_fnv1a() {
        assert_eq!(fnv1a64("a"), "af63dc4c8601ec8c");
    }
}
