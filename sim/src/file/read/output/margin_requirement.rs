//! `[[requirement]]` with `margin`: what a margin of a controller's loop has to be at least.

use crate::file::keys::Keys;
use crate::scenario::{LoopMargin, MarginRequirement, SampledController, decibels};
use crate::units::Measure;

/// A table that has the key `margin`; of the only controller where none is named.
pub(super) fn margin_requirement(
    keys: &Keys<'_>,
    controllers: &[SampledController],
) -> Option<MarginRequirement> {
    let name = keys.text("name");
    if !keys.has("name") {
        keys.missing("name", "name = \"phase margin\"");
    }
    let margin = keys.choice("margin", &LoopMargin::WORDS);
    let controller = keys.text("controller");
    let first = controllers.first().map_or("", |of| of.name.as_str());
    if !keys.has("controller") && controllers.len() > 1 {
        keys.missing("controller", &format!("controller = \"{first}\""));
    }
    let example = match margin {
        Some(LoopMargin::Phase) => "least = \"30 deg\"",
        Some(LoopMargin::Delay) => "least = \"50 ms\"",
        Some(LoopMargin::Gain) | None => "least = \"6 dB\"",
    };
    if !keys.has("least") {
        keys.missing("least", example);
    }
    let least = match margin {
        Some(LoopMargin::Phase) => keys.quantity("least", Measure::ANGLE),
        Some(LoopMargin::Delay) => keys.quantity("least", Measure::TIME),
        Some(LoopMargin::Gain) => keys.text("least").and_then(|text| {
            let found = decibels(text);
            if found.is_none() {
                let message = format!("`{text}` is no gain margin");
                keys.error("least", message, "write decibels, not negative: `least = \"6 dB\"`");
            }
            found
        }),
        None => keys.text_or_list("least").map(|_| 0.0),
    };
    keys.finish();
    Some(MarginRequirement {
        name: name?.to_owned(),
        controller: controller.unwrap_or(first).to_owned(),
        margin: margin?,
        least: least?,
        written: keys.text_or_list("least")?.to_owned(),
    })
}

#[cfg(test)]
mod tests {
    use crate::file::{from_toml, to_toml};
    use crate::scenario::LoopMargin;

    const SCENARIO: &str = "format = 1\n[hub]\nmass = \"9 kg\"\ninertia = \"1, 1, 1 kg m^2\"\n\
        [run]\nduration = \"2 s\"\n[output]\nrate = \"10 Hz\"\n\
        [[device]]\nname = \"rw\"\nkind = \"balanced_reaction_wheel\"\n\
        wheel = { mass = \"1 kg\", inertia = \"2, 1, 1 g m^2\" }\n\
        [[controller]]\nname = \"aocs\"\nrate = \"10 Hz\"\n\
        law = { kind = \"rate_damping\", rate_gain = \"1 N m s\" }\n";

    fn read(keys: &str) -> Result<crate::scenario::Scenario, String> {
        let text = format!("{SCENARIO}[[requirement]]\nname = \"a\"\n{keys}\n");
        let read = from_toml("test", &text, "".as_ref());
        read.map(|(scenario, _)| scenario).map_err(|errors| errors.to_string())
    }

    #[test]
    fn least_margins_are_read_in_their_units_and_written_again() {
        for (keys, margin, least) in [
            ("margin = \"gain\"\nleast = \"6 dB\"", LoopMargin::Gain, 6.0),
            ("margin = \"phase\"\nleast = \"180 deg\"", LoopMargin::Phase, std::f64::consts::PI),
            ("margin = \"delay\"\nleast = \"50 ms\"", LoopMargin::Delay, 0.05),
        ] {
            let scenario = read(keys).expect(keys);
            let of = scenario.margin_requirements.first().expect("one");
            assert_eq!((of.margin, of.least, of.controller.as_str()), (margin, least, "aocs"));
            assert!(scenario.requirements.is_empty());
            let (again, _) = from_toml("test", &to_toml(&scenario), "".as_ref()).expect("read");
            assert_eq!(again.margin_requirements, scenario.margin_requirements);
        }
    }

    #[test]
    fn what_is_no_least_margin_is_an_error_with_a_remedy() {
        for (keys, part) in [
            ("margin = \"gain\"\nleast = \"6 deg\"", "write decibels, not negative"),
            ("margin = \"gain\"\nleast = \"-1 dB\"", "write decibels, not negative"),
            ("margin = \"phase\"\nleast = \"-1 deg\"", "is not 0 or above"),
            ("margin = \"delay\"", "add `least = \"50 ms\"`"),
            ("margin = \"phase\"\nleast = \"6 s\"", "deg"),
            ("margin = \"rise\"\nleast = \"6 s\"", "gain"),
            ("margin = \"gain\"\nleast = \"6 dB\"\nlimit = \"6 dB\"", "limit"),
            (
                "margin = \"gain\"\nleast = \"6 dB\"\ncontroller = \"acs\"",
                "no controller is named `acs`; write one of aocs",
            ),
        ] {
            let shown = read(keys).expect_err("an error");
            assert!(shown.contains(part), "{keys}: {shown}");
        }
    }
}
