mms_macros::field!("tests/ui/fail/unknown_name.toml");

fn main() {}
