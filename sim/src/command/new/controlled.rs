//! Examples of `new` with a controller.

const CONTROLLER: &str = include_str!("controller.toml");

/// The examples that have a controller.
pub(super) const CONTROLLED: [&str; 3] = ["gyros", "pyramid", "wheels"];

/// An example with a controller: motors have no torque of their own.
pub(super) fn controlled(mut text: String, what: &str) -> Option<String> {
    for (old, new) in [
        ("title = \"A first spacecraft\"", "title = \"A first slew\""),
        (
            "torque = { sine = \"0.2 N m\", frequency = \"0.5 Hz\" }",
            "# Of its motor, which the controller commands.\ntorque_limit = \"10 N m\"",
        ),
        (
            "# Of its motor; a torque turns the hub the other way.\ntorque = \"0 N m\"\n",
            "# Of its motor, which the controller commands.\n",
        ),
        ("duration = \"10 s\"", "duration = \"90 s\""),
        ("tolerance = 1e-11", "tolerance = 1e-9"),
        (
            "# Ten samples in a turn of the wheel, or more.\nrate = \"1 kHz\"",
            "# Of what the controller does; a turn of the wheel is not resolved.\nrate = \"50 Hz\"",
        ),
        (
            "name = \"rate\"\nquantity = \"omega\"\nstatistic = \"peak\"\nlimit = \"1 deg/s\"",
            "name = \"pointing after the slew\"\nquantity = \"aocs.error\"\nstatistic = \"peak\"\n\
             from = \"75 s\"\nlimit = \"0.02 deg\"",
        ),
        (
            "\n# What happens over time, for example:",
            "\n# Something else takes the place of the controller, for example:",
        ),
    ] {
        text = text.replace(old, new);
    }
    if what == "wheels" {
        text = text.replace("rate = \"3000 rpm\"", "rate = \"1000 rpm\"");
    }
    let controller = if what == "wheels" {
        CONTROLLER.to_owned()
    } else {
        let servo = "# Torques of motors are computed anew from the commands in force: at 50 Hz the line of the wheels would be a constant\n\
                     # rate of the gimbals, and the nutation of wheel and gimbals above half of the rate.\nservo = { rate = \"200 Hz\" }\n";
        CONTROLLER.replace("# Small errors", &format!("{servo}# Small errors"))
    };
    let at = text.find("\n# Something else takes the place")?;
    text.insert_str(at, &controller);
    Some(text)
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;
    use std::path::Path;

    use super::super::example;
    use super::*;
    use crate::engine::run;
    use crate::file::from_toml;
    use crate::record::Statistics;

    /// What is commented out of a controller is read.
    #[test]
    fn examples_with_a_controller_slew() {
        for what in CONTROLLED {
            let text = example(what).and_then(|text| controlled(text, what)).expect("an example");
            let mut sensors = text.lines().skip_while(|line| *line != "# [controller.sensors]");
            let sensors: Vec<_> =
                sensors.by_ref().map_while(|line| line.strip_prefix("# ")).collect();
            assert_eq!(sensors.len(), 7, "{what}");
            let at = text.find("# [controller.sensors]").expect("there");
            let (before, after) = text.split_at(at);
            let whole = format!("{before}{}\n{after}", sensors.join("\n"));
            let read = from_toml(what, &whole, Path::new(""));
            let (scenario, _) = read.unwrap_or_else(|errors| panic!("{what}:\n{errors}"));
            assert!(scenario.controllers[0].estimator.is_some());
            let (scenario, warnings) =
                from_toml(what, &text, Path::new("")).unwrap_or_else(|errors| panic!("{errors}"));
            assert!(warnings.all.is_empty(), "{what}: {warnings}");
            assert!(scenario.check().is_empty(), "{what}");
        }
    }

    /// The examples do what they say: they turn and hold.
    #[test]
    #[ignore = "long: three runs of 90 s"]
    fn examples_with_a_controller_meet_their_requirement() {
        for what in CONTROLLED {
            let text = example(what).and_then(|text| controlled(text, what)).expect("an example");
            let read = from_toml(what, &text, Path::new(""));
            let (scenario, _) = read.unwrap_or_else(|errors| panic!("{what}:\n{errors}"));
            let mut statistics = Statistics::new(&scenario.requirements);
            let ended = run(&scenario, &mut statistics, &mut |_| ControlFlow::Continue(()));
            assert!(ended.is_ok_and(|outcome| outcome.end.is_complete()), "{what}");
            let [verdict] = statistics.verdicts() else { panic!("{what}: one requirement") };
            assert!(verdict.is_met(), "{what}: {:?}", verdict.value);
        }
    }
}
