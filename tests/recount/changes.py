"""Changes values of reports, to find out whether a check notices that."""

import contextlib

from comparison import Comparison


def leaves(value, path=()):
    """Paths of all values that are neither objects nor lists."""
    if not isinstance(value, (dict, list)):
        yield path, value
        return
    for key, each in value.items() if isinstance(value, dict) else enumerate(value):
        yield from leaves(each, (*path, key))


def pattern(path, names):
    """A path in which subjects, kinds, families and list indices are not distinguished."""
    return '.'.join('*' if isinstance(key, int) or key in names else key for key in path)


def changed(value):
    """Another value of the same type. Numbers change by more than the relative error with which
    reports give the largest ratios."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int):
        return value + 1
    if isinstance(value, float):
        return value * 1.01 if value else 0.5
    return 1.5 if value is None else value + 'x'


@contextlib.contextmanager
def put(json_value, path, value):
    """Puts a value at the path, and restores the old one afterwards."""
    for key in path[:-1]:
        json_value = json_value[key]
    before = json_value[path[-1]]
    json_value[path[-1]] = value
    try:
        yield
    finally:
        json_value[path[-1]] = before


class Found(Exception):
    """Raised at a difference."""


class UntilFound(Comparison):
    """A comparison that ends a check at the first difference."""

    def _note(self, sort, where, found, expected, same):
        if not same:
            raise Found


def found(check):
    """Whether a check, which gets a comparison, finds a difference."""
    try:
        check(UntilFound())
    except Found:
        return True
    return False
