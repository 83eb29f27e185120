"""How far long work is, printed where somebody watches."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Iterator
from typing import Union

#: Takes each line that says how far work is; True prints the lines, and None does on a terminal and in a notebook.
Progress = Union[bool, Callable[[str], object], None]


class _Printed:
    """Prints how far work is on one line of stderr, once it has taken a second."""

    def __init__(self) -> None:
        self.start, self.width = time.monotonic(), 0

    def __call__(self, line: str) -> None:
        if time.monotonic() - self.start > 1:
            sys.stderr.write("\r" + line.ljust(self.width))
            sys.stderr.flush()
            self.width = len(line)

    def end(self) -> None:
        """Clears the line."""
        if self.width:
            sys.stderr.write("\r" + " " * self.width + "\r")
            sys.stderr.flush()


@contextlib.contextmanager
def followed(progress: Progress) -> Iterator[Callable[[str], object] | None]:
    """The function that takes lines of work, or None if nobody watches."""
    if callable(progress):
        yield progress
        return
    is_seen = progress is None and (sys.stderr.isatty() or "ipykernel" in sys.modules)
    printed = _Printed() if progress or is_seen else None
    try:
        yield printed
    finally:
        if printed:
            printed.end()
