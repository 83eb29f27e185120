# The quantities that mms computes for this field, derived a second time. The displacement u(X, t) and
# the strain-energy density W follow below as they are typed in the field file and in the file of its
# material, with exact numbers. From them SymPy derives
#
#     v = du/dt    a = dv/dt    H = du/dX    F = I + H    J = det F    P = dW/dF
#     sigma = P F^T/J    tau = P F^T    (Div P)_i = dP_iJ/dX_J    b = a - Div P/rho0    T = P N
#     x = X + u    C = F^T F    B = F F^T    2 E = C - I    rho = rho0/J
#     (div sigma)_i = dsigma_ij/dx_j    rho b = rho a - div sigma
#
# and mpmath evaluates them with 50 digits. At the end they are compared with the numbers that mms
# computes in double precision. Usage: python3 FILE, with Python 3.10 or later, and SymPy. The exit
# code is 1 if a number differs by more than TOLERANCE, relative to the largest magnitude of its
# quantity.

import sys

import mpmath
from sympy import Function, Integer, Matrix, Rational, Symbol, diff, eye, lambdify, sympify
from sympy import acos, asin, atan, atan2, cos, cosh, exp, log, pi, sin, sinh, sqrt, tan, tanh

TOLERANCE = mpmath.mpf("1e-12")
mpmath.mp.dps = 50


class Cbrt(Function):
    """The real cube root, of either sign; SymPy's own is complex for negative numbers."""

    def fdiff(self, argindex=1):
        return 1 / (3 * Cbrt(self.args[0]) ** 2)


def real_cube_root(x):
    return mpmath.sign(x) * mpmath.cbrt(abs(x))
