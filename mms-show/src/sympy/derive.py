def number(expression, arguments):
    """A function that evaluates an expression with 50 digits."""
    return lambdify(arguments, expression, [{"Cbrt": real_cube_root}, "mpmath"], cse=True)


def motion(X, t):
    """u, v, a, H and the second derivatives u_i,JK as functions of X and t."""
    u, density, arguments, fibre, own = field(*X, t)
    v = [diff(component, t) for component in u]
    a = [diff(component, t) for component in v]
    H = [[diff(component, x) for x in X] for component in u]
    second = [[[diff(slope, x) for x in X] for slope in row] for row in H]
    numbers = number([u, v, a, H, second, density, list(own.values())], [*X, t])
    return numbers, arguments, fibre, list(own)


def in_space(X, u):
    """F in three dimensions: 1 on the diagonal that the field lacks."""
    D = len(X)
    return Matrix(3, 3, lambda i, j: (diff(u[i], X[j]) if max(i, j) < D else 0) + int(i == j))


def determinant(F):
    """det F of three by three."""
    def cofactor(j):
        k, m = (j + 1) % 3, (j + 2) % 3
        return F[1, k] * F[2, m] - F[1, m] * F[2, k]

    return sum(F[0, j] * cofactor(j) for j in range(3))


def response(X, t, arguments, fibre):
    """J, W, P = dW/dF, dP/dF and the explicit dP_iJ/dX_K as functions of X, t and F.

    W is evaluated for a body in space. The diagonal entries of F that the field lacks are 1.
    """
    D = len(X)
    F = [[Symbol(f"F{i + 1}{j + 1}", real=True) for j in range(D)] for i in range(D)]
    space = Matrix(3, 3, lambda i, j: F[i][j] if max(i, j) < D else int(i == j))
    C = space.T * space
    I1 = C.trace()
    I2 = (I1**2 - (C * C).trace()) / 2
    J = determinant(space)
    stretched = space * Matrix(fibre)
    I4 = stretched.dot(stretched)
    H = space - eye(3)
    small = (H + H.T) / 2
    W = strain_energy(I1, I2, J**2, J, I4, small.trace(), (small * small).trace(), **arguments)
    P = [[diff(W, entry) for entry in row] for row in F]
    tangent = [[[[diff(P[i][j], entry) for entry in row] for row in F] for j in range(D)]
               for i in range(D)]
    explicit = [[[diff(entry, x) for x in X] for entry in row] for row in P]
    return number([J, W, P, tangent, explicit], [*X, t, *sum(F, [])])


def derived(dimension):
    """A function from X and t to every quantity, a list of components each, rows first."""
    X = [Symbol(name, real=True) for name in "XYZ"[:dimension]]
    t = Symbol("t", real=True)
    motion_at, arguments, fibre, names = motion(X, t)
    response_at = response(X, t, arguments, fibre)

    def at(X, t, N):
        D = range(len(X))
        u, v, a, H, second, density, values = motion_at(*X, t)
        F = [[H[i][j] + (i == j) for j in D] for i in D]
        C = [[sum(F[k][i] * F[k][j] for k in D) for j in D] for i in D]
        J, W, P, tangent, explicit = response_at(*X, t, *sum(F, []))
        # F and J, which map stresses and densities to the present configuration: at small strain there is one stress.
        carrier, volume, bent = (eye(len(X)).tolist(), 1, [[[0] * 3] * 3] * 3) if SMALL_STRAIN else (F, J, second)
        tau = [[sum(P[i][k] * carrier[j][k] for k in D) for j in D] for i in D]
        # dP_iJ/dX_K = dP_iJ/dF_mN u_m,NK, and what depends on X by itself.
        slope = [[[explicit[i][j][k] + sum(tangent[i][j][m][n] * second[m][n][k]
                                           for m in D for n in D) for k in D] for j in D] for i in D]
        div_p = [sum(slope[i][j][j] for j in D) for i in D]
        # dsigma_ij/dx_j = dsigma_ij/dX_K F^-1_Kj of sigma = P F^T/J: without the Piola identity.
        inverse = mpmath.matrix(carrier) ** -1
        log_slope = [sum(inverse[n, m] * bent[m][n][k] for m in D for n in D) for k in D]
        div_sigma = [sum((sum(slope[i][m][k] * carrier[j][m] + P[i][m] * bent[j][m][k] for m in D)
                          - tau[i][j] * log_slope[k]) / volume * inverse[k, j]
                         for j in D for k in D) for i in D]
        own = dict(zip(names, values))
        for name in NORMAL_FLUXES:
            own[name] = [sum(own[name][j] * N[j] for j in D)]
        return own | {
            "displacement": u,
            "position": [X[i] + u[i] for i in D],
            "velocity": v,
            "acceleration": a,
            "displacement_gradient": sum(H, []),
            "deformation_gradient": sum(F, []),
            "jacobian": [J],
            "right_cauchy_green": [C[i][j] for i in D for j in D],
            "left_cauchy_green": [sum(F[i][k] * F[j][k] for k in D) for i in D for j in D],
            "green_lagrange": [(C[i][j] - (i == j)) / 2 for i in D for j in D],
            "mass_density": [density / volume],
            "strain_energy": [W],
            "first_piola_kirchhoff": sum(P, []),
            "nominal_stress": [P[j][i] for i in D for j in D],
            "cauchy_stress": [tau[i][j] / volume for i in D for j in D],
            "kirchhoff_stress": sum(tau, []),
            "div_p": div_p,
            "div_sigma": div_sigma,
            "body_force": [a[i] - div_p[i] / density for i in D],
            "body_force_density": [density * a[i] - div_p[i] for i in D],
            "current_body_force_density": [density / volume * a[i] - div_sigma[i] for i in D],
            "traction": [sum(P[i][j] * N[j] for j in D) for i in D],
        }

    return at
