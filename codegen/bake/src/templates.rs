//! Templates of the emitted files, and what all of them say.

use tera::Tera;

/// What is written in every emitted file.
pub(crate) const COMMAND: &str = "precess bake";

/// Templates of this crate, by name.
pub(crate) fn templates(list: &[(&str, &str)]) -> Tera {
    let mut tera = Tera::default();
    tera.autoescape_on(Vec::<&str>::new());
    for (name, text) in list {
        tera.add_raw_template(name, text).expect("the templates are those of this crate");
    }
    tera
}
