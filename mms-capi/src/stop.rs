//! Stops of long calls.

use crate::error::{Error, MmsCode};

/// An object by which calls are stopped.
#[derive(Clone, Debug, Default)]
pub struct Stop(mms_symbolic::work::Stop);

impl Stop {
    /// Requests the stop. This is one store to an atomic variable, so that signal handlers may call it.
    pub fn ask(&self) {
        self.0.ask();
    }

    /// Whether a stop was requested.
    pub fn is_asked(&self) -> bool {
        self.0.is_asked()
    }

    /// Returns an error if a stop was requested. Called in the middle of work.
    pub fn check(&self) -> Result<(), Error> {
        if self.is_asked() {
            return Err(Error::new(MmsCode::Stopped, "stopped before its end, as was requested"));
        }
        Ok(())
    }

    /// The stop of the compiler.
    pub fn of_compiler(&self) -> mms_symbolic::work::Stop {
        self.0.clone()
    }
}
