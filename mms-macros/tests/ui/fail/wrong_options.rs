mms_macros::field!("fields/bar_1d.toml", quantity = [body_force]);
mms_macros::field!("fields/bar_1d.toml", temperature);
mms_macros::field!("fields/bar_1d.toml", freeze, freeze);
mms_macros::field!("fields/bar_1d.toml" freeze);
mms_macros::field!("fields/bar_1d.toml", quantities = []);
mms_macros::field!("fields/bar_1d.toml", quantities = [body_force, velocty]);
mms_macros::field!("fields/bar_1d.toml", quantities = [body_force, b]);
mms_macros::field!("fields/bar_1d.toml", quantities = body_force);
mms_macros::field!("fields/bar_1d.toml", freeze = ["young"]);
mms_macros::field!("fields/bar_1d.toml", set = { young = fast });
mms_macros::field!("fields/bar_1d.toml", set = { young = 1f64 });
mms_macros::field!("fields/bar_1d.toml", set = { young = -"1" });
mms_macros::field!("fields/bar_1d.toml", set = { "young" = 1 });
mms_macros::field!("fields/bar_1d.toml", name = "other");
mms_macros::field!("fields/bar_1d.toml", name = fn);
mms_macros::field!("fields/bar_1d.toml", rigid = [1]);
mms_macros::field!("fields/bar_1d.toml", rigid = "rotation = 1");

fn main() {}
