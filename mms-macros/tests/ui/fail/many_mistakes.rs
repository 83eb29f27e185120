mms_macros::field!("tests/ui/fail/many_mistakes.toml");

fn main() {}
