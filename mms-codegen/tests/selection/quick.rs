//! Values that the quick test accepts.

use mms_codegen::compile;
use mms_codegen::compile::fast_check::FastParameterCheck;
use mms_symbolic::expr::Rational;
use mms_symbolic::sorted::SortedMap;

const FIELDS: [(&str, &str); 4] = [
    ("axis_aligned_2d", include_str!("../../../fields/axis_aligned_2d.toml")),
    ("bar_1d", include_str!("../../../fields/bar_1d.toml")),
    ("cyclic_shear_3d", include_str!("../../../fields/cyclic_shear_3d.toml")),
    ("expanding_ring", include_str!("../../../fields/expanding_ring.toml")),
];

/// Values that the quick test accepts pass the full check with the same results; it accepts ordinary values, and no wrong ones.
#[test]
fn what_is_accepted_quickly_is_accepted() {
    for (name, text) in FIELDS {
        let compiled = compile(name, name, text, &|_| Err("no files here".into()))
            .unwrap_or_else(|failure| panic!("{failure}"));
        let quick = FastParameterCheck::new(&compiled).expect("an isotropic field");
        let defaults = compiled.parameters::<f64>(&SortedMap::new());
        let (mut accepted, mut refused) = (0, 0);
        for index in 0..compiled.model.parameters.len() {
            let default = defaults[index];
            for factor in [1.0, 1.25, 0.7, 1e-3, 0.0, -1.0, 1e30] {
                let number = Rational::try_from(default * factor).expect("a finite number");
                let set = SortedMap::from([(index, number)]);
                let allowed = compiled.accepts(&set).is_ok();
                match quick.accepted(&set) {
                    Some(values) => {
                        accepted += 1;
                        assert!(allowed, "{name}, parameter {index}: {}", default * factor);
                        assert_eq!(values, compiled.parameters::<f64>(&set));
                    }
                    None if allowed => {
                        assert!(!(0.1..=2.0).contains(&factor), "{name}, {set:?}")
                    }
                    None => refused += 1,
                }
            }
        }
        assert!(accepted > 0 && refused > 0, "{name}: {accepted}, {refused}");
    }
}
