//! Rows of panels: devices that stand on hinged panels, and the set of all that is arranged.
//!
//! A panel that carries a device stands on the hub, or on another panel, and at most three in a row carry others: with
//! the last one, which carries none, four stand on one another.

use std::collections::{BTreeMap, BTreeSet};

use precess_craft::FirstPanel;
use precess_dynamics::{BuiltIn, HingedPanel, Isolated, OnPanel, Platform, Suspension};

use super::arrangement::{HUB, SHOWN_MAX};
use super::device::{Device, DeviceOrPlatform};
use crate::file::keys::Keys;
use crate::scenario::Set;

/// The most panels in a row that carry others.
const CARRYING_MAX: usize = 3;

/// The panels that carry devices, by name, each with the name of what it stands on.
pub(super) struct Rows(BTreeMap<String, String>);

impl Rows {
    pub(super) fn new<'a>(devices: impl Iterator<Item = &'a Device> + Clone) -> Self {
        let carried = devices.clone().filter(|of| of.on != of.name);
        let bases: BTreeSet<&str> = carried.map(|of| of.on.as_str()).collect();
        let panels = devices.filter(|of| of.is_panel() && bases.contains(of.name.as_str()));
        Self(panels.map(|panel| (panel.name.clone(), panel.on.clone())).collect())
    }

    fn carries(&self, name: &str) -> bool {
        self.0.contains_key(name)
    }

    /// A name and the panels below it, until what is no panel that carries or was there.
    fn below<'a>(&'a self, name: &'a str, on: &'a str) -> Vec<&'a str> {
        let mut chain = vec![name, on];
        let mut last = on;
        while let Some(next) = self.0.get(last) {
            last = next;
            let known = chain.contains(&last);
            chain.push(last);
            if known || chain.len() >= SHOWN_MAX {
                break;
            }
        }
        chain
    }

    /// The devices, those of which the row cannot be on the hub, which is reported.
    pub(super) fn without_faults(
        &self,
        keys: &Keys<'_>,
        devices: Vec<Device>,
        is_platform: &dyn Fn(&str) -> bool,
    ) -> Vec<Device> {
        let mut reported = Vec::new();
        // The panels of circles that are reported.
        let mut circles: Vec<String> = Vec::new();
        let on_hub = |device: Device| Device { on: HUB.to_owned(), ..device };
        let checked = devices.into_iter().map(|device| {
            // One that stands on itself is reported by itself.
            if !self.carries(&device.on) || device.on == device.name {
                return device;
            }
            let chain = self.below(&device.name, &device.on);
            let shown = chain.join("` on `");
            let (what, help) = match chain.last() {
                Some(&HUB) if chain.len() <= CARRYING_MAX.saturating_add(2) => return device,
                Some(last) if self.carries(last) && chain.iter().filter(|of| of == &last).count() > 1 => {
                    // Once for all of them, and not for what stands on one of them.
                    if *last != device.name || circles.contains(&device.name) {
                        return on_hub(device);
                    }
                    circles.extend(chain.iter().map(|of| (*of).to_owned()));
                    (
                        format!("`{shown}`: panels in a circle"),
                        "remove `on` of the one that stands on the hub",
                    )
                }
                Some(last) if *last == HUB || chain.len() >= SHOWN_MAX => (
                    format!("`{shown}`: at most four panels stand on one another"),
                    "remove `on` of one of them: it stands on the hub",
                ),
                last => (
                    format!("`{shown}`: a panel that carries devices stands on the hub or on a panel"),
                    if last.is_some_and(|last| is_platform(last)) {
                        "let the platform carry the devices of the row one by one, or remove `on` of the panel"
                    } else {
                        "remove `on` of the panel"
                    },
                ),
            };
            if let Some(place) = device.place.as_ref().filter(|place| !reported.contains(*place)) {
                keys.reports().borrow_mut().error(place, what, "", help);
                reported.push(place.clone());
            }
            on_hub(device)
        });
        checked.collect()
    }

    /// The panels on the hub that carry devices, each with what stands on it, in the order of the set; and all other
    /// devices.
    pub(super) fn split(&self, devices: Vec<Device>) -> (Vec<Device>, Vec<Device>) {
        let (mut on_panels, others): (Vec<_>, Vec<_>) =
            devices.into_iter().partition(|of| self.carries(&of.on) || self.carries(&of.name));
        let mut rows = Vec::new();
        self.take(&mut on_panels, HUB, None, &mut rows);
        rows.extend(on_panels);
        (rows, others)
    }

    /// Moves the devices on a base that carry nothing, then each panel on it with what stands on that.
    fn take(&self, from: &mut Vec<Device>, base: &str, node: Option<usize>, to: &mut Vec<Device>) {
        let (own, others): (Vec<_>, Vec<_>) =
            std::mem::take(from).into_iter().partition(|of| of.on == base);
        *from = others;
        let of_base = |of: Device| Device { node: of.node.or(node), ..of };
        let (panels, plain): (Vec<_>, Vec<_>) =
            own.into_iter().map(of_base).partition(|of| self.carries(&of.name));
        to.extend(plain);
        for panel in panels {
            let (name, node) = (panel.name.clone(), panel.node);
            to.push(panel);
            self.take(from, &name, node, to);
        }
    }
}

/// The set of arranged devices and platforms.
pub(in crate::file::read) fn set(arranged: &[Device]) -> Set {
    set_on(HUB, arranged)
}

/// The set of what stands on the hub or on the platform of a name, which takes the place of the hub.
pub(super) fn set_on<'a>(
    base: &str,
    arranged: impl IntoIterator<Item = &'a Device, IntoIter: Clone>,
) -> Set {
    let arranged = arranged.into_iter();
    let rows = Rows::new(arranged.clone());
    let mut set = Set::default();
    for device in arranged {
        // How many panels are below it.
        let depth = || rows.below(&device.name, &device.on).len().saturating_sub(2);
        match &device.of {
            DeviceOrPlatform::Platform(of) => push_platform(&mut set, **of, device.on == base),
            DeviceOrPlatform::BuiltIn(own) => match **own {
                BuiltIn::HingedPanel(panel) if rows.carries(&device.name) => {
                    push_panel(&mut set.2, panel, depth());
                }
                own if rows.carries(&device.on) => push_on_panel(&mut set.2, &own, depth()),
                own => push_device(&mut set, &own),
            },
        }
    }
    set
}

/// A panel that carries devices, on the hub or on the last of so many panels.
fn push_panel(rows: &mut Vec<FirstPanel>, panel: HingedPanel, depth: usize) {
    let first = rows.last_mut();
    match (depth, first) {
        (1, Some(first)) => first.carried.1.push(OnPanel::on_panel(panel, Default::default())),
        (2, Some(first)) => {
            if let Some(second) = first.carried.1.last_mut() {
                second.carried.1.push(OnPanel::on_panel(panel, Vec::new()));
            }
        }
        _ => rows.push(OnPanel::on_panel(panel, Default::default())),
    }
}

/// A device on the last of so many panels.
fn push_on_panel(rows: &mut [FirstPanel], device: &BuiltIn, depth: usize) {
    let Some(first) = rows.last_mut() else { return };
    match (depth, first.carried.1.last_mut()) {
        (2, Some(second)) => second.carried.0.push(*device),
        (3, Some(second)) => {
            if let Some(third) = second.carried.1.last_mut() {
                third.carried.push(*device);
            }
        }
        _ => first.carried.0.push(*device),
    }
}

/// A platform on the base, or on the last platform that stands on it.
fn push_platform(set: &mut Set, (carrier, suspension): (Platform, Suspension), on_base: bool) {
    match set.1.last_mut() {
        Some(outer) if !on_base => {
            outer.carried.1.push(Isolated { carrier, suspension, carried: Vec::new() });
        }
        _ => {
            let carried = (Vec::new(), Vec::new());
            set.1.push(Isolated { carrier, suspension, carried });
        }
    }
}

/// A device on the last platform, or on the base where there is none.
fn push_device(set: &mut Set, device: &BuiltIn) {
    match set.1.last_mut() {
        None => set.0.push(*device),
        Some(outer) => match outer.carried.1.last_mut() {
            Some(inner) => inner.carried.push(*device),
            None => outer.carried.0.push(*device),
        },
    }
}
