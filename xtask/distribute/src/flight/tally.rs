//! What passed and what failed.

use xtask::say;

/// Counts, and says each as it comes.
#[derive(Default)]
pub(super) struct Tally {
    passed: u32,
    failed: u32,
}

impl Tally {
    /// Takes a result in.
    pub(super) fn check(&mut self, what: &str, result: Result<(), String>) {
        match result {
            Ok(()) => {
                self.passed += 1;
                say!("passed  {what}");
            }
            Err(why) => {
                self.failed += 1;
                say!("FAILED  {what}: {why}");
            }
        }
    }

    /// The sums; an error if anything failed, or if there was nothing.
    pub(super) fn end(&self) -> Result<(), String> {
        say!("{} passed, {} failed", self.passed, self.failed);
        match (self.passed, self.failed) {
            (0, 0) => Err("nothing was checked".to_owned()),
            (_, 0) => Ok(()),
            (passed, failed) => Err(format!("{failed} of {} checks failed", passed + failed)),
        }
    }
}
