mms_macros::field!("tests/ui/fail/missing_material.toml");

fn main() {}
