//! The fitted wheel as parts of a scenario: a `[[device]]` with its imbalance and, of a known rotor, its
//! bearings; and `[[source]]` tables of the other harmonics and of the broadband noise.
//!
//! A scenario takes both by `base = ["NAME-device.toml", "NAME-sources.toml"]`: tables of one name are merged,
//! so the scenario adds place, mount and rate. A rotor on bearings has
//!
//! ```text
//! k = m w_0², c = 2 zeta w_0 m                of slides, m the rotor's mass
//! k = I_r w_0², c = 2 zeta w_0 I_r            of tilts, I_r its moment of inertia across the axis
//! ```
//!
//! Coefficients are those without modes, so a source of them acts on the rotor of such a device; on a wheel
//! with rigid bearings they lack the amplification, and a comment says so.

use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write as _;

use super::phase::wrapped;
use super::{Coefficient, Estimate, Fitted, FittedMode, Group, Harmonic, Sense};

/// The rotor, where it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotor {
    /// kg.
    pub mass: f64,
    /// Moments of inertia about the spin axis and across it, kg m².
    pub inertia: [f64; 2],
}

/// A number as TOML reads it, to the digits that its interval leaves.
fn number(value: f64) -> String {
    let text = format!("{value:.5e}");
    text.parse::<f64>().map_or(text, |rounded| zmij::Buffer::new().format(rounded).to_owned())
}

fn interval(estimate: &Estimate, unit: &str) -> String {
    let [low, high] = estimate.interval;
    format!("95 %: {low:.4e} to {high:.4e} {unit}")
}

/// What the model does not explain, as comments.
fn remarks(fitted: &Fitted) -> String {
    let mut out = String::new();
    if !fitted.holds() {
        out.push_str("# THE MODEL DOES NOT HOLD: these numbers are not those of the wheel.\n");
    }
    for discrepancy in &fitted.discrepancies {
        // A record's name may have more than one line.
        let text = discrepancy.to_string().replace(char::is_control, " ");
        let _ = writeln!(out, "# {text}");
    }
    out
}

/// The device: imbalance, and bearings of a rotor that is known.
#[must_use]
pub fn device(fitted: &Fitted, name: &str, rotor: Option<&Rotor>) -> String {
    let imbalance = &fitted.imbalance;
    let mut out = String::from(
        "# Fitted from a measurement on a rigid table. Take it into a scenario by `base`, and add to the\n\
         # device of this name what is missing: position, mount, rate.\n",
    );
    out.push_str(&remarks(fitted));
    out.push_str("\n[[device]]\n");
    let phase = imbalance.phase.map_or(0.0, |phase| phase.value);
    let _ = writeln!(out, "name = \"{name}\"");
    let bearings = rotor.and_then(|rotor| bearings(fitted, rotor));
    if rotor.is_some() {
        let kind = if bearings.is_some() { "flexible_reaction_wheel" } else { "reaction_wheel" };
        let _ = writeln!(out, "kind = \"{kind}\"");
    }
    let _ = writeln!(out, "# U_s {}", interval(&imbalance.u_s, "kg m"));
    let _ = writeln!(out, "# U_d {}", interval(&imbalance.u_d, "kg m^2"));
    match &imbalance.phase {
        Some(phase) => {
            let _ = writeln!(out, "# phase {}", interval(phase, "rad"));
        }
        None => out.push_str("# phase unknown: force or torque is hidden by noise\n"),
    }
    match &imbalance.angle {
        Some(angle) => {
            let _ = writeln!(
                out,
                "# at the index the force of U_s is {} rad from the reference direction: wheel.angle",
                number(angle.value)
            );
        }
        None => out.push_str("# no index: the angle of the wheel is unknown\n"),
    }
    let _ = writeln!(
        out,
        "imbalance = {{ static = \"{} kg m\", dynamic = \"{} kg m^2\", phase = \"{} rad\" }}",
        number(imbalance.u_s.value),
        number(imbalance.u_d.value),
        number(phase)
    );
    if let Some(rotor) = rotor {
        let [axial, across] = rotor.inertia;
        out.push_str("\n[device.wheel]\n");
        let _ = writeln!(out, "mass = \"{} kg\"", number(rotor.mass));
        let across = number(across);
        let _ = writeln!(out, "inertia = \"{}, {across}, {across} kg m^2\"", number(axial));
    }
    out.push_str(bearings.as_deref().unwrap_or_default());
    if !fitted.modes.is_empty() {
        out.push_str("\n# internal modes\n");
    }
    for mode in &fitted.modes {
        let _ = writeln!(
            out,
            "# {}: {} Hz, zeta {}, I_s / I_r {}, share {}",
            mode.group,
            number(mode.frequency.value / (2.0 * PI)),
            number(mode.damping.value),
            number(mode.inertia_ratio.value),
            number(mode.share.value)
        );
    }
    out
}

/// The joints of the bearings: a mode of each, or locked; none without modes, or where a mode carries a share
/// only.
fn bearings(fitted: &Fitted, rotor: &Rotor) -> Option<String> {
    let of = |group: Group| -> Option<&FittedMode> {
        let mut modes = fitted.modes.iter().filter(|mode| mode.group == group);
        modes.next().filter(|mode| mode.mode.share == 1.0 && modes.next().is_none())
    };
    let groups = [Group::AxialForce, Group::RadialForce, Group::RadialTorque];
    let split = fitted.modes.iter().any(|m| groups.contains(&m.group) && of(m.group).is_none());
    if split || groups.iter().all(|group| of(*group).is_none()) {
        return None;
    }
    let mut out = String::new();
    for (joint, group, inertia, units) in [
        ("axial_slide", Group::AxialForce, rotor.mass, ["N/m", "N s/m"]),
        ("radial_slide_y", Group::RadialForce, rotor.mass, ["N/m", "N s/m"]),
        ("radial_slide_z", Group::RadialForce, rotor.mass, ["N/m", "N s/m"]),
        ("tilt_y", Group::RadialTorque, rotor.inertia[1], ["N m/rad", "N m s/rad"]),
        ("tilt_z", Group::RadialTorque, rotor.inertia[1], ["N m/rad", "N m s/rad"]),
    ] {
        let _ = writeln!(out, "\n[device.{joint}]");
        match of(group).map(|mode| mode.mode) {
            Some(mode) => {
                let stiffness = inertia * mode.frequency * mode.frequency;
                let damping = 2.0 * mode.damping * mode.frequency * inertia;
                let _ = writeln!(out, "stiffness = \"{} {}\"", number(stiffness), units[0]);
                let _ = writeln!(out, "damping = \"{} {}\"", number(damping), units[1]);
            }
            None => out.push_str("# no mode was found\nlocked = true\n"),
        }
    }
    Some(out)
}

/// The keys of a coefficient.
fn component(out: &mut String, c: &Coefficient) {
    let unit = c.group.coefficient_unit();
    let value = number(c.c.value);
    let note = interval(&c.c, unit);
    let kind = if c.group.is_torque() { "moment" } else { "force" };
    let mut key = |key: &str, phase: Option<f64>| {
        let _ = writeln!(out, "{key} = \"{value} {unit}\"  # {note}");
        if let Some(phase) = phase {
            let _ = writeln!(out, "phase.{key} = \"{} rad\"", number(wrapped(phase)));
        }
    };
    // cos(h theta + a) is sin(h theta + a + 90 deg).
    let phase = c.phase.map(|phase| phase.value + FRAC_PI_2);
    match (c.group.is_radial(), c.sense) {
        (false, _) => key(&format!("axial_{kind}"), phase),
        (true, Sense::Forward) => key(&format!("radial_{kind}"), phase),
        // z a quarter of a cycle before y: it turns against the wheel.
        (true, Sense::Backward) => {
            let y = phase.unwrap_or(0.0);
            key(&format!("{kind}_y"), Some(y));
            key(&format!("{kind}_z"), Some(y + FRAC_PI_2));
        }
    }
}

/// The sources on the device: harmonics but the imbalance, and broadband noise. This is the one function that
/// knows the keys of `[[source]]`.
#[must_use]
pub fn sources(fitted: &Fitted, name: &str, soft: bool) -> String {
    let mut out = String::from(
        "# Fitted from a measurement on a rigid table: C in C Omega^2 sin(h theta + phi), the wheel's own modes\n\
         # removed. x is the spin axis.\n",
    );
    if !soft && !fitted.modes.is_empty() {
        out.push_str(
            "# On a wheel with rigid bearings the amplification by the modes is missing.\n",
        );
    }
    // At h = 1 what turns with the wheel across its axis is the imbalance of the device.
    let of_device = |harmonic: &Harmonic, c: &Coefficient| {
        harmonic.number.value == 1.0 && c.group.is_radial() && c.sense == Sense::Forward
    };
    let shown = |harmonic: &Harmonic| -> Vec<Coefficient> {
        let own = harmonic.coefficients.iter().filter(|c| c.seen && !of_device(harmonic, c));
        own.copied().collect()
    };
    let lines = fitted.harmonics.iter().map(|harmonic| (harmonic, shown(harmonic)));
    let lines: Vec<_> = lines.filter(|(_, shown)| !shown.is_empty()).collect();
    if !lines.is_empty() {
        let on = if soft { format!("{name}.wheel") } else { name.to_owned() };
        let _ = write!(
            out,
            "\n[[source]]\nname = \"{name}_harmonics\"\non = \"{on}\"\nseed = 1\nmodes_removed = true\n\
             fundamental_removed = true\n"
        );
    }
    for (harmonic, shown) in &lines {
        // Components that turn backward have keys of their own axes, so they are another table.
        for backward in [false, true] {
            let turns = |c: &&Coefficient| c.group.is_radial() && c.sense == Sense::Backward;
            let own: Vec<_> = shown.iter().filter(|c| turns(c) == backward).collect();
            if own.is_empty() {
                continue;
            }
            let _ = writeln!(
                out,
                "\n[[source.harmonic]]\nnumber = {}  # {}",
                number(harmonic.number.value),
                interval(&harmonic.number, "").trim_end()
            );
            for c in own {
                component(&mut out, c);
            }
        }
    }
    for (group, bands) in fitted.floors.iter().filter(|(_, bands)| bands.len() > 1) {
        let middles: Vec<String> =
            bands.iter().map(|band| number((band.range[0] * band.range[1]).sqrt())).collect();
        let values: Vec<String> = bands.iter().map(|band| number(band.density.value)).collect();
        let (direction, kind, unit) = match group {
            Group::AxialForce => ("axial", "force", "N^2/Hz"),
            Group::RadialForce => ("radial", "force", "N^2/Hz"),
            Group::AxialTorque => ("axial", "moment", "N^2 m^2/Hz"),
            Group::RadialTorque => ("radial", "moment", "N^2 m^2/Hz"),
        };
        let _ = write!(
            out,
            "\n# mean over all speeds; the table's own noise is in it\n[[source]]\nname = \"{name}_{direction}_{kind}\"\n\
             on = \"{name}\"\nseed = 1\nmodes_removed = true\nfundamental_removed = true\n[source.broadband]\n\
             frequencies = \"{} Hz\"\n{direction}_{kind} = \"{} {unit}\"\n",
            middles.join(", "),
            values.join(", ")
        );
    }
    out
}
