//! Lists between brackets, as `rustfmt` lays them out.

use super::text::{LINE, wrapped};

/// Items between brackets, on one line where they fit, otherwise one below the other.
pub(super) fn fitted(indent: usize, open: &str, items: &[String], close: &str) -> String {
    let pad = " ".repeat(indent);
    let line = format!("{pad}{open}{}{close}", line_inside(open, items));
    if line.chars().count() <= LINE && !line.contains('\n') {
        return line;
    }
    // What follows `=` may stand by itself on the next line.
    if let (Some((left, right)), false) = (open.split_once(" = "), line.contains('\n')) {
        let alone = format!("{pad}    {right}{}{close}", line_inside(open, items));
        if alone.chars().count() <= LINE {
            return format!("{pad}{left} =\n{alone}");
        }
    }
    // A chained call stands on its own line.
    let close = close.replacen("].", "]\n.", 1);
    if let ([one], true) = (items, open.ends_with('[')) {
        return format!("{pad}{open}{}{close}", one.replace('\n', &format!("\n{pad}")));
    }
    let below = items.iter().map(|item| format!("    {},", item.replace('\n', "\n    ")));
    let all = std::iter::once(open.to_owned()).chain(below).chain([close]);
    let text = all.collect::<Vec<_>>().join("\n");
    text.lines().map(|line| format!("{pad}{line}")).collect::<Vec<_>>().join("\n")
}

/// Items behind a bracket, on one line.
fn line_inside(open: &str, items: &[String]) -> String {
    let inside = items.join(", ");
    if open.ends_with('{') { format!(" {inside} ") } else { inside }
}

/// Short names between brackets, as many on a line as fit.
pub(super) fn packed(open: &str, names: &[String], close: &str) -> String {
    let line = format!("{open}{}{close}", names.join(", "));
    if line.chars().count() <= LINE {
        return line;
    }
    let lines = wrapped(&format!("{},", names.join(", ")), LINE - 5);
    format!("{open}\n    {}\n{close}", lines.join("\n    "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(list: &[&str]) -> Vec<String> {
        list.iter().map(|name| (*name).to_owned()).collect()
    }

    #[test]
    fn what_fits_stands_on_one_line() {
        assert_eq!(fitted(4, "P {", &names(&["x", "y: 1"]), "}"), "    P { x, y: 1 }");
        assert_eq!(fitted(0, "f(", &names(&["x"]), ");"), "f(x);");
    }

    #[test]
    fn what_does_not_fit_stands_one_below_the_other() {
        let long = ["a".repeat(60), "b".repeat(60)];
        let (a, b) = (&long[0], &long[1]);
        assert_eq!(
            fitted(4, "f(", &long, ")"),
            format!("    f(\n        {a},\n        {b},\n    )")
        );
        let chained = format!("[\n    {a},\n    {b},\n]\n.into_iter()");
        assert_eq!(fitted(0, "[", &long, "].into_iter()"), chained);
    }

    #[test]
    fn a_value_that_fits_by_itself_stands_behind_its_name() {
        let items = ["a".repeat(40), "b".repeat(40)];
        let (a, b) = (&items[0], &items[1]);
        let expected = format!("let name =\n    Long {{ {a}, {b} }};");
        assert_eq!(fitted(0, "let name = Long {", &items, "};"), expected);
    }

    #[test]
    fn names_are_packed_and_none_is_lost() {
        assert_eq!(packed("use a::{", &names(&["b", "c"]), "};"), "use a::{b, c};");
        let long = ["One", "Two", "Three"].map(|name| name.repeat(12));
        let [one, two, three] = &long;
        let expected = format!("use a::{{\n    {one}, {two},\n    {three},\n}};");
        assert_eq!(packed("use a::{", &long, "};"), expected);
    }
}
