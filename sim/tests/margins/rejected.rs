//! What has no margins, with the reason.

use precess::margins::analysis::{ControlLoop, chosen};

use super::{BUS, controller, read};

#[test]
fn what_has_no_margins_says_why() {
    let open = read(&format!("{BUS}[run]\nduration = \"1 s\"\n[output]\nrate = \"4 Hz\"\n"));
    let said = |text: String| text;
    let none = chosen(&open, None).expect_err("no controller").to_string();
    assert_eq!(said(none), "the scenario has no `[[controller]]`; add one");
    let closed = read(&format!("{BUS}{}", controller("")));
    let other = chosen(&closed, Some("acs")).expect_err("another name").to_string();
    assert_eq!(other, "no controller is named `acs`; write one of aocs");
    let of = |keys: &str| {
        let scenario = read(&format!("{BUS}{}", controller(keys)));
        let of = chosen(&scenario, None).expect("one").clone();
        ControlLoop::new(&scenario, &of, &[]).map(|_| ()).expect_err(keys).to_string()
    };
    let rate = of("servo = { rate = \"10 Hz\" }");
    assert_eq!(
        rate,
        "`servo.rate` is 10 Hz, no whole multiple of the 4 Hz of the samples: the loop does not repeat with a sample"
    );
}
