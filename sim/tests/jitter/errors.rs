//! Errors of budgets: each mistake is reported once, with its place in the budget.

use std::path::Path;

use precess::file::{Diagnostics, budget_from_toml, check_budget_names, from_toml};

const BUDGET: &str = "format = 1\nscenario = \"wheel.toml\"\n[speed]\nfrom = \"600 rpm\"\nto = \"900 rpm\"\n\
                      [[line_of_sight]]\nname = \"camera\"\nnode = \"hub\"\n\
                      [[requirement]]\nline_of_sight = \"camera\"\nmetric = \"smear\"\nexposure = \"1 ms\"\n\
                      limit = \"1 urad\"\n";

/// Line and message of each error.
fn places(found: &Diagnostics) -> Vec<(usize, String)> {
    let line = |text: &str, at: usize| {
        text[..at].lines().count() + usize::from(text[..at].ends_with('\n'))
    };
    let place = |of: &precess::file::Diagnostic| {
        let span = of.span.as_ref().expect("a place");
        (line(&found.sources[span.source].text, span.range.start).max(1), of.message.clone())
    };
    found.all.iter().map(place).collect()
}

/// A budget in a folder with its scenario.
fn with_budget<T>(text: &str, then: impl FnOnce(&Path) -> T) -> T {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("wheel.toml"), "").expect("written");
    let path = folder.path().join("budget.toml");
    std::fs::write(&path, text).expect("written");
    then(&path)
}

/// Messages of a budget in which a text is replaced.
fn messages(from: &str, to: &str) -> Vec<String> {
    assert!(BUDGET.contains(from), "{from}");
    let found = with_budget(&BUDGET.replace(from, to), |path| budget_from_toml(path, &[]));
    let found = found.expect_err(to);
    println!("{found}");
    found.all.into_iter().map(|of| of.message).collect()
}

#[test]
fn a_misspelt_name_has_no_further_errors() {
    assert!(with_budget(BUDGET, |path| budget_from_toml(path, &[])).is_ok());
    for (from, to, message) in [
        ("[[line_of_sight]]", "[[line_of_site]]", "unknown key `line_of_site`"),
        ("node =", "nod =", "unknown key `line_of_sight.camera.nod`"),
        ("\nname =", "\nnmae =", "unknown key `line_of_sight.0.nmae`"),
        ("\"smear\"", "\"smeer\"", "`requirement.0.metric` is \"smeer\""),
        ("metric =", "metrik =", "unknown key `requirement.0.metrik`"),
        ("limit =", "limt =", "unknown key `requirement.0.limt`"),
        ("[speed]", "[sped]", "unknown key `sped`"),
    ] {
        assert_eq!(messages(from, to), [message], "{to}");
    }
}

#[test]
fn an_error_elsewhere_is_reported_beside_a_misspelt_name() {
    let to = "\"smeer\"\nband = \"2, 1 Hz\"\nextra = 1";
    let found = messages("\"smear\"", to);
    assert_eq!(found, ["`requirement.0.metric` is \"smeer\"", "unknown key `requirement.0.extra`"]);
    let found = messages("[[line_of_sight]]\n", "phases = 3\n[[line_of_site]]\n");
    assert_eq!(found, ["unknown key `speed.phases`", "unknown key `line_of_site`"]);
    // What the metric has no use for, and what is sought among lines of sight that were read.
    let found = messages("\"smear\"", "\"rms\"");
    assert_eq!(found, ["`exposure` has no use in the metric of this requirement"]);
    let found = messages("line_of_sight = \"camera\"", "line_of_sight = \"telescope\"");
    assert_eq!(found, ["`line_of_sight` names no line of sight"]);
}

#[test]
fn a_range_of_speeds_that_falls_is_shown_with_both_values() {
    assert_eq!(
        messages("900 rpm", "500 rpm"),
        ["`speed.from` is 600 rpm, which is not below `speed.to`, 500 rpm"]
    );
    assert_eq!(
        messages("600 rpm", "0 rad/s"),
        ["`speed.from` is 0 rad/s; a wheel at rest has no tones"]
    );
}

#[test]
fn names_that_the_scenario_does_not_have_are_shown_in_the_budget() {
    let scenario = "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n[[device]]\nname = \"rw\"\n\
                    kind = \"reaction_wheel\"\nimbalance.static = \"1 g cm\"\n[device.wheel]\nmass = \"1 kg\"\n\
                    inertia = \"2, 1, 1 g m^2\"\nrate = \"900 rpm\"\n[run]\nduration = \"1 s\"\n";
    let (scenario, _) =
        from_toml("wheel", scenario, Path::new("")).unwrap_or_else(|errors| panic!("{errors}"));
    assert!(with_budget(BUDGET, |path| check_budget_names(path, &[], &scenario)).is_ok());
    let text = BUDGET
        .replace("node = \"hub\"", "node = \"hubb\"")
        .replace("\nto", "\nrotors = [\"rw.wheel\", \"rw.whele\"]\nto");
    let found = with_budget(&text, |path| check_budget_names(path, &[], &scenario));
    let found = found.expect_err("two wrong names");
    let expected = [
        (9, "no node of the scenario wheel is named `hubb`".to_owned()),
        (5, "no body of the scenario wheel is named `rw.whele`".to_owned()),
    ];
    assert_eq!(places(&found), expected);
    assert!(found.to_string().contains("did you mean `hub`?"), "{found}");
}

/// A budget where a scenario is wanted has one error, which says so.
#[test]
fn a_budget_that_is_read_as_a_scenario_is_named() {
    let found = from_toml("budget.toml", BUDGET, Path::new("")).expect_err("no scenario");
    let messages: Vec<_> = found.all.iter().map(|of| of.message.as_str()).collect();
    assert_eq!(messages, ["`line_of_sight` is of a jitter budget; this is read as a scenario"]);
    assert!(found.to_string().contains("run a budget by `precess jitter`"), "{found}");
}
