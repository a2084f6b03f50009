//! Rows of panels of version 2: panels of which each stands on the one before it, up to four, the first on the hub.

use precess_dynamics::{BuiltIn, BuiltInKind, HingedPanel, OnPanel};

use crate::device::device_of;
use crate::entry_map::EntryMap;
use crate::error::{Code, Rejection};
use crate::types::Entry;
use crate::version::{LoadsByEntry, LoadsOf, at};
use crate::{MAX_IN_ROW, MAX_ROWS};

/// The third panel of a row, with the fourth.
type Third = OnPanel<HingedPanel>;
/// The second, with a third that carries nothing, or one that carries the fourth.
type Second = OnPanel<(Option<HingedPanel>, Option<Third>)>;
/// The first, in the same way.
type First = OnPanel<(Option<HingedPanel>, Option<Second>)>;
/// Those on the hub.
pub(crate) type Rows = [Option<First>; MAX_ROWS];

/// Whether an entry is a panel.
pub(crate) fn is_panel(entry: &Entry) -> bool {
    entry.device.kind == i32::from(BuiltInKind::HingedPanel.number())
}

/// The panel that stands on an entry; an error where several do.
fn on(entries: &[Entry], index: usize) -> Result<Option<usize>, Rejection> {
    let base = index.wrapping_add(1);
    let stands = |entry: &Entry| usize::try_from(entry.on).is_ok_and(|on| on == base);
    let mut found = entries.iter().enumerate().filter(|(_, entry)| stands(entry));
    let first = found.next().map(|(index, _)| index);
    found.next().map_or(Ok(first), |(index, _)| Err(at(index, Code::TooMany)))
}

/// Whether a panel carries another.
pub(crate) fn carries(entries: &[Entry], index: usize) -> bool {
    entries.get(index).is_some_and(is_panel) && !matches!(on(entries, index), Ok(None))
}

/// Whether an entry may stand on a panel: a panel on one that stands on the hub or, in the same way, on a panel.
pub(crate) fn may_stand(entries: &[Entry], entry: &Entry) -> bool {
    let mut next = *entry;
    for _ in 1..MAX_IN_ROW {
        if !is_panel(&next) {
            return false;
        }
        if next.on == 0 {
            return true;
        }
        let base = usize::try_from(next.on).ok().and_then(|on| entries.get(on.wrapping_sub(1)));
        let Some(base) = base else { return false };
        next = *base;
    }
    is_panel(&next) && next.on == 0
}

/// The rows of some entries, whose joints are added to the map.
pub(crate) fn rows(entries: &[Entry], entry_map: &mut EntryMap) -> Result<Rows, Rejection> {
    let mut rows: Rows = [const { None }; MAX_ROWS];
    let mut free = rows.iter_mut();
    for index in 0..entries.len() {
        let on_hub = entries.get(index).is_some_and(|entry| entry.on == 0);
        if !(on_hub && carries(entries, index)) {
            continue;
        }
        let to = free.next().ok_or(at(index, Code::TooMany))?;
        let first = panel(entries, index, entry_map)?;
        let mut on_first = (None, None);
        if let Some(index) = on(entries, index)? {
            on_first = second(entries, index, entry_map)?;
        }
        *to = Some(OnPanel::on_panel(first, on_first));
    }
    Ok(rows)
}

/// The second panel of a row, by itself or with what it carries.
fn second(
    entries: &[Entry],
    index: usize,
    entry_map: &mut EntryMap,
) -> Result<(Option<HingedPanel>, Option<Second>), Rejection> {
    let own = panel(entries, index, entry_map)?;
    let Some(index) = on(entries, index)? else { return Ok((Some(own), None)) };
    let third = panel(entries, index, entry_map)?;
    let on_second = match on(entries, index)? {
        Some(index) => (None, Some(OnPanel::on_panel(third, panel(entries, index, entry_map)?))),
        None => (Some(third), None),
    };
    Ok((None, Some(OnPanel::on_panel(own, on_second))))
}

/// The panel of an entry, whose joint is added to the map.
fn panel(
    entries: &[Entry],
    index: usize,
    entry_map: &mut EntryMap,
) -> Result<HingedPanel, Rejection> {
    let entry = entries.get(index).ok_or(at(index, Code::NoPlatform))?;
    let BuiltIn::HingedPanel(panel) = device_of(index, &entry.device)? else {
        return Err(at(index, Code::NoPlatform));
    };
    entry_map.add(index, 1);
    Ok(panel)
}

/// Writes the loads of the panels.
pub(crate) fn loads(rows: &LoadsOf<Rows>, to: &mut LoadsByEntry<'_, 7>) {
    for first in rows.iter().flatten() {
        to.put(&first.carrier);
        let (tip, second) = &first.carried;
        if let Some(of) = tip {
            to.put(of);
        }
        if let Some(second) = second {
            to.put(&second.carrier);
            let (tip, third) = &second.carried;
            if let Some(of) = tip {
                to.put(of);
            }
            if let Some(third) = third {
                to.put(&third.carrier);
                to.put(&third.carried);
            }
        }
    }
}
