//! Jitter in the frequency domain: what the imbalances and harmonics of rotors in steady spin do to lines of
//! sight, over the rotors' speed.
//!
//! About steady spin the equations are linear, and the rotors are averaged over a turn
//! ([`averaged`](crate::structure::averaged)). A rotor at the rate `Omega` has tones at `w = h Omega`; each is a blocked
//! force `F_b Omega^2 exp(i w t)` on a mount. With the accelerance `A` of the structure without devices and the dynamic
//! mass `M_w` of all devices, a block for each mount, at `w` and at the rates of the rotors,
//!
//! ```text
//! F = (1 + M_w A_mm)^-1 F_b      x = -A_om F / w^2      los = sum of S_k [x_k; theta_k]
//! ```
//!
//! `m` are the mounts, `o` the nodes of the optics. This is the modal sum of the structure with an update of the rank of
//! the mounts, six each: no system of the size of the modes is solved. `F_b` is that of the device's own equations:
//! a force that its mount and its free joints need to stay where they are while the rotor turns, sampled over a turn
//! ([`device`]). Sources: Masterson, Miller and Grogan, J. Sound Vib. 249(3), 2002 (harmonic model); Elias, Dekens, Basdogan, Sievers
//! and Neville, JPL 2003, and ASME J. Vib. Acoust. 129(2):148, 2007 (blocked and mounted force).
//!
//! | what | module |
//! |---|---|
//! | a device over the speed, and its tones | [`device`] |
//! | structure, devices and lines of sight at one speed | [`model`] |
//! | sources of the scenario: harmonics and noise | [`sources`], [`noise`] |
//! | the same with each rotor at the speed of the scenario | [`own_speeds`] |
//! | the model for a budget, and the speeds of its sweep | [`prepared`] |
//! | the share of a line in a metric | [`weight`] |
//! | how lines of one frequency are added, by their phases | [`Phases`](sweep::Phases), [`Sweep::shares`](sweep::Sweep::shares) |
//! | many speeds, on threads | [`sweep`] |
//! | natural frequencies over the speed, and where orders cross them | [`campbell`] |
//! | speeds to keep out of | [`keep_out`] |
//! | lines of sight, limits, and what a sweep says of them | [`budget`] |
//! | what a limit is sensitive to | [`sensitivity`] |
//! | the same by a run of the coupled equations | [`coupled`] |
//! | the start of a run in the vibration of its rotors | [`settled`] |
//! | how a settled run departs from its mean: the power that rotors of one speed exchange | [`mean_acceleration`] |
//! | the usual `U_s Omega^2` on rigid devices, and its error | [`simplified`] |

pub mod budget;
pub mod campbell;
pub mod coupled;
pub mod device;
mod intervals;
pub mod keep_out;
mod magnitudes;
pub mod mean_acceleration;
pub mod model;
pub mod noise;
pub mod own_speeds;
pub mod prepared;
pub mod sensitivity;
pub mod settled;
pub mod simplified;
pub mod sources;
mod superposition;
pub mod sweep;
mod transfer;
pub mod weight;
