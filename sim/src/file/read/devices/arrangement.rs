//! What stands on what: devices and platforms in the order of the set, and what is wrong with `on`.
//!
//! A platform stands on the hub, or on a platform on the hub. A device stands on the hub, on a platform or on a hinged
//! panel; one that carries a device stands on the hub, or on a panel: [`rows`](super::rows).

use std::collections::BTreeMap;

use super::device::Device;
use super::rows::Rows;
use crate::file::keys::Keys;
use crate::nearest::did_you_mean;

pub(super) const HUB: &str = "hub";
/// Carriers that stand on one another are looked through up to so many.
pub(super) const SHOWN_MAX: usize = 12;

/// Devices and platforms in the order of the set; reports those on what is no platform, and platforms that stand too
/// deep. `tables` are also those of platforms in which something is wrong: what stands on them is not.
pub(super) fn arranged(
    keys: &Keys<'_>,
    devices: Vec<Device>,
    platforms: Vec<Device>,
    tables: &[Keys<'_>],
) -> Vec<Device> {
    let named = tables.iter().filter_map(|keys| {
        Some(Standing { keys, name: keys.text("name")?, on: keys.text("on").unwrap_or(HUB) })
    });
    let named: Vec<_> = named.collect();
    let mut known: Vec<_> = devices.iter().map(|device| device.name.clone()).collect();
    known.sort_unstable();
    let is_device = |name: &str| known.binary_search_by(|of| of.as_str().cmp(name)).is_ok();
    let is_platform = |name: &str| named.iter().any(|of| of.name == name);
    let devices = Rows::new(devices.iter()).without_faults(keys, devices, &is_platform);
    report_devices(keys, &devices, &named);
    let wrong: Vec<&str> =
        named.iter().filter(|of| of.reported(&named, &is_device)).map(|of| of.name).collect();
    let (rows, devices) = Rows::new(devices.iter()).split(devices);
    let (mut arranged, mut rest): (Vec<_>, Vec<_>) =
        devices.into_iter().partition(|device| device.on == HUB);
    let (on_hub, mut inner): (Vec<_>, Vec<_>) =
        platforms.into_iter().partition(|of| of.on == HUB || wrong.contains(&of.name.as_str()));
    for platform in on_hub {
        let (name, node) = (platform.name.clone(), platform.node);
        arranged.push(Device { on: HUB.to_owned(), ..platform });
        let add = |from: &mut Vec<Device>, name: &str| {
            let all = std::mem::take(from).into_iter();
            let (own, others): (Vec<_>, _) = all.partition(|device| device.on == name);
            *from = others;
            own.into_iter().map(move |device| Device { node, ..device }).collect::<Vec<_>>()
        };
        arranged.extend(add(&mut rest, &name));
        for platform in add(&mut inner, &name) {
            let devices = add(&mut rest, &platform.name);
            arranged.push(platform);
            arranged.extend(devices);
        }
    }
    // Of a platform in which something is wrong: their joints are known by name.
    arranged.extend(inner);
    arranged.extend(rest);
    arranged.extend(rows);
    arranged
}

/// Reports devices on what is no platform or panel.
fn report_devices(keys: &Keys<'_>, devices: &[Device], named: &[Standing<'_>]) {
    let mut reported = Vec::new();
    let panels: BTreeMap<&str, bool> =
        devices.iter().map(|of| (of.name.as_str(), of.is_panel())).collect();
    for device in devices {
        // A layout makes several of one table.
        let on = &device.on;
        let base = panels.get(on.as_str());
        let known = on == HUB
            || named.iter().any(|of| of.name == *on)
            || (base == Some(&true) && device.name != *on);
        if known || reported.contains(&device.place) {
            continue;
        }
        let platforms = named.iter().map(|of| of.name);
        let of_devices = devices.iter().filter(|of| of.is_panel() && of.name != device.name);
        let bases: Vec<&str> =
            platforms.chain(of_devices.map(|panel| panel.name.as_str())).collect();
        let (what, help) = if device.name == *on {
            (format!("`{on}` stands on itself"), without_on(&bases))
        } else if base.is_some() {
            let what = format!(
                "`{on}` is no panel: devices stand on the hub, on platforms and on hinged panels"
            );
            (what, without_on(&bases))
        } else {
            let otherwise = match bases.as_slice() {
                [] => "add a `[[platform]]` of this name, or remove `on`".to_owned(),
                _ => there_are(bases.iter().copied()),
            };
            let help = did_you_mean(on, bases.iter(), &otherwise);
            (format!("no platform or panel is named `{on}`"), help)
        };
        if let Some(place) = &device.place {
            keys.reports().borrow_mut().error(place, what, "", &help);
        }
        reported.push(device.place.clone());
    }
}

/// To remove `on`, and the platforms and panels on which the device may stand instead.
fn without_on(bases: &[&str]) -> String {
    match bases {
        [] => "remove `on`: it stands on the hub".to_owned(),
        _ => format!("remove `on`: it stands on the hub; there are {}", bases.join(", ")),
    }
}

fn there_are<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<_> = names.collect();
    format!("there are {}; without `on` it stands on the hub", names.join(", "))
}

/// A table of a platform, and the name of what it stands on.
struct Standing<'a> {
    keys: &'a Keys<'a>,
    name: &'a str,
    on: &'a str,
}

impl Standing<'_> {
    /// Reports what is wrong with `on`; whether there is something.
    fn reported(&self, named: &[Standing<'_>], is_device: &dyn Fn(&str) -> bool) -> bool {
        let (name, on) = (self.name, self.on);
        if on == HUB {
            return false;
        }
        let base_of = |name: &str| named.iter().find(|of| of.name == name);
        let others = || named.iter().map(|of| of.name).filter(|other| *other != name);
        if on == name {
            self.keys.error("on", format!("`{name}` stands on itself"), "remove `on`");
            return true;
        }
        let Some(base) = base_of(on) else {
            let what = if is_device(on) {
                format!("`{on}` is a device: platforms stand on the hub and on platforms")
            } else {
                format!("no platform is named `{on}`")
            };
            let otherwise = match others().next() {
                Some(_) => there_are(others()),
                None => "remove `on`: it stands on the hub".to_owned(),
            };
            self.keys.error("on", what, &did_you_mean(on, others(), &otherwise));
            return true;
        };
        // The platforms below, until the hub or one that was there.
        let mut chain = vec![name, on];
        let mut next = Some(base);
        while let Some(below) = next.and_then(|of| base_of(of.on)) {
            let is_known = chain.contains(&below.name);
            chain.push(below.name);
            next = (!is_known && chain.len() < SHOWN_MAX).then_some(below);
        }
        let [_, _, third, ..] = chain[..] else { return false };
        let shown = chain.join("` on `");
        if chain.last() == Some(&name) {
            // Once for all of them.
            let first = named.iter().find(|of| chain.contains(&of.name));
            if first.is_some_and(|of| of.name == name) {
                let message = format!("`{shown}`: platforms in a circle");
                self.keys.error("on", message, "remove `on` of the one that stands on the hub");
            }
        } else if chain.len() == SHOWN_MAX || next.is_some_and(|of| of.on == HUB) {
            let message = format!("`{shown}`: at most two platforms stand on one another");
            let help = format!("write `on = \"{third}\"`, or remove `on` of one of them");
            self.keys.error("on", message, &help);
        }
        true
    }
}

/// What stands on the platform of a name, at the start of the rest of an arrangement.
pub(super) fn standing_on<'a>(name: &str, rest: &'a [Device]) -> &'a [Device] {
    let is_inner =
        |on: &str| rest.iter().any(|of| of.built_in().is_none() && of.name == on && of.on == name);
    let count = rest.iter().take_while(|of| of.on == name || is_inner(&of.on)).count();
    rest.get(..count).unwrap_or_default()
}
