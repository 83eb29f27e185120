def around_the_axis(R, Z, u):
    """F of an axisymmetric displacement, by rows in the order R, Z, theta."""
    hoop = [-u[2] / R, 0, u[0] / R]
    return Matrix(3, 3, lambda i, j: (hoop[i] if j == 2 else diff(u[i], [R, Z][j])) + int(i == j))


def field(X, Y, Z, t):
    """The field in space of which the field file has the section Y = 0, X > 0."""
    R, axial = Symbol("R", positive=True), Symbol("Z", real=True)
    u, density, arguments, fibre, own = meridian(R, axial, t)
    radius = sqrt(X**2 + Y**2)

    def placed(expression):
        return sympify(expression).subs({R: radius, axial: Z}, simultaneous=True)

    def turned(vector):
        r, z, theta = [placed(component) for component in [*vector, 0][:3]]
        return [(r * X - theta * Y) / radius, (r * Y + theta * X) / radius, z]

    return (
        turned(u),
        placed(density),
        {name: placed(argument) for name, argument in arguments.items()},
        turned(fibre),
        {name: turned(own_) if len(own_) > 1 else [placed(own_[0])] for name, own_ in own.items()},
    )


in_cartesian_coordinates = derived


def derived(dimension):
    """The same at points R, Z, with the components along R, Z and, where points have one, the hoop."""
    at = in_cartesian_coordinates(3)
    order = [0, 2, 1]

    def components(values):
        if len(values) == 9:
            return [values[3 * i + j] for i in order for j in order]
        return [values[i] for i in order[:VECTOR]] if len(values) == 3 else values

    def section(X, t, N):
        values = at([X[0], mpmath.mpf(0), X[1]], t, [N[0], mpmath.mpf(0), N[1]])
        return {name: components(value) for name, value in values.items()}

    return section
