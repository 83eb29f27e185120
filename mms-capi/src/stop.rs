//! How a caller ends what takes long.

use crate::error::{Error, MmsCode};

/// By which calls are told to stop.
#[derive(Clone, Debug, Default)]
pub struct Stop(mms_symbolic::work::Stop);

impl Stop {
    /// Tells them so. It is one store to an atomic variable, so that signal handlers may do it.
    pub fn ask(&self) {
        self.0.ask();
    }

    /// Whether somebody did.
    pub fn is_asked(&self) -> bool {
        self.0.is_asked()
    }

    /// What is asked in the middle of work: whether to go on.
    pub fn check(&self) -> Result<(), Error> {
        if self.is_asked() {
            return Err(Error::new(MmsCode::Stopped, "stopped before its end, as was requested"));
        }
        Ok(())
    }

    /// What the compiler asks.
    pub fn of_compiler(&self) -> mms_symbolic::work::Stop {
        self.0.clone()
    }
}
