//! Progress of a diagnosis, and its end on request.

/// Follows a diagnosis, from any of its threads.
pub trait Follow: Sync {
    /// Whether the diagnosis has to end: it returns [`Obstacle::Stopped`](crate::run::Obstacle::Stopped) soon.
    fn is_stopped(&self) -> bool;

    /// Receives a line about the progress of the diagnosis.
    fn say(&self, line: &str);
}

/// A follower that shows nothing and never ends a diagnosis.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unfollowed;

impl Follow for Unfollowed {
    fn is_stopped(&self) -> bool {
        false
    }

    fn say(&self, _: &str) {}
}
