//! Tensors with all nine components, of plane and of uniaxial strain.

use mms_exact::plane::{Beyond, nine};

#[test]
fn the_stress_beyond_the_plane_is_what_the_pressure_holds() {
    // sigma = diag(1, 2, 4) with a shear in the plane, and diag(1, 4, 4).
    let pressure = -7.0 / 3.0;
    assert_eq!(Beyond::Cauchy.value(&[1.0, 0.5, 0.5, 2.0], &pressure, &2.0), 4.0);
    assert_eq!(Beyond::Kirchhoff.value(&[1.0, 0.5, 0.5, 2.0], &pressure, &2.0), 8.0);
    assert_eq!(Beyond::Cauchy.value(&[1.0], &-3.0, &2.0), 4.0);
    assert_eq!(
        nine(&[1.0, 0.5, 0.25, 2.0], 2, &4.0),
        [1.0, 0.5, 0.0, 0.25, 2.0, 0.0, 0.0, 0.0, 4.0]
    );
    assert_eq!(nine(&[1.0], 1, &4.0), [1.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 4.0]);
}
