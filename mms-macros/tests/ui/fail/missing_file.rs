mms_macros::field!("tests/ui/fail/absent.toml");

fn main() {}
