//! What the services of a spacecraft need of a rigid hub: nothing beside what every structure has.

pub(crate) mod structure;
