mms_macros::field!("/dev/zero");

fn main() {}
