def moved(X, u, angle=Integer(0), axis=None, translation=None):
    """Q x + d - X: the displacement after a rotation about the origin and a translation."""
    D = len(X)
    x = Matrix([X[i] + u[i] for i in range(D)])
    if D == 2:
        x = Matrix([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]]) * x
    if axis is not None:
        n = Matrix(axis) / sqrt(sum(component**2 for component in axis))
        # Rodrigues: the part along the axis stays, the rest turns.
        x = n * n.dot(x) + (x - n * n.dot(x)) * cos(angle) + n.cross(x) * sin(angle)
    d = translation or [Integer(0)] * D
    return [x[i] + d[i] - X[i] for i in range(D)]
