"""Reads the states of a run with meshio, and checks that they are consistent: x = X + d, with the same X and particles in each."""

import sys

import meshio
import numpy

states = [meshio.read(path) for path in sorted(sys.argv[1:])]
assert len(states) == 3, len(states)
reference = states[0].points - states[0].point_data["displacement"]
for state in states:
    data = state.point_data
    assert state.cells[0].type == "vertex" and len(state.cells[0].data) == len(state.points)
    assert (data["particle"].ravel() == numpy.arange(len(state.points))).all()
    assert abs(state.points - data["displacement"] - reference).max() < 1e-14
    assert data["deformation_gradient"].shape == (len(state.points), 9)
    assert data["cauchy_stress"].shape == (len(state.points), 9)
    stress = data["cauchy_stress"].reshape(-1, 3, 3)
    assert abs(stress - stress.transpose(0, 2, 1)).max() <= 1e-9 * max(abs(stress).max(), 1.0)
assert 0.0 < abs(states[-1].point_data["displacement_error"]).max() < 0.05
assert abs(states[0].point_data["displacement_error"]).max() == 0.0
print(len(states), "states of", len(reference), "particles")
