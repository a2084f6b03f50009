//! The functions of a record that change it number by number, whatever the numbers are.

use proc_macro2::TokenStream;
use quote::quote;

use super::text::ident;

/// `map` and `zip` of a record with these fields, for its type parameter and what that must be.
pub(super) fn map_and_zip(
    record: &str,
    [number, bound]: [&str; 2],
    fields: &[impl AsRef<str>],
) -> TokenStream {
    let [record, number, bound] = [record, number, bound].map(ident);
    let fields: Vec<_> = fields.iter().map(ident).collect();
    quote! {
        impl<#number: #bound> #record<#number> {
            /// The record with each of its numbers changed.
            #[inline(always)]
            #[must_use]
            pub fn map<U: Copy>(&self, mut change: impl FnMut(#number) -> U) -> #record<U> {
                self.zip(self, |number, _| change(number))
            }
            /// Two records joined number by number.
            #[inline(always)]
            #[must_use]
            pub fn zip<U: Copy, W>(
                &self,
                other: &#record<U>,
                mut join: impl FnMut(#number, U) -> W,
            ) -> #record<W> {
                #record { #(#fields: join(self.#fields, other.#fields)),* }
            }
        }
    }
}
