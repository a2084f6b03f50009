//! The crate of the emitted code, and the name by which it calls the dynamics crate.

use proc_macro2::TokenStream;
use quote::quote;
use syn::Path;

use super::error::EmitError;
use super::text::ident;

/// The crate that emitted code is part of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TargetCrate<'a> {
    /// The dynamics crate itself.
    Dynamics,
    /// Another one, which calls the dynamics crate by this name.
    External(&'a str),
    /// A crate without dependencies, written by this command.
    Standalone(&'a str),
}

impl TargetCrate<'_> {
    /// The path of a file: from the repository's root, or from wherever a user puts it.
    pub(super) fn path(self, name: &str) -> String {
        match self {
            Self::Dynamics => format!("dynamics/src/generated/{name}"),
            Self::External(_) => name.to_owned(),
            Self::Standalone(_) => format!("src/kernels/{name}"),
        }
    }

    /// What makes the file again.
    pub(super) fn command(&self) -> &str {
        match self {
            Self::Dynamics => "cargo xtask regen",
            Self::External(_) => "precess_codegen::emit_kind",
            Self::Standalone(command) => command,
        }
    }

    /// What the dynamics crate is called there.
    pub(super) fn dynamics(self) -> Result<Path, EmitError> {
        let name = self.dynamics_name().unwrap_or("crate");
        syn::parse_str(name).map_err(|error| EmitError::Syntax(name.to_owned(), error))
    }

    /// The name of the dynamics crate there; none where there is none.
    pub(super) fn dynamics_name(&self) -> Option<&str> {
        match self {
            Self::Dynamics => Some("crate"),
            Self::External(dynamics) => Some(dynamics),
            Self::Standalone(_) => None,
        }
    }

    /// What brings in these records of the hub, and `Real`.
    pub(super) fn imports(self, records: &[String]) -> Result<TokenStream, EmitError> {
        let (dynamics, records) = (self.dynamics()?, records.iter().map(ident));
        Ok(match self {
            Self::Dynamics => quote! {
                use super::hub::{#(#records),*};
                use #dynamics::Real;
            },
            Self::Standalone(_) => quote! {
                use super::hub::{#(#records),*};
                use super::real::Real;
            },
            Self::External(_) => quote! {
                use #dynamics::Real;
                use #dynamics::generated::hub::{#(#records),*};
            },
        })
    }
}
