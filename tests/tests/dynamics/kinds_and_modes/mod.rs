//! Kinds, modes and mixed sets: the same spacecraft described in different ways has the same
//! accelerations, and those of point masses under Newton's law.

mod balance;
mod case;
mod changes;
mod closed_form;
mod devices;
mod kinds;
mod lists;
mod loads;
mod mixed;
mod modes;
mod precision;
mod random;
mod rejected_modes;
mod rigid;
mod stops;
