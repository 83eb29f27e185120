mms_macros::field!("tests/ui/fail/wrong_material.toml");

fn main() {}
