"""Numbers that are known only as enclosures, and histograms of such numbers."""

import functools
from dataclasses import dataclass

import numpy as np

# The borders of a histogram's bins, four to a decade from 10^-16 to 10^1. The first bin lies below
# all borders, and the last bin lies above them.
BORDERS = np.array([10.0 ** (-16 + i / 4) for i in range(17 * 4 + 1)])
BINS = len(BORDERS) + 1
KEPT = 5  # number of extreme cases that a report keeps
PRECISION = 1.01e-3  # relative error by which a reported number may exceed the true one
LARGEST = np.finfo(float).max


@dataclass
class Enclosed:
    """Numbers, each between a lower end in `lo` and an upper end in `hi`."""

    lo: np.ndarray
    hi: np.ndarray

    def __len__(self):
        return len(self.lo)

    def __getitem__(self, some):
        return Enclosed(self.lo[some], self.hi[some])

    @classmethod
    def joined(cls, parts):
        """Joins the numbers of several Enclosed."""
        return cls(
            *(np.concatenate([getattr(part, end) for part in parts]) for end in ('lo', 'hi'))
        )

    @functools.cached_property
    def bins(self):
        """The bins of the numbers' lower ends, and the bins of their upper ends."""
        return [np.searchsorted(BORDERS, end, side='right') for end in (self.lo, self.hi)]

    @functools.cached_property
    def histogram(self):
        """How many numbers are certainly in each bin, and how many may be in each bin."""
        first, last = self.bins
        least = np.bincount(first[first == last], minlength=BINS)
        most = least.copy()
        for lowest, highest in zip(first[first != last], last[first != last]):
            most[lowest : highest + 1] += 1
        return least, most

    def largest(self):
        """The ranges in which a report may give the KEPT largest numbers, the largest number
        first."""
        lo, hi = (np.sort(end)[::-1][:KEPT] for end in (self.lo, self.hi))
        return [reported(*ends) for ends in zip(lo, hi)]

    def most(self):
        """The range in which a report may give the largest number; (0, 0) if there are no
        numbers."""
        return self.largest()[0] if len(self) else (0, 0)

    def reported(self, place):
        """The range in which a report may give the number at an index."""
        return reported(self.lo[place], self.hi[place])

    def quantile_bins(self, part):
        """The first and the last bin in which a quantile may be, or None if there are no numbers.
        The quantile is the smallest number such that at least a fraction `part` of all numbers is
        not larger than it."""
        if len(self) == 0:
            return None
        place = max(int(np.ceil(part * len(self))), 1) - 1
        return tuple(int(np.sort(bins)[place]) for bins in self.bins)


def reported(lo, hi):
    """The range in which a report may give a number between lo and hi. Reports round numbers up.

    The largest double stands for infinity. Instead of a number below all borders of bins, a report
    may give any number up to the lowest border."""
    most = BORDERS[0] if lo < BORDERS[0] else 0
    return min(lo, LARGEST), min(max(hi * (1 + PRECISION), most), LARGEST)
