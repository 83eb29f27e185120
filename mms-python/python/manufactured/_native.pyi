"""The extension module. generate.py wrote this."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, TypeVar, final, overload

import numpy as np
import numpy.typing as npt

# An array has the precision of X: float32 or float64.
_Real = TypeVar("_Real", np.float32, np.float64)
_Shape = TypeVar("_Shape", bound=tuple[int, ...])
_Of = np.ndarray[_Shape, np.dtype[_Real]]
_Array = npt.NDArray[Any]
_Doubles = npt.NDArray[np.float64]
_Numbers = npt.ArrayLike
_Parameter = float | str | Any

__version__: str

class MmsError(ValueError): ...

class FieldError(MmsError):
    places: list[tuple[str, int, int, str]]

@final
class Field:
    @overload
    def displacement(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def displacement(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Displacement u(X, t). Unit: m."""
    @overload
    def position(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def position(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Current position x = X + u. Unit: m."""
    @overload
    def velocity(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def velocity(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Velocity v = du/dt at fixed X. Unit: m/s."""
    @overload
    def acceleration(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def acceleration(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Acceleration a = d2u/dt2 at fixed X. Unit: m/s^2."""
    @overload
    def displacement_gradient(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def displacement_gradient(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Displacement gradient H_iJ = du_i/dX_J. Unit: 1."""
    @overload
    def deformation_gradient(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def deformation_gradient(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Deformation gradient F = I + H. Unit: 1."""
    @overload
    def jacobian(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def jacobian(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Jacobian J = det F. Unit: 1."""
    @overload
    def right_cauchy_green(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def right_cauchy_green(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Right Cauchy-Green tensor C = F^T F. Unit: 1."""
    @overload
    def left_cauchy_green(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def left_cauchy_green(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Left Cauchy-Green tensor B = F F^T. Unit: 1."""
    @overload
    def green_lagrange(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def green_lagrange(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Green-Lagrange strain E = (C - I)/2. Unit: 1."""
    @overload
    def mass_density(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def mass_density(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Mass per unit current volume rho = rho0/J. Unit: kg/m^3."""
    @overload
    def strain_energy(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def strain_energy(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Strain-energy density W per unit reference volume. Unit: Pa."""
    @overload
    def first_piola_kirchhoff(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def first_piola_kirchhoff(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ. Unit: Pa."""
    @overload
    def nominal_stress(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def nominal_stress(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Nominal stress P^T = J F^-1 sigma. Unit: Pa."""
    @overload
    def cauchy_stress(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def cauchy_stress(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Cauchy stress sigma = P F^T / J. Unit: Pa."""
    @overload
    def kirchhoff_stress(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def kirchhoff_stress(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Kirchhoff stress tau = P F^T. Unit: Pa."""
    @overload
    def div_p(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def div_p(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Material divergence (Div P)_i = dP_iJ/dX_J. Unit: Pa/m."""
    @overload
    def div_sigma(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def div_sigma(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Spatial divergence (div sigma)_i = dsigma_ij/dx_j = (Div P)_i / J. Unit: Pa/m."""
    @overload
    def body_force(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def body_force(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Body force per unit mass b = a - Div P / rho0. Unit: m/s^2."""
    @overload
    def body_force_density(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def body_force_density(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Body force per unit reference volume rho0 b. Unit: N/m^3."""
    @overload
    def current_body_force_density(self, X: _Of[_Shape, _Real], t: float | None = None) -> _Of[_Shape, _Real]: ...
    @overload
    def current_body_force_density(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Body force per unit current volume rho b = rho0 b / J. Unit: N/m^3."""
    @overload
    def second_piola_kirchhoff(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def second_piola_kirchhoff(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Second Piola-Kirchhoff stress S = F^-1 P. Unit: Pa."""
    @overload
    def pressure(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def pressure(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Pressure p = -tr(sigma)/3, the stress out of the plane included. Unit: Pa."""
    @overload
    def von_mises(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def von_mises(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Von Mises stress sqrt(3/2 s:s) of the deviator s of sigma in three dimensions. Unit: Pa."""
    @overload
    def strain(self, X: npt.NDArray[_Real], t: float | None = None) -> npt.NDArray[_Real]: ...
    @overload
    def strain(self, X: _Numbers, t: float | None = None) -> _Doubles:
        """Small strain eps = (H + H^T)/2. Unit: 1."""
    u = displacement
    x = position
    v = velocity
    a = acceleration
    H = displacement_gradient
    F = deformation_gradient
    J = jacobian
    C = right_cauchy_green
    B = left_cauchy_green
    E = green_lagrange
    rho = mass_density
    W = strain_energy
    P = first_piola_kirchhoff
    sigma = cauchy_stress
    b = body_force
    S = second_piola_kirchhoff
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
    def boundary(self) -> dict[str, str]: ...
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
    @overload
    def displacement(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def displacement(self, X: _Numbers) -> _Doubles:
        """Displacement u(X, t). Unit: m."""
    @overload
    def position(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def position(self, X: _Numbers) -> _Doubles:
        """Current position x = X + u. Unit: m."""
    @overload
    def velocity(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def velocity(self, X: _Numbers) -> _Doubles:
        """Velocity v = du/dt at fixed X. Unit: m/s."""
    @overload
    def acceleration(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def acceleration(self, X: _Numbers) -> _Doubles:
        """Acceleration a = d2u/dt2 at fixed X. Unit: m/s^2."""
    @overload
    def displacement_gradient(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def displacement_gradient(self, X: _Numbers) -> _Doubles:
        """Displacement gradient H_iJ = du_i/dX_J. Unit: 1."""
    @overload
    def deformation_gradient(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def deformation_gradient(self, X: _Numbers) -> _Doubles:
        """Deformation gradient F = I + H. Unit: 1."""
    @overload
    def jacobian(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def jacobian(self, X: _Numbers) -> _Doubles:
        """Jacobian J = det F. Unit: 1."""
    @overload
    def right_cauchy_green(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def right_cauchy_green(self, X: _Numbers) -> _Doubles:
        """Right Cauchy-Green tensor C = F^T F. Unit: 1."""
    @overload
    def left_cauchy_green(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def left_cauchy_green(self, X: _Numbers) -> _Doubles:
        """Left Cauchy-Green tensor B = F F^T. Unit: 1."""
    @overload
    def green_lagrange(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def green_lagrange(self, X: _Numbers) -> _Doubles:
        """Green-Lagrange strain E = (C - I)/2. Unit: 1."""
    @overload
    def mass_density(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def mass_density(self, X: _Numbers) -> _Doubles:
        """Mass per unit current volume rho = rho0/J. Unit: kg/m^3."""
    @overload
    def strain_energy(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def strain_energy(self, X: _Numbers) -> _Doubles:
        """Strain-energy density W per unit reference volume. Unit: Pa."""
    @overload
    def first_piola_kirchhoff(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def first_piola_kirchhoff(self, X: _Numbers) -> _Doubles:
        """First Piola-Kirchhoff stress P_iJ = dW/dF_iJ. Unit: Pa."""
    @overload
    def nominal_stress(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def nominal_stress(self, X: _Numbers) -> _Doubles:
        """Nominal stress P^T = J F^-1 sigma. Unit: Pa."""
    @overload
    def cauchy_stress(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def cauchy_stress(self, X: _Numbers) -> _Doubles:
        """Cauchy stress sigma = P F^T / J. Unit: Pa."""
    @overload
    def kirchhoff_stress(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def kirchhoff_stress(self, X: _Numbers) -> _Doubles:
        """Kirchhoff stress tau = P F^T. Unit: Pa."""
    @overload
    def div_p(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def div_p(self, X: _Numbers) -> _Doubles:
        """Material divergence (Div P)_i = dP_iJ/dX_J. Unit: Pa/m."""
    @overload
    def div_sigma(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def div_sigma(self, X: _Numbers) -> _Doubles:
        """Spatial divergence (div sigma)_i = dsigma_ij/dx_j = (Div P)_i / J. Unit: Pa/m."""
    @overload
    def body_force(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def body_force(self, X: _Numbers) -> _Doubles:
        """Body force per unit mass b = a - Div P / rho0. Unit: m/s^2."""
    @overload
    def body_force_density(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def body_force_density(self, X: _Numbers) -> _Doubles:
        """Body force per unit reference volume rho0 b. Unit: N/m^3."""
    @overload
    def current_body_force_density(self, X: _Of[_Shape, _Real]) -> _Of[_Shape, _Real]: ...
    @overload
    def current_body_force_density(self, X: _Numbers) -> _Doubles:
        """Body force per unit current volume rho b = rho0 b / J. Unit: N/m^3."""
    @overload
    def second_piola_kirchhoff(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def second_piola_kirchhoff(self, X: _Numbers) -> _Doubles:
        """Second Piola-Kirchhoff stress S = F^-1 P. Unit: Pa."""
    @overload
    def pressure(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def pressure(self, X: _Numbers) -> _Doubles:
        """Pressure p = -tr(sigma)/3, the stress out of the plane included. Unit: Pa."""
    @overload
    def von_mises(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def von_mises(self, X: _Numbers) -> _Doubles:
        """Von Mises stress sqrt(3/2 s:s) of the deviator s of sigma in three dimensions. Unit: Pa."""
    @overload
    def strain(self, X: npt.NDArray[_Real]) -> npt.NDArray[_Real]: ...
    @overload
    def strain(self, X: _Numbers) -> _Doubles:
        """Small strain eps = (H + H^T)/2. Unit: 1."""
    u = displacement
    x = position
    v = velocity
    a = acceleration
    H = displacement_gradient
    F = deformation_gradient
    J = jacobian
    C = right_cauchy_green
    B = left_cauchy_green
    E = green_lagrange
    rho = mass_density
    W = strain_energy
    P = first_piola_kirchhoff
    sigma = cauchy_stress
    b = body_force
    S = second_piola_kirchhoff
    @property
    def time(self) -> float: ...
    def traction(self, face: str, X: _Numbers) -> _Array: ...
    def evaluate(self, quantity: str, X: _Numbers, *, face: str | None = None) -> _Array: ...
    def __getattr__(self, name: str) -> Any: ...

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
    u = displacement
    x = position
    v = velocity
    a = acceleration
    H = displacement_gradient
    F = deformation_gradient
    J = jacobian
    C = right_cauchy_green
    B = left_cauchy_green
    E = green_lagrange
    rho = mass_density
    W = strain_energy
    P = first_piola_kirchhoff
    sigma = cauchy_stress
    b = body_force
    S = second_piola_kirchhoff
    def traction(self, face: str, t: float | None = None) -> _Array: ...
    def evaluate(self, quantity: str, t: float | None = None, *, face: str | None = None) -> _Array: ...
    def __getattr__(self, name: str) -> Any: ...

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
        cells: Sequence[tuple[int | str, Any]] | None = None,
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
    progress: Callable[[str], object] | None,
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
    progress: Callable[[str], object] | None,
) -> tuple[dict[str, str | None], list[str]]: ...
def study(
    field: Field, options: Sequence[str], progress: Callable[[str], object] | None
) -> dict[str, str | None]: ...
def command(file: str, words: Sequence[str], arguments: Sequence[str]) -> int: ...
