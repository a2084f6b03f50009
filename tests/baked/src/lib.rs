//! The spacecraft whose own kernels the suite `agreement` holds against the general solver.
