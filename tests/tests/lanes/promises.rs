//! The promises that name every service, with those in lanes among them: the rest of
//! `dynamics/promises` calls none.

#[path = "../dynamics/promises/inputs.rs"]
mod inputs;
#[path = "../dynamics/promises/services.rs"]
mod services;
#[path = "../dynamics/promises/singular.rs"]
mod singular;
#[path = "../dynamics/promises/steps.rs"]
mod steps;
