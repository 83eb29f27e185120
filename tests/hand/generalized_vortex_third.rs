//! The generalized vortex with an angle of 1/3; derived in `vortex.rs`.

use mms_gallery::generalized_vortex_third::{Parameters, prepare};

use crate::support::{TOLERANCE, assert_agree, generated, in_ring};
use crate::vortex::Vortex;

#[test]
fn the_generated_vortex_is_the_vortex_on_paper() {
    let odd =
        Parameters::<f64> { middle: 2.0, half_width: 0.3, young: 400.0, ..Parameters::default() };
    for parameters in [Parameters::default(), odd] {
        let Parameters { middle, half_width, young, nu, rho0, angle } = parameters;
        let vortex = Vortex { middle, half_width, young, nu, rho0, angle };
        let points = in_ring(middle - half_width, middle + half_width, [0.0, vortex.period()]);
        let by_hand = |x, t| vortex.values(x, t);
        assert_agree(TOLERANCE, &points, generated!(prepare(&parameters)), by_hand);
    }
}
