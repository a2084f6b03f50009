//! The suite `linearize` is a package of its own: the kernels of every kind are compiled for it over
//! dual and double-double numbers, and nothing else of the suites has to be.
