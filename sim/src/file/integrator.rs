//! What a file says of the steps of one integrator gives way to another integrator: of a file based on it, or of an override.

use super::document::{Entry, Node, Table, Value};

/// Of a table that names an integrator, the key that only the other integrator has.
fn key_of_other(run: &Table) -> Option<&'static str> {
    match run.text("integrator")? {
        "rk4" => Some("tolerance"),
        "dop853" => Some("step"),
        _ => None,
    }
}

/// Removes the key of another integrator than that of a table above.
pub(super) fn give_way(below: &mut Table, above: &Table) {
    if let Some(other) = key_of_other(above) {
        below.entries.retain(|entry| entry.key != other);
    }
}

/// The same in a tree with overrides, where they name the integrator: texts below number `files` are those of files.
pub(super) fn override_steps(tree: &mut Node, files: usize) {
    let Value::Table(table) = &mut tree.value else { return };
    let Some(Value::Table(run)) = table.get_mut("run").map(|entry| &mut entry.node.value) else {
        return;
    };
    let is_overridden = |entry: &Entry| entry.node.span.source >= files;
    if run.get("integrator").is_some_and(is_overridden) {
        let other = key_of_other(run);
        run.entries.retain(|entry| Some(entry.key.as_str()) != other || is_overridden(entry));
    }
}

#[cfg(test)]
mod tests {
    use super::super::diagnostic::{Diagnostics, Numbers};
    use super::super::document::parse;
    use super::super::load::load_file;
    use super::super::overrides::apply;
    use super::*;

    fn keys_of_run(tree: &Node) -> String {
        let Value::Table(tree) = &tree.value else { panic!("a file is a table") };
        let Some(Value::Table(run)) = tree.get("run").map(|entry| &entry.node.value) else {
            panic!("no [run]")
        };
        let keys: Vec<_> = run.entries.iter().map(|entry| entry.key.as_str()).collect();
        keys.join(" ")
    }

    #[test]
    fn an_integrator_takes_away_what_the_file_says_of_the_steps_of_the_other() {
        let run = |text: &str, overrides: &[&str]| {
            let mut reports = Diagnostics::default();
            let mut tree = parse("bus.toml", text, Numbers::WithUnits, &mut reports);
            let overrides: Vec<_> = overrides.iter().map(|&text| text.to_owned()).collect();
            apply(&mut tree, (&overrides, Numbers::WithUnits), &mut reports);
            keys_of_run(&tree)
        };
        let (dop853, rk4) =
            ("[run]\ntolerance = 1e-9\n", "[run]\nintegrator = \"rk4\"\nstep = \"1 ms\"\n");
        for (file, overrides, left) in [
            (dop853, &["run.step = \"1 s\"", "run.integrator = \"rk4\""][..], "step integrator"),
            (dop853, &["run.integrator = \"rk4\""][..], "integrator"),
            (rk4, &["run.integrator = \"dop853\""][..], "integrator"),
            // What the command line itself says stays, as an error.
            (rk4, &["run.integrator = \"dop853\"", "run.step = \"2 s\""][..], "integrator step"),
            (rk4, &["run.step = \"2 s\""][..], "integrator step"),
        ] {
            assert_eq!(run(file, overrides), left, "{overrides:?}");
        }
    }

    #[test]
    fn an_integrator_takes_away_what_a_base_says_of_the_steps_of_the_other() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("bus.toml"), "[run]\nduration = \"1 s\"\ntolerance = 1e-9\n")
            .expect("written");
        let text = "base = \"bus.toml\"\n[run]\nintegrator = \"rk4\"\nstep = \"1 ms\"\n";
        std::fs::write(path("a.toml"), text).expect("written");
        let tree = load_file(&path("a.toml"), &mut Diagnostics::default());
        assert_eq!(keys_of_run(&tree), "duration integrator step");
    }
}
