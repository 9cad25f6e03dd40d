"""Compares values, and collects differences."""

import math
from dataclasses import dataclass, field


@dataclass
class Near:
    """Expects the number `value` up to a relative error, or None if `value` is None."""

    value: float
    relative: float


@dataclass
class Within:
    """Expects a number in a range."""

    least: float
    most: float


@dataclass
class Comparison:
    """Counts how many values each sort of check compares, and keeps a line for each difference."""

    compared: dict = field(default_factory=dict)
    differences: list = field(default_factory=list)
    either_way: dict = field(default_factory=dict)

    def _note(self, sort, where, found, expected, same):
        self.compared[sort] = self.compared.get(sort, 0) + 1
        if not same:
            self.differences.append(f'{sort}: {where}: found {found}, expected {expected}')

    def same(self, sort, where, found, expected):
        """`found` must equal `expected`."""
        self._note(sort, where, found, expected, found == expected)

    def near(self, sort, where, found, expected, relative):
        """`found` must be the expected number up to a relative error, or None if None is
        expected."""
        if found is None or expected is None:
            return self.same(sort, where, found, expected)
        is_near = _is_number(found) and math.isclose(found, expected, rel_tol=relative)
        self._note(sort, where, found, expected, is_near)

    def within(self, sort, where, found, least, most):
        """`found` must be a number from `least` to `most`."""
        is_within = _is_number(found) and least <= found <= most
        self._note(
            sort, where, found, str(least) if least == most else f'{least} to {most}', is_within
        )

    def entries(self, sort, where, found, expected):
        """`found` must have the keys of `expected`. Its values must equal the expected ones, or
        must satisfy the Near or Within that is expected. `found` may have more keys."""
        for key, value in expected.items():
            self._entry(sort, f'{where} {key}', found[key], value)

    def _entry(self, sort, where, found, expected):
        if isinstance(expected, Near):
            self.near(sort, where, found, expected.value, expected.relative)
        elif isinstance(expected, Within):
            self.within(sort, where, found, expected.least, expected.most)
        elif isinstance(expected, tuple):
            self.same(sort, f'{where} number', len(found), len(expected))
            for own, value in zip(found, expected):
                self._entry(sort, where, own, value)
        else:
            self.same(sort, where, found, expected)

    def fail(self, sort, where, found, expected):
        """Adds a difference for a value that cannot be compared."""
        self._note(sort, where, found, expected, False)

    def agree(self, sort, count):
        """Counts values that agree with the expected ones."""
        self.compared[sort] = self.compared.get(sort, 0) + count

    def section(self, check, where, *arguments):
        """Runs a check. A missing entry, or an entry of a wrong type, counts as a difference."""
        try:
            check(self, where, *arguments)
        except (AttributeError, LookupError, TypeError, ValueError) as error:
            self.fail('structure', where, repr(error), 'something to read')

    def allow(self, what, count=1):
        """Counts values for which two results are allowed, because an enclosure contains a border."""
        self.either_way[what] = self.either_way.get(what, 0) + count

    def print(self):
        """Prints a line for each sort of check, for each sort of ambiguous value, and for each
        difference."""
        for sort, count in self.compared.items():
            wrong = sum(line.startswith(f'{sort}: ') for line in self.differences)
            print(f'{sort}: {count:,} values compared, {wrong:,} different')
        for what, count in self.either_way.items():
            print(f'either way: {count:,} {what}')
        for line in self.differences:
            print(f'DIFFERENCE {line}')


def _is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)
