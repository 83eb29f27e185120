mms_macros::field!(
    "fields/bar_1d.toml",
    set = { yung = 1, rho0 = "1 +", length = 1, length = 2 },
    freeze = [amplitud, young, young],
);
mms_macros::field!("fields/bar_1d.toml", set = { rho0 = 0 }, freeze = [rho0]);
mms_macros::field!(
    "fields/bar_1d.toml",
    quantities = [body_force],
    set = { young = "-1e6" },
    freeze,
);
mms_macros::field!(
    "examples/fields/standing_wave_1d.toml",
    set = { lambda = -1e7 },
    freeze = [lambda, mu, rho0],
);
mms_macros::field!("examples/fields/static_3d.toml", set = { lambda = -1e7 }, freeze);

fn main() {}
