//! Groups of devices that are evaluated side by side, in lists of an enumeration.

#[cfg(feature = "lanes")]
use crate::equations::device::Device;
#[cfg(feature = "lanes")]
use crate::equations::side_by_side::group::group;
use crate::sets::enumeration::DeviceEnum;
#[cfg(feature = "lanes")]
use crate::sets::enumeration::{Variant, WithKind};

/// [`DeviceSet::set_groups`](crate::DeviceSet::set_groups) of an enumeration.
#[doc(hidden)]
pub fn set_groups_of_enum<E: DeviceEnum>(devices: &mut [E::Prepared]) {
    #[cfg(feature = "lanes")]
    {
        let mut rest = devices;
        while let Some(first) = rest.first().cloned() {
            let count = E::with(&first, SetGroup { devices: &mut *rest });
            rest = rest.get_mut(count..).unwrap_or_default();
        }
    }
    #[cfg(not(feature = "lanes"))]
    let _ = devices;
}

/// Writes the group of the first device; gives how many it has.
#[cfg(feature = "lanes")]
struct SetGroup<'a, E: DeviceEnum> {
    devices: &'a mut [E::Prepared],
}

#[cfg(feature = "lanes")]
impl<E: DeviceEnum> WithKind<E> for SetGroup<'_, E> {
    type Output = usize;

    fn with<K: Variant<E>>(self, _: &Device<K>) -> usize {
        let (count, group) = group(self.devices.iter().map_while(K::device_in_enum));
        if let Some(first) = self.devices.first_mut().and_then(K::device_in_enum_mut) {
            first.group = group;
        }
        count
    }
}
