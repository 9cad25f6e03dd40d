"""Checks queries. Also checks quantiles and histograms of numbers that are known only as
enclosures."""

import numpy as np

from comparison import Within
from enclosed import BINS, BORDERS, LARGEST

ROUNDING = 1e-12  # relative error of a quotient of two counts
SOLVED = 1e-9  # relative error of an equation's solution, and of values computed from it


def quantile(enclosed, part, largest):
    """A report gives the two ends of the bin in which a quantile is. Returns the range in which
    the lower end must be, and the range in which the upper end must be. The upper end is the bin's
    upper border or the largest number, `largest`, whichever is less."""
    bins = enclosed.quantile_bins(part)
    first, last = bins or (0, 0)
    lower = np.concatenate(([0], BORDERS))
    upper = np.minimum(np.concatenate((BORDERS, [np.inf])), largest) if bins else [0]
    return tuple(Within(*outward(ends[first], ends[last])) for ends in (lower, upper))


def outward(least, most):
    """A range, widened by the rounding error of a bin's border."""
    return least * (1 - ROUNDING), most if most >= LARGEST else most * (1 + ROUNDING)


def check_histogram(comparison, where, found, enclosed):
    """Checks that each bin counts at least the numbers that are certainly in it, and at most
    those that may be in it."""
    least, most = enclosed.histogram
    comparison.same('histogram bins', f'{where} sum', sum(found), len(enclosed))
    if len(found) != BINS:
        return comparison.same('histogram bins', f'{where} number of bins', len(found), BINS)
    wrong = np.flatnonzero((least > found) | (most < found))
    comparison.agree('histogram bins', BINS - len(wrong))
    for i in wrong:
        comparison.within('histogram bins', f'{where} bin {i}', found[i], least[i], most[i])


def check_query(comparison, where, found, line):
    """Checks that `found`, a line or a list of numbers, is the query in `line`."""
    numbers = [float.fromhex(word) for word in found.split()] if isinstance(found, str) else found
    comparison.same('provenances', where, numbers, [float.fromhex(word) for word in line.split()])
