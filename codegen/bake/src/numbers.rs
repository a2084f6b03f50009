//! Numbers and arrays as Rust and C write them.

/// An array: brackets that [`rust`] and [`c`] write as theirs.
pub(crate) fn array(values: impl Iterator<Item = String>) -> String {
    format!("⟦{}⟧", values.collect::<Vec<_>>().join(", "))
}

/// Arrays as Rust writes them.
pub(crate) fn rust(text: &str) -> String {
    text.replace('⟦', "[").replace('⟧', "]")
}

/// Arrays as C writes them.
pub(crate) fn c(text: &str) -> String {
    text.replace('⟦', "{").replace('⟧', "}")
}

/// The shortest digits that read back the same.
pub(crate) fn float(x: f64) -> String {
    format!("{x:?}")
}

pub(crate) fn list(values: impl Iterator<Item = f64>) -> String {
    array(values.map(float))
}

pub(crate) fn vector(v: &[f64; 3]) -> String {
    list(v.iter().copied())
}

pub(crate) fn matrix(m: &[[f64; 3]; 3]) -> String {
    array(m.iter().map(vector))
}
