//! Deliberate mistakes in the solver (fault injection), of the kind that people make.
//!
//! With the feature `defects`, [`select`] makes the process make one of them, and a verification that is worth its
//! name fails; see `mms verify --defects`. Without the feature none of it is there.

mms_math::defects! {
    ForceLate, "force_late", "b at t - dt in place of t";
    ForceAhead, "force_ahead", "b at t + dt/2 in place of t: a leapfrog that thinks of its velocities";
    ForceAtPresent, "force_at_present", "b at the present position in place of the reference position";
    StartAtRest, "start_at_rest", "v(0) = 0 in place of the field's";
    StartSingle, "start_single", "v(0) passes through single precision on its way";
    StartUndeformed, "start_undeformed", "F(0) = I in place of the field's";
    MassOfPresentVolume, "mass_of_present_volume", "m = rho0 J V0: the reference density with the present volume";
    MassCutOff, "mass_cut_off", "nodes with less than a hundredth of a particle's mass are taken as empty";
    FullFirstKick, "full_first_kick", "leapfrog without its half first step: v(0) taken for v(-dt/2)";
    StaleNodalVelocity, "stale_nodal_velocity", "particles follow v_i from before dt a_i was added";
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
    AffineFactor, "affine_factor", "APIC takes the D^-1 of cubic splines, 3/h^2, for quadratic ones, whose is 4/h^2";
    XpicOrder, "xpic_order", "XPIC stops one map early";
    XpicSign, "xpic_sign", "XPIC adds what the grid does not hold";
    HalfWidthKept, "half_width_kept", "the half widths of cpgimp stay what they were";
    HalfWidthsSwapped, "half_widths_swapped", "the half widths of a box are in the reverse order of its axes";
    ShortSupport, "short_support", "GIMP leaves out the last of its nodes";
    CornersKept, "corners_kept", "the corners of cpdi stay where they were about the particle";
    CornersTransposed, "corners_transposed", "the gradients of cpdi are made of R^-1 in place of R^-T";
    SplineEnds, "spline_ends", "splines at the ends of knots are the inner ones";
    SplineConstant, "spline_constant", "the 2/3 of the cubic spline is typed as 0.667";
    SquareCells, "square_cells", "gradients of weights take h of the first axis along all of them";
    RingVolumes, "ring_volumes", "all particles of an annulus have the volume of those on the middle circle";
    HoopStress, "hoop_stress", "the stress around the axis is left out: no - V0 tau_tt w/r";
    RadiusWeight, "radius_weight", "masses and volumes of rings lack the radius, as for boxes in a plane";
    EdgeVolume, "edge_volume", "the volume of a ring takes the radius of its outer edge";
    FlatWeights, "flat_weights", "averages over a ring lack the weight r";
    AxisFixed, "axis_fixed", "the axis is a fixed wall, whose nodes move along it no more than away from it";
    NoGhosts, "no_ghosts", "what reaches past a wall is lost: there are no ghost nodes";
    WallReleased, "wall_released", "nodes on a wall are not held";
    MirrorSign, "mirror_sign", "ghost nodes move with their images in place of opposite to them";
    MirrorVelocityAlone, "mirror_velocity_alone", "ghost nodes get the mirrored velocity, and not the acceleration";
    StickyRoller, "sticky_roller", "a roller holds the tangential components as well";
    PeriodOfNodes, "period_of_nodes", "a period counts its nodes, one too many, in place of its cells";
    LateWall, "late_wall", "prescribed nodes get the velocity of one step before";
    UninvertedWall, "uninverted_wall", "prescribed nodes take the reference position of the nearest sample's motion";
    TractionArea, "traction_area", "the Cauchy traction on the reference area";
    TractionAtParticle, "traction_at_particle", "tractions act at the particle in place of the face";
    TractionOfKirchhoff, "traction_of_kirchhoff", "tractions of the Kirchhoff stress in place of the Cauchy stress";
}
