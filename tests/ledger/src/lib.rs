//! The suite `ledger_and_loads` is a package of its own: it is compiled with optimisation, since its runs of a
//! minute would take minutes without. The other suites would take longer to compile than they do to run.
