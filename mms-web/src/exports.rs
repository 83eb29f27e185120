//! The functions of the module: the page fills a buffer with a request, and reads the reply in place.

// A name that the page calls is an unsafe attribute: two functions of one name would be undefined behaviour.
#![allow(unsafe_code)]

use std::sync::{Mutex, MutexGuard};

static ROOM: Mutex<Vec<u8>> = Mutex::new(Vec::new());
static REPLY: Mutex<String> = Mutex::new(String::new());

/// The lock of a static. There is one thread, and a panic ends the module.
fn lock<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().expect("no other thread")
}

/// Allocates the buffer for a request of `length` bytes, and discards the last reply.
#[unsafe(no_mangle)]
extern "C" fn room(length: usize) -> *mut u8 {
    *lock(&REPLY) = String::new();
    let mut room = lock(&ROOM);
    *room = vec![0; length];
    room.as_mut_ptr()
}

/// Answers the request in the buffer, and returns the address of the reply.
#[unsafe(no_mangle)]
extern "C" fn answer() -> *const u8 {
    let request = std::mem::take(&mut *lock(&ROOM));
    let mut reply = lock(&REPLY);
    *reply = crate::answer(&request);
    reply.as_ptr()
}

/// The bytes of the reply.
#[unsafe(no_mangle)]
extern "C" fn answer_length() -> usize {
    lock(&REPLY).len()
}
