//! Inputs that were refused wrongly, accepted silently, or ended in a fault.
