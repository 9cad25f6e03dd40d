"""A line on stderr that shows how far a trial is."""

import sys
import time
from typing import Any, Optional


class Progress:
    """The line of one trial, from its beginning to its end."""

    def __init__(self, cases: int, is_wanted: Optional[bool]) -> None:
        """If is_wanted is None, shows the line only in a terminal and in a notebook."""
        self.is_shown = is_interactive() if is_wanted is None else is_wanted
        self._cases = cases
        self._start = time.monotonic()
        self._shown = self._start  # when the line was shown last
        self._width = 0

    def show(self, cases: int, missed: int) -> None:
        """Shows the line, but not more often than four times a second."""
        now = time.monotonic()
        if now - self._shown < 0.25:
            return
        self._shown = now
        left = (now - self._start) * (self._cases - cases) / max(cases, 1)
        self._write(f'{left:.0f} s left, {cases:,} of {self._cases:,} cases, {missed:,} missed')

    def _write(self, text: str) -> None:
        sys.stderr.write('\r' + text.ljust(self._width))
        sys.stderr.flush()
        self._width = len(text)

    def __enter__(self) -> 'Progress':
        return self

    def __exit__(self, *of_exception: Any) -> None:
        if self._width > 0:
            self._write('')
            sys.stderr.write('\r')
            sys.stderr.flush()


def is_interactive() -> bool:
    """Whether somebody reads stderr, because it is a terminal or the output of a notebook's cell."""
    is_terminal = getattr(sys.stderr, 'isatty', lambda: False)()
    return bool(is_terminal) or type(sys.stderr).__module__.startswith('ipykernel.')
