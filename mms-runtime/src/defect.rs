//! Deliberate mistakes in the solver (fault injection), of the kind that people make.
//!
//! With the feature `defects`, [`select`] makes the process commit one of them, which a useful verification detects; see
//! `mms verify --defects`. Without the feature this code is not compiled.

mms_math::defects! {
    ForceLate, "force_late", "b at t - dt in place of t";
    ForceAhead, "force_ahead", "b at t + dt/2, the time of the velocities of leapfrog, in place of t";
    ForceAtPresent, "force_at_present", "b at the present position in place of the reference position";
    StartAtRest, "start_at_rest", "v(0) = 0 in place of the field's";
    StartSingle, "start_single", "v(0) is rounded to single precision";
    StartUndeformed, "start_undeformed", "F(0) = I in place of the field's";
    MassOfPresentVolume, "mass_of_present_volume", "m = rho0 J V0: the reference density with the present volume";
    MassCutOff, "mass_cut_off", "nodes with less than 1 % of a particle's mass count as empty";
    FullFirstKick, "full_first_kick", "leapfrog whose first kick is a whole step: v(0) taken for v(-dt/2)";
    StaleNodalVelocity, "stale_nodal_velocity", "particles move with v_i before dt a_i is added";
    OwnVelocity, "own_velocity", "particles move with their own velocity, not with the grid's";
    ReferenceGradient, "reference_gradient", "dF/dt = L in place of L F";
    TransposedGradient, "transposed_gradient", "F is updated with the transposed velocity gradient";
    LostSpin, "lost_spin", "F is updated with the symmetric part of the velocity gradient";
    TransposedStress, "transposed_stress", "P^T in place of P works on the gradients of weights";
    StressIndex, "stress_index", "column J of the stress works on the gradient along the axis J + 1";
    KirchhoffForCauchy, "kirchhoff_for_cauchy", "the present volume J V0 with the Kirchhoff stress";
    ModuliAtPresent, "moduli_at_present", "moduli at the present position in place of the reference position";
    FlipIsPic, "flip_is_pic", "particles take v_i in place of dt a_i";
    FlipFraction, "flip_fraction", "the fractions of FLIP and PIC are swapped";
    AffineTransposed, "affine_transposed", "APIC keeps the transposed linear velocity";
    AffineFactor, "affine_factor", "APIC uses D^-1 = 3/h^2 of cubic splines for quadratic splines, in place of 4/h^2";
    XpicOrder, "xpic_order", "XPIC stops one map early";
    XpicSign, "xpic_sign", "XPIC adds what the grid does not hold";
    HalfWidthKept, "half_width_kept", "the half widths of cpgimp stay what they were";
    HalfWidthsSwapped, "half_widths_swapped", "the half widths of a box have the reverse order of its axes";
    ShortSupport, "short_support", "GIMP leaves out the last of its nodes";
    CornersKept, "corners_kept", "the corners of cpdi keep their offsets from the particle";
    CornersTransposed, "corners_transposed", "the gradients of cpdi are made of R^-1 in place of R^-T";
    SplineEnds, "spline_ends", "splines at the ends of knots have the form of those in the middle";
    SplineConstant, "spline_constant", "the 2/3 of the cubic spline is typed as 0.667";
    SquareCells, "square_cells", "gradients of weights use h of the first axis along all axes";
    RingVolumes, "ring_volumes", "all particles of an annulus have the volume of a particle on the middle circle";
    HoopStress, "hoop_stress", "the stress around the axis is left out: no - V0 tau_tt w/r";
    RadiusWeight, "radius_weight", "masses and volumes of rings lack the radius, as for boxes in a plane";
    EdgeVolume, "edge_volume", "the volume of a ring takes the radius of its outer edge";
    FlatWeights, "flat_weights", "averages over a ring lack the weight r";
    AxisFixed, "axis_fixed", "the axis is a fixed wall, so that its nodes do not move along it either";
    NoGhosts, "no_ghosts", "contributions past a wall are lost: there are no ghost nodes";
    WallReleased, "wall_released", "nodes on a wall are not held";
    MirrorSign, "mirror_sign", "ghost nodes move with their images in place of opposite to them";
    MirrorVelocityAlone, "mirror_velocity_alone", "ghost nodes get the mirrored velocity, and not the acceleration";
    StickyRoller, "sticky_roller", "a roller holds the tangential components as well";
    PeriodOfNodes, "period_of_nodes", "a period has as many cells as nodes, one too many";
    LateWall, "late_wall", "prescribed nodes get the velocity of one step before";
    UninvertedWall, "uninverted_wall", "prescribed nodes use the reference position of the nearest sample, without inverting the motion";
    TractionArea, "traction_area", "the Cauchy traction on the reference area";
    TractionAtParticle, "traction_at_particle", "tractions act at the particle in place of the face";
    TractionOfKirchhoff, "traction_of_kirchhoff", "tractions of the Kirchhoff stress in place of the Cauchy stress";
}
