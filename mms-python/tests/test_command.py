"""The command in the wheel: the bytes and the exit codes of the program."""

import os
import signal
import subprocess
import sys

import pytest

WHEEL = [sys.executable, "-m", "manufactured"]

CAMPAIGN = """
[solver]
run = ["{python}", "-c", "import shutil, sys; shutil.copy(sys.argv[1], sys.argv[2])", "{{state}}", "{{output}}/end.csv"]
output = "{{output}}/*.csv"
state = "csv"

[[study]]
field = "bar_1d"
cells = [4, 8]
order = 2
"""


@pytest.fixture(scope="module")
def program():
    if "MMS" not in os.environ:
        pytest.skip("MMS is not set to the path of the command")
    return [os.environ["MMS"]]


def ran(words, folder):
    done = subprocess.run(words, capture_output=True, cwd=folder)
    return done.returncode, done.stdout, done.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ["list"],
        ["--help"],
        ["eval", "bar_1d", "--at", "0.25", "--time", "0.01", "--quantity", "all", "--json"],
        ["check", "nothing.toml"],
        ["judge", "bar_1d", "\udcff.csv"],
        ["show", "bar_1d", "--nonsense"],
    ],
    ids=lambda it: it[0],
)
def test_it_prints_what_the_program_prints(program, arguments, tmp_path):
    assert ran([*WHEEL, *arguments], tmp_path) == ran([*program, *arguments], tmp_path)


def test_a_campaign_starts_its_supervisor(tmp_path):
    (tmp_path / "mine.toml").write_text(CAMPAIGN.format(python=sys.executable))
    code, out, err = ran([*WHEEL, "campaign", "mine.toml"], tmp_path)
    # Its results are the state at the start: the runs end, and the study does not pass.
    assert code == 1, err.decode()
    assert b"bar_1d" in out


@pytest.mark.skipif(sys.platform == "win32", reason="signals are sent as Unix has them")
def test_an_interrupt_ends_it_as_it_ends_the_program(program, tmp_path):
    def ended(words):
        process = subprocess.Popen(
            [*words, "study", "bar_1d", "--cells", "8192,16384"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=tmp_path
        )
        line = process.stderr.readline()
        assert b"time steps" in line, line
        process.send_signal(signal.SIGINT)
        process.communicate()
        return process.returncode

    assert ended(WHEEL) == ended(program) == -signal.SIGINT
