use std::error::Error;
use std::path::Path;

use precess_codegen::kinds::{Kind, KindError, Link};
use precess_codegen::space::Axis;
use precess_codegen::{emit_kind, prove_kind};

pub fn robot_arm() -> Result<&'static Kind, KindError> {
    Kind::builder("robot_arm", "robot arm")
        .link(Link::turning("a", "upper arm", Axis::Z, "alpha").centre_on(Axis::X, "s"))
        .link(Link::turning("f", "forearm", Axis::Z, "beta"))
        .build()
}

pub fn write(folder: &Path) -> Result<(), Box<dyn Error>> {
    let kind = robot_arm()?;
    let files = emit_kind(kind, "precess_dynamics")?;
    if let Some(row) = prove_kind(kind, &files)?.iter().find(|row| !row.holds()) {
        return Err(row.to_string().into());
    }
    for file in files {
        let path = folder.join(file.path);
        std::fs::create_dir_all(path.parent().unwrap_or(folder))?;
        std::fs::write(path, file.text)?;
    }
    Ok(())
}
