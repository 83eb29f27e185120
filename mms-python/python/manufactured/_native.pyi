"""The extension module. generate.py wrote this."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, final

import numpy as np
import numpy.typing as npt

# Of the precision of X: float32 or float64.
_Array = npt.NDArray[Any]
_Numbers = npt.ArrayLike
_Parameter = float | str | Any

__version__: str
__file__: str

class MmsError(ValueError): ...

class FieldError(MmsError):
    places: list[tuple[str, int, int, str]]

@final
class Field:
    def displacement(self, X: _Numbers, t: float | None = None) -> _Array:
        """Displacement u(X, t). Unit: m."""
    def position(self, X: _Numbers, t: float | None = None) -> _Array:
        """Current position x = X + u. Unit: m."""
    def velocity(self, X: _Numbers, t: float | None = None) -> _Array:
        """Velocity v = du/dt at fixed X. Unit: m/s."""
    def acceleration(self, X: _Numbers, t: float | None = None) -> _Array:
        """Acceleration a = d2u/dt2 at fixed X. Unit: m/s^2."""
    def displacement_gradient(self, X: _Numbers, t: float | None = None) -> _Array:
        """Displacement gradient H_iJ = du_i/dX_J. Unit: 1."""
    def deformation_gradient(self, X: _Numbers, t: float | None = None) -> _Array:
        """Deformation gradient F = I + H. Unit: 1."""
    def jacobian(self, X: _Numbers, t: float | None = None) -> _Array:
        """Jacobian J = det F. Unit: 1."""
    def right_cauchy_green(self, X: _Numbers, t: float | None = None) -> _Array:
        """Right Cauchy-Green tensor C = F^T F. Unit: 1."""
    def left_cauchy_green(self, X: _Numbers, t: float | None = None) -> _Array:
        """Left Cauchy-Green tensor B = F F^T. Unit: 1."""
    def green_lagrange(self, X: _Numbers, t: float | None = None) -> _Array:
        """Green-Lagrange strain E = (C - I)/2. Unit: 1."""
    def mass_density(self, X: _Numbers, t: float | None = None) -> _Array:
        """Mass per unit current volume rho = rho0/J. Unit: kg/m^3."""
    def strain_energy(self, X: _Numbers, t: float | None = None) -> _Array:
        """Strain-energy density W per unit reference volume. Unit: Pa."""
    def first_piola_kirchhoff(self, X: _Numbers, t: float | None = None) -> _Array:
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ. Unit: Pa."""
    def nominal_stress(self, X: _Numbers, t: float | None = None) -> _Array:
        """Nominal stress P^T = J F^-1 sigma. Unit: Pa."""
    def cauchy_stress(self, X: _Numbers, t: float | None = None) -> _Array:
        """Cauchy stress sigma = P F^T / J. Unit: Pa."""
    def kirchhoff_stress(self, X: _Numbers, t: float | None = None) -> _Array:
        """Kirchhoff stress tau = P F^T. Unit: Pa."""
    def div_p(self, X: _Numbers, t: float | None = None) -> _Array:
        """Material divergence (Div P)_i = dP_iJ/dX_J. Unit: Pa/m."""
    def div_sigma(self, X: _Numbers, t: float | None = None) -> _Array:
        """Spatial divergence (div sigma)_i = dsigma_ij/dx_j = (Div P)_i / J. Unit: Pa/m."""
    def body_force(self, X: _Numbers, t: float | None = None) -> _Array:
        """Body force per unit mass b = a - Div P / rho0. Unit: m/s^2."""
    def body_force_density(self, X: _Numbers, t: float | None = None) -> _Array:
        """Body force per unit reference volume rho0 b. Unit: N/m^3."""
    def current_body_force_density(self, X: _Numbers, t: float | None = None) -> _Array:
        """Body force per unit current volume rho b = rho0 b / J. Unit: N/m^3."""
    def second_piola_kirchhoff(self, X: _Numbers, t: float | None = None) -> _Array:
        """Second Piola-Kirchhoff stress S = F^-1 P. Unit: Pa."""
    def pressure(self, X: _Numbers, t: float | None = None) -> _Array:
        """Pressure p = -tr(sigma)/3, the stress out of the plane included. Unit: Pa."""
    def von_mises(self, X: _Numbers, t: float | None = None) -> _Array:
        """Von Mises stress sqrt(3/2 s:s) of the deviator s of sigma in three dimensions. Unit: Pa."""
    def strain(self, X: _Numbers, t: float | None = None) -> _Array:
        """Small strain eps = (H + H^T)/2. Unit: 1."""
    def u(self, X: _Numbers, t: float | None = None) -> _Array:
        """Displacement u(X, t). Unit: m."""
    def x(self, X: _Numbers, t: float | None = None) -> _Array:
        """Current position x = X + u. Unit: m."""
    def v(self, X: _Numbers, t: float | None = None) -> _Array:
        """Velocity v = du/dt at fixed X. Unit: m/s."""
    def a(self, X: _Numbers, t: float | None = None) -> _Array:
        """Acceleration a = d2u/dt2 at fixed X. Unit: m/s^2."""
    def H(self, X: _Numbers, t: float | None = None) -> _Array:
        """Displacement gradient H_iJ = du_i/dX_J. Unit: 1."""
    def F(self, X: _Numbers, t: float | None = None) -> _Array:
        """Deformation gradient F = I + H. Unit: 1."""
    def J(self, X: _Numbers, t: float | None = None) -> _Array:
        """Jacobian J = det F. Unit: 1."""
    def C(self, X: _Numbers, t: float | None = None) -> _Array:
        """Right Cauchy-Green tensor C = F^T F. Unit: 1."""
    def B(self, X: _Numbers, t: float | None = None) -> _Array:
        """Left Cauchy-Green tensor B = F F^T. Unit: 1."""
    def E(self, X: _Numbers, t: float | None = None) -> _Array:
        """Green-Lagrange strain E = (C - I)/2. Unit: 1."""
    def rho(self, X: _Numbers, t: float | None = None) -> _Array:
        """Mass per unit current volume rho = rho0/J. Unit: kg/m^3."""
    def W(self, X: _Numbers, t: float | None = None) -> _Array:
        """Strain-energy density W per unit reference volume. Unit: Pa."""
    def P(self, X: _Numbers, t: float | None = None) -> _Array:
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ. Unit: Pa."""
    def sigma(self, X: _Numbers, t: float | None = None) -> _Array:
        """Cauchy stress sigma = P F^T / J. Unit: Pa."""
    def b(self, X: _Numbers, t: float | None = None) -> _Array:
        """Body force per unit mass b = a - Div P / rho0. Unit: m/s^2."""
    def S(self, X: _Numbers, t: float | None = None) -> _Array:
        """Second Piola-Kirchhoff stress S = F^-1 P. Unit: Pa."""
    def __init__(self, u: Sequence[Any], **tables: Any) -> None: ...
    @property
    def text(self) -> str: ...
    def save(self, path: str | PathLike[str]) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def dimension(self) -> int: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    @property
    def faces(self) -> list[str]: ...
    @property
    def boundary(self) -> list[tuple[str, str]]: ...
    @property
    def bounds(self) -> tuple[list[float], list[float]]: ...
    def grid(
        self, cells: str, per_cell: str = "2"
    ) -> tuple[float, npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
    @property
    def window(self) -> tuple[float, float] | None: ...
    @property
    def quantities(self) -> list[str]: ...
    @property
    def material(self) -> Material: ...
    def at(self, t: float) -> Now: ...
    def points(self, X: _Numbers) -> AtPoints: ...
    def sample(self, count: int) -> npt.NDArray[np.float64]: ...
    def set(self, **parameters: _Parameter) -> Field: ...
    def evaluate(self, quantity: str, X: _Numbers, t: float | None = None, *, face: str | None = None) -> _Array: ...
    def traction(self, face: str, X: _Numbers, t: float | None = None) -> _Array: ...
    def show(self, *quantities: str, format: str = "text") -> str: ...
    def __getattr__(self, name: str) -> Any: ...

@final
class Now:
    def displacement(self, X: _Numbers) -> _Array:
        """Displacement u(X, t). Unit: m."""
    def position(self, X: _Numbers) -> _Array:
        """Current position x = X + u. Unit: m."""
    def velocity(self, X: _Numbers) -> _Array:
        """Velocity v = du/dt at fixed X. Unit: m/s."""
    def acceleration(self, X: _Numbers) -> _Array:
        """Acceleration a = d2u/dt2 at fixed X. Unit: m/s^2."""
    def displacement_gradient(self, X: _Numbers) -> _Array:
        """Displacement gradient H_iJ = du_i/dX_J. Unit: 1."""
    def deformation_gradient(self, X: _Numbers) -> _Array:
        """Deformation gradient F = I + H. Unit: 1."""
    def jacobian(self, X: _Numbers) -> _Array:
        """Jacobian J = det F. Unit: 1."""
    def right_cauchy_green(self, X: _Numbers) -> _Array:
        """Right Cauchy-Green tensor C = F^T F. Unit: 1."""
    def left_cauchy_green(self, X: _Numbers) -> _Array:
        """Left Cauchy-Green tensor B = F F^T. Unit: 1."""
    def green_lagrange(self, X: _Numbers) -> _Array:
        """Green-Lagrange strain E = (C - I)/2. Unit: 1."""
    def mass_density(self, X: _Numbers) -> _Array:
        """Mass per unit current volume rho = rho0/J. Unit: kg/m^3."""
    def strain_energy(self, X: _Numbers) -> _Array:
        """Strain-energy density W per unit reference volume. Unit: Pa."""
    def first_piola_kirchhoff(self, X: _Numbers) -> _Array:
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ. Unit: Pa."""
    def nominal_stress(self, X: _Numbers) -> _Array:
        """Nominal stress P^T = J F^-1 sigma. Unit: Pa."""
    def cauchy_stress(self, X: _Numbers) -> _Array:
        """Cauchy stress sigma = P F^T / J. Unit: Pa."""
    def kirchhoff_stress(self, X: _Numbers) -> _Array:
        """Kirchhoff stress tau = P F^T. Unit: Pa."""
    def div_p(self, X: _Numbers) -> _Array:
        """Material divergence (Div P)_i = dP_iJ/dX_J. Unit: Pa/m."""
    def div_sigma(self, X: _Numbers) -> _Array:
        """Spatial divergence (div sigma)_i = dsigma_ij/dx_j = (Div P)_i / J. Unit: Pa/m."""
    def body_force(self, X: _Numbers) -> _Array:
        """Body force per unit mass b = a - Div P / rho0. Unit: m/s^2."""
    def body_force_density(self, X: _Numbers) -> _Array:
        """Body force per unit reference volume rho0 b. Unit: N/m^3."""
    def current_body_force_density(self, X: _Numbers) -> _Array:
        """Body force per unit current volume rho b = rho0 b / J. Unit: N/m^3."""
    def second_piola_kirchhoff(self, X: _Numbers) -> _Array:
        """Second Piola-Kirchhoff stress S = F^-1 P. Unit: Pa."""
    def pressure(self, X: _Numbers) -> _Array:
        """Pressure p = -tr(sigma)/3, the stress out of the plane included. Unit: Pa."""
    def von_mises(self, X: _Numbers) -> _Array:
        """Von Mises stress sqrt(3/2 s:s) of the deviator s of sigma in three dimensions. Unit: Pa."""
    def strain(self, X: _Numbers) -> _Array:
        """Small strain eps = (H + H^T)/2. Unit: 1."""
    def u(self, X: _Numbers) -> _Array:
        """Displacement u(X, t). Unit: m."""
    def x(self, X: _Numbers) -> _Array:
        """Current position x = X + u. Unit: m."""
    def v(self, X: _Numbers) -> _Array:
        """Velocity v = du/dt at fixed X. Unit: m/s."""
    def a(self, X: _Numbers) -> _Array:
        """Acceleration a = d2u/dt2 at fixed X. Unit: m/s^2."""
    def H(self, X: _Numbers) -> _Array:
        """Displacement gradient H_iJ = du_i/dX_J. Unit: 1."""
    def F(self, X: _Numbers) -> _Array:
        """Deformation gradient F = I + H. Unit: 1."""
    def J(self, X: _Numbers) -> _Array:
        """Jacobian J = det F. Unit: 1."""
    def C(self, X: _Numbers) -> _Array:
        """Right Cauchy-Green tensor C = F^T F. Unit: 1."""
    def B(self, X: _Numbers) -> _Array:
        """Left Cauchy-Green tensor B = F F^T. Unit: 1."""
    def E(self, X: _Numbers) -> _Array:
        """Green-Lagrange strain E = (C - I)/2. Unit: 1."""
    def rho(self, X: _Numbers) -> _Array:
        """Mass per unit current volume rho = rho0/J. Unit: kg/m^3."""
    def W(self, X: _Numbers) -> _Array:
        """Strain-energy density W per unit reference volume. Unit: Pa."""
    def P(self, X: _Numbers) -> _Array:
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ. Unit: Pa."""
    def sigma(self, X: _Numbers) -> _Array:
        """Cauchy stress sigma = P F^T / J. Unit: Pa."""
    def b(self, X: _Numbers) -> _Array:
        """Body force per unit mass b = a - Div P / rho0. Unit: m/s^2."""
    def S(self, X: _Numbers) -> _Array:
        """Second Piola-Kirchhoff stress S = F^-1 P. Unit: Pa."""
    @property
    def time(self) -> float: ...
    def traction(self, face: str, X: _Numbers) -> _Array: ...

@final
class AtPoints:
    def displacement(self, t: float | None = None) -> _Array:
        """Displacement u(X, t). Unit: m."""
    def position(self, t: float | None = None) -> _Array:
        """Current position x = X + u. Unit: m."""
    def velocity(self, t: float | None = None) -> _Array:
        """Velocity v = du/dt at fixed X. Unit: m/s."""
    def acceleration(self, t: float | None = None) -> _Array:
        """Acceleration a = d2u/dt2 at fixed X. Unit: m/s^2."""
    def displacement_gradient(self, t: float | None = None) -> _Array:
        """Displacement gradient H_iJ = du_i/dX_J. Unit: 1."""
    def deformation_gradient(self, t: float | None = None) -> _Array:
        """Deformation gradient F = I + H. Unit: 1."""
    def jacobian(self, t: float | None = None) -> _Array:
        """Jacobian J = det F. Unit: 1."""
    def right_cauchy_green(self, t: float | None = None) -> _Array:
        """Right Cauchy-Green tensor C = F^T F. Unit: 1."""
    def left_cauchy_green(self, t: float | None = None) -> _Array:
        """Left Cauchy-Green tensor B = F F^T. Unit: 1."""
    def green_lagrange(self, t: float | None = None) -> _Array:
        """Green-Lagrange strain E = (C - I)/2. Unit: 1."""
    def mass_density(self, t: float | None = None) -> _Array:
        """Mass per unit current volume rho = rho0/J. Unit: kg/m^3."""
    def strain_energy(self, t: float | None = None) -> _Array:
        """Strain-energy density W per unit reference volume. Unit: Pa."""
    def first_piola_kirchhoff(self, t: float | None = None) -> _Array:
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ. Unit: Pa."""
    def nominal_stress(self, t: float | None = None) -> _Array:
        """Nominal stress P^T = J F^-1 sigma. Unit: Pa."""
    def cauchy_stress(self, t: float | None = None) -> _Array:
        """Cauchy stress sigma = P F^T / J. Unit: Pa."""
    def kirchhoff_stress(self, t: float | None = None) -> _Array:
        """Kirchhoff stress tau = P F^T. Unit: Pa."""
    def div_p(self, t: float | None = None) -> _Array:
        """Material divergence (Div P)_i = dP_iJ/dX_J. Unit: Pa/m."""
    def div_sigma(self, t: float | None = None) -> _Array:
        """Spatial divergence (div sigma)_i = dsigma_ij/dx_j = (Div P)_i / J. Unit: Pa/m."""
    def body_force(self, t: float | None = None) -> _Array:
        """Body force per unit mass b = a - Div P / rho0. Unit: m/s^2."""
    def body_force_density(self, t: float | None = None) -> _Array:
        """Body force per unit reference volume rho0 b. Unit: N/m^3."""
    def current_body_force_density(self, t: float | None = None) -> _Array:
        """Body force per unit current volume rho b = rho0 b / J. Unit: N/m^3."""
    def second_piola_kirchhoff(self, t: float | None = None) -> _Array:
        """Second Piola-Kirchhoff stress S = F^-1 P. Unit: Pa."""
    def pressure(self, t: float | None = None) -> _Array:
        """Pressure p = -tr(sigma)/3, the stress out of the plane included. Unit: Pa."""
    def von_mises(self, t: float | None = None) -> _Array:
        """Von Mises stress sqrt(3/2 s:s) of the deviator s of sigma in three dimensions. Unit: Pa."""
    def strain(self, t: float | None = None) -> _Array:
        """Small strain eps = (H + H^T)/2. Unit: 1."""
    def u(self, t: float | None = None) -> _Array:
        """Displacement u(X, t). Unit: m."""
    def x(self, t: float | None = None) -> _Array:
        """Current position x = X + u. Unit: m."""
    def v(self, t: float | None = None) -> _Array:
        """Velocity v = du/dt at fixed X. Unit: m/s."""
    def a(self, t: float | None = None) -> _Array:
        """Acceleration a = d2u/dt2 at fixed X. Unit: m/s^2."""
    def H(self, t: float | None = None) -> _Array:
        """Displacement gradient H_iJ = du_i/dX_J. Unit: 1."""
    def F(self, t: float | None = None) -> _Array:
        """Deformation gradient F = I + H. Unit: 1."""
    def J(self, t: float | None = None) -> _Array:
        """Jacobian J = det F. Unit: 1."""
    def C(self, t: float | None = None) -> _Array:
        """Right Cauchy-Green tensor C = F^T F. Unit: 1."""
    def B(self, t: float | None = None) -> _Array:
        """Left Cauchy-Green tensor B = F F^T. Unit: 1."""
    def E(self, t: float | None = None) -> _Array:
        """Green-Lagrange strain E = (C - I)/2. Unit: 1."""
    def rho(self, t: float | None = None) -> _Array:
        """Mass per unit current volume rho = rho0/J. Unit: kg/m^3."""
    def W(self, t: float | None = None) -> _Array:
        """Strain-energy density W per unit reference volume. Unit: Pa."""
    def P(self, t: float | None = None) -> _Array:
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ. Unit: Pa."""
    def sigma(self, t: float | None = None) -> _Array:
        """Cauchy stress sigma = P F^T / J. Unit: Pa."""
    def b(self, t: float | None = None) -> _Array:
        """Body force per unit mass b = a - Div P / rho0. Unit: m/s^2."""
    def S(self, t: float | None = None) -> _Array:
        """Second Piola-Kirchhoff stress S = F^-1 P. Unit: Pa."""
    def traction(self, face: str, t: float | None = None) -> _Array: ...

@final
class Material:
    def P(self, H: _Numbers, X: _Numbers | None = None, t: float | None = None) -> _Array: ...

@final
class Level:
    def __init__(
        self,
        h: float | None = None,
        X: _Numbers | None = None,
        u: _Numbers | None = None,
        *,
        t: float | None = None,
        cells: Sequence[tuple[int, Any]] | None = None,
        **quantities: _Numbers,
    ) -> None: ...
    @property
    def h(self) -> float | None: ...
    @property
    def t(self) -> float | None: ...
    @property
    def names(self) -> list[str]: ...

def field(name: str, /, **parameters: _Parameter) -> Field: ...
def load(path: str | PathLike[str], /, **parameters: _Parameter) -> Field: ...
def loads(text: str, material: str | None = None, /, **parameters: _Parameter) -> Field: ...
def gallery() -> list[str]: ...
def judge(
    field: Field,
    results: Sequence[Level | str | PathLike[str]],
    quantities: Sequence[str],
    times: Sequence[float],
    orders: Sequence[tuple[str | None, float]],
    tolerance: float | None,
    start: str | None,
    over: str | None,
    part: bool,
    all_components: bool,
) -> dict[str, str | None]: ...
def diagnose(
    field: Field,
    results: Sequence[Level | str | PathLike[str]],
    law: str | None,
    quantities: Sequence[str],
    times: Sequence[float],
    time_steps: Sequence[float],
    orders: Sequence[tuple[str | None, float]],
    without: Sequence[str],
    residual_sign: float,
    nodal: bool,
) -> tuple[dict[str, str | None], list[str]]: ...
def study(
    field: Field, options: Sequence[str], progress: Callable[[str], object] | None
) -> dict[str, str | None]: ...
def command(file: str, words: Sequence[str], arguments: Sequence[str]) -> int: ...
