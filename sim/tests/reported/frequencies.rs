//! Budgets and bands: integrals over frequency, and what is compared with what.
