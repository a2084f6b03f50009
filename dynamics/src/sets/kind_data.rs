//! [`KindData`], [`KindDataMut`]: a kind's data out of an enumeration's, during a visit.

/// Data to be read: a copy, or the data where they are.
#[derive(Debug)]
pub enum KindData<'a, O> {
    /// A copy, converted to the structures of the kind.
    Copied(O),
    /// Not converted.
    InPlace(&'a O),
}

/// Data to be changed: a copy and where it is put back, or the data where they are.
#[derive(Debug)]
pub enum KindDataMut<'a, O, M> {
    /// A copy, converted to the structures of the kind, and where it is put back.
    Copied(O, &'a mut M),
    /// Not converted.
    InPlace(&'a mut O),
}

impl<O> KindData<'_, O> {
    /// The data.
    #[inline]
    pub(crate) fn refer(&self) -> &O {
        match self {
            Self::Copied(copy) => copy,
            Self::InPlace(data) => data,
        }
    }
}

impl<O, M> KindDataMut<'_, O, M> {
    /// The data.
    #[inline]
    pub(crate) fn refer(&mut self) -> &mut O {
        match self {
            Self::Copied(copy, _) => copy,
            Self::InPlace(data) => data,
        }
    }
}
