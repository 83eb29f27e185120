//! Deliberate mistakes in the derivation (fault injection), such as people make by hand.
//!
//! With the feature `defects`, [`select`] makes the process make one of them: every later compilation has a wrong b. Two of the
//! mistakes are impossible with one W: b is derived for other moduli than the solver's stress. See `mms verify --defects`.
//! Without the feature none of this code exists. The macro's compiler, which Cargo builds separately, has no mistakes: the
//! compiled gallery is right, and a mistake of the compiler acts on fields that are derived anew and interpreted.

mms_math::defects! {
    ForceSign, "force_sign", "b = a + Div P/rho0: the sign of the published bar";
    ForcePresentDensity, "force_present_density", "b = a - Div P/rho: the present density in place of the reference density";
    ForcePerVolume, "force_per_volume", "rho0 b is given as b";
    InertiaDropped, "inertia_dropped", "b = -Div P/rho0: the b of a body at rest";
    DivergenceIndex, "divergence_index", "the divergence is taken over the first index of F and F^-T";
    PressureGradient, "pressure_gradient", "the gradient of J W,J is left out of Div P";
    VolumeGradient, "volume_gradient", "J,K is taken for (ln J),K";
    SecondInvariant, "second_invariant", "the divergence of F C is left out of Div P";
    SmallDilatation, "small_dilatation", "the gradient of div u is left out of the shear part of Div P at small strain";
    FibrePull, "fibre_pull", "the change of the fibres' tension along them is left out of Div P";
    GradedModuli, "graded_moduli", "the gradients of moduli are left out of Div P";
    LambdaDropped, "lambda_dropped", "b is derived for lambda = 0";
    ModuliSwapped, "moduli_swapped", "b is derived with lambda and mu swapped";
    Coriolis, "coriolis", "the Coriolis term of a rotating field lacks its factor 2";
}
