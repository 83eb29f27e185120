"""The common parts of the tests: the command, and fields that are opened once."""

import functools
import os
import subprocess

import numpy as np
import pytest

import manufactured as mf

# The time of a field: what part of its window has passed.
PART = 0.375


@functools.cache
def opened(name):
    return mf.field(name)


def time_of(field):
    """A time inside the window, which is a number of single precision too; None of a static field."""
    if field.window is None:
        return None
    first, last = field.window
    return float(np.float32(first + PART * (last - first)))


@pytest.fixture(scope="session")
def mms():
    """Runs the command, whose path is in the variable MMS, and returns what it prints."""
    command = os.environ.get("MMS")
    if command is None:
        pytest.skip("MMS is not set to the path of the command")

    def run(*arguments, code=0):
        ran = subprocess.run([command, *arguments], capture_output=True, text=True)
        assert ran.returncode == code, ran.stderr
        return ran.stdout

    return run
