"""The command `mms`, which is in the extension module: the script `mms`, and `python -m manufactured`."""

import signal
import sys

from . import _native


def main() -> int:
    """Runs `mms` with the arguments of this process, and returns its exit code. Signals end it as they end any program."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.command(_native.__file__, [sys.executable, "-m", "manufactured"], sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
