//! The paper's equation numbers, as tags name them: `(14)`, `(49)-(52)`, `(32 first line)`.

/// An equation's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Number(pub(super) u16);

impl Number {
    /// `(12), (13)`, in order and once each.
    pub(super) fn list(numbers: &[Self]) -> String {
        let mut numbers = numbers.to_vec();
        numbers.sort_unstable();
        numbers.dedup();
        numbers.iter().map(|Self(n)| format!("({n})")).collect::<Vec<_>>().join(", ")
    }
}

/// Every number that a tag names; a range is spelled out, an assertion before a number is none.
pub(super) fn numbers(tag: &str) -> Vec<Number> {
    let ends: Vec<u16> = tag
        .split('-')
        .filter_map(|part| part.trim_start_matches('(').split([' ', ')']).next()?.parse().ok())
        .collect();
    match ends[..] {
        [first, last] => (first..=last).map(Number).collect(),
        [only] => vec![Number(only)],
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_name_numbers() {
        let of = |tag: &str| numbers(tag).into_iter().map(|Number(n)| n).collect::<Vec<_>>();
        assert_eq!(of("(14)"), [14]);
        assert_eq!(of("(49)-(52)"), [49, 50, 51, 52]);
        assert_eq!(of("(32 first line)"), [32]);
        assert_eq!(of("(before 67)"), [0_u16; 0]);
        assert_eq!(of("(step)"), [0_u16; 0]);
    }
}
