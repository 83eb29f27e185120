//! Parameters that are set while other threads evaluate, in every order in which threads can acquire the locks.
#![cfg(test)]

#[path = "../../src/settings.rs"]
mod settings;

/// The locks of loom, which tries all orders.
mod locks {
    pub use loom::sync::{Arc, Mutex, RwLock};
}

use std::collections::BTreeMap;

use loom::thread;

use locks::Arc;
use settings::Settings;

type Set = BTreeMap<usize, f64>;

/// Two parameters with the default 0, and a third that is their sum. Only values that are not negative are allowed.
fn values(set: &Set) -> Result<Vec<f64>, &'static str> {
    let [a, b] = [0, 1].map(|index| set.get(&index).copied().unwrap_or_default());
    if a < 0.0 || b < 0.0 { Err("negative") } else { Ok(vec![a, b, a + b]) }
}

/// Tries every order of threads each of which makes a change, allowed or not, and of one that evaluates twice. Each evaluation
/// reads one of the allowed states, and the second none before the first. The last state remains.
fn explore(changes: &'static [&'static [(usize, f64)]], allowed: &'static [[f64; 3]]) {
    loom::model(move || {
        let settings = Arc::new(Settings::<Set>::new(vec![0.0; 3]));
        let changing = changes.iter().map(|change| {
            let settings = settings.clone();
            thread::spawn(move || settings.change(change.iter().copied().collect(), values))
        });
        let changing: Vec<_> = changing.collect();
        let seen = || {
            let now = settings.now();
            *allowed.iter().find(|state| state[..] == now[..]).expect("a state that somebody set")
        };
        let [first, second] = [seen(), seen()];
        assert!(first.iter().zip(second).all(|(a, b)| *a <= b), "a change was taken back");
        for (thread, change) in changing.into_iter().zip(changes) {
            let refused = change.iter().any(|(_, value)| *value < 0.0);
            assert_eq!(thread.join().expect("no panic").is_err(), refused);
        }
        assert_eq!(Some(&seen()), allowed.last());
    });
}

#[test]
fn an_evaluation_sees_all_of_a_change_or_nothing() {
    explore(&[&[(0, 1.0), (1, 2.0)]], &[[0.0; 3], [1.0, 2.0, 3.0]]);
}

#[test]
fn of_two_changes_none_is_lost() {
    let states = &[[0.0; 3], [1.0, 0.0, 1.0], [0.0, 2.0, 2.0], [1.0, 2.0, 3.0]];
    explore(&[&[(0, 1.0)], &[(1, 2.0)]], states);
}

#[test]
fn what_is_refused_is_never_seen() {
    explore(&[&[(0, -1.0)], &[(1, 2.0)]], &[[0.0; 3], [0.0, 2.0, 2.0]]);
}
