//! [`Names`]: names of variables that every importer takes: at most 55 characters of `[A-Za-z0-9_]`, each once.

use std::collections::HashSet;

/// Most characters of a name: what Simulink has for a parameter, less its own.
pub(super) const LONGEST: usize = 55;

/// The names that are given already.
#[derive(Clone, Debug, Default)]
pub(super) struct Names(HashSet<String>);

impl Names {
    /// A name that begins with that of a device, which is shortened where both are too long, and numbered where the name
    /// is given already.
    pub(super) fn of_device(&mut self, device: &str, what: &str) -> String {
        let of_number = |number: u32| {
            let number = if number == 1 { String::new() } else { format!("_{number}") };
            let room = LONGEST.saturating_sub(what.len() + 1 + number.len());
            let device: String = letters(device).chars().take(room).collect();
            format!("{device}{number}_{what}")
        };
        self.first(of_number)
    }

    /// The name of a state's derivative, without the first letters of the state's where that is too long.
    pub(super) fn of_derivative(&mut self, state: &str) -> String {
        self.first(|number| {
            let number = if number == 1 { String::new() } else { format!("_{number}") };
            let begins = format!("der{number}_");
            let excess = (begins.len() + state.len()).saturating_sub(LONGEST);
            begins + state.get(excess..).unwrap_or_default()
        })
    }

    /// A name of the hub or of the whole spacecraft.
    pub(super) fn of_hub(&mut self, what: &str) -> String {
        self.first(|number| if number == 1 { what.to_owned() } else { format!("{what}_{number}") })
    }

    fn first(&mut self, of_number: impl Fn(u32) -> String) -> String {
        let mut number = 1;
        let mut name = of_number(number);
        while !self.0.insert(name.clone()) {
            number += 1;
            name = of_number(number);
        }
        name
    }
}

/// A text with only letters that a name has; begins with none but a letter.
fn letters(text: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let text: String = text.chars().map(plain).collect();
    if text.starts_with(|c: char| c.is_ascii_alphabetic()) { text } else { format!("n{text}") }
}

/// The name of a scenario as an identifier of C.
pub(super) fn identifier(name: &str) -> String {
    letters(name).chars().take(LONGEST).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_short_and_given_once() {
        let long = "w".repeat(100);
        let mut names = Names::default();
        let found = [
            names.of_device(&long, "wheel_inertia_xx"),
            names.of_device(&(long.clone() + "x"), "wheel_inertia_xx"),
            names.of_device("a", "b_c"),
            names.of_device("a_b", "c"),
            names.of_hub("a_b_c"),
        ];
        let state = found[0].clone();
        let derivatives = [names.of_derivative(&state), names.of_derivative(&state)];
        assert!(derivatives.iter().all(|name| name.len() == LONGEST), "{derivatives:?}");
        assert_ne!(derivatives[0], derivatives[1]);
        assert_eq!(found[0].len(), LONGEST);
        assert_eq!(found[1].len(), LONGEST);
        assert_eq!(found[2..], ["a_b_c", "a_b_2_c", "a_b_c_2"].map(str::to_owned));
        let plain = |name: &String| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        assert!(found.iter().all(plain), "{found:?}");
        let different: HashSet<_> = found.iter().collect();
        assert_eq!(different.len(), found.len());
    }

    #[test]
    fn a_scenario_of_any_name_is_an_identifier() {
        assert_eq!(identifier("table1-printed-free"), "table1_printed_free");
        assert_eq!(identifier("3-wheels"), "n3_wheels");
        assert_eq!(identifier(&"a".repeat(100)).len(), LONGEST);
    }
}
