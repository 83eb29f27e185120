mms_macros::field!(bar_1d);

fn main() {}
