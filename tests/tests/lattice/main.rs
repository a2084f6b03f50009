//! Kinds, modes and mixed sets: the same spacecraft stated in different ways moves the same way, and
//! as point masses under Newton's law would.

mod balance;
mod bench;
mod changes;
mod closed_form;
mod cloud;
mod devices;
mod kinds;
mod lists;
mod loads;
mod mixed;
mod modes;
mod precision;
mod random;
mod refusals;
mod rigid;
mod stops;
