"""The class of a single query, by the rules of fuzz/families/README.md, computed in fractions.
The oracle decides the queries, and gives their earliest times."""

import math
import sys
from fractions import Fraction

from asking import VERTICES, with_separation

# Two vertices have no edges; there, the gap between them counts as one.
EDGES = {
    'vt': [(1, 2), (2, 3), (3, 1)],
    'ee': [(0, 1), (2, 3)],
    'vv': [(0, 1)],
    've': [(1, 2)],
}
GAPS = {'vt': [(0, 1), (0, 2), (0, 3)], 'ee': [(0, 2), (0, 3), (1, 2), (1, 3)]}
NEARLY = 1e-6  # as a part of the step, of the longest edge, or of h
VERY_NEARLY = Fraction(1, 10**12)  # the square of NEARLY
FAR = 1000  # ratio of sizes above which they differ too much
VERY_FAR = 10**8


def _minus(a, b):
    return [x - y for x, y in zip(a, b)]


def _dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def _determinant(a, b, c):
    (bx, by, bz), (cx, cy, cz) = b, c
    return _dot(a, [by * cz - bz * cy, bz * cx - bx * cz, bx * cy - by * cx])


def _size(vector):
    return max(abs(x) for x in vector)


class _Moving:
    """A query: its vertices in fractions, and its volume F."""

    def __init__(self, kind, numbers):
        self.kind = kind
        count = VERTICES[kind]
        self.numbers = numbers[: 6 * count]
        self.h = (*numbers, 0.0)[6 * count]
        points = [[Fraction(x) for x in self.numbers[i : i + 3]] for i in range(0, 6 * count, 3)]
        self.start, self.end = points[:count], points[count:]
        self.speed = [_minus(end, start) for start, end in zip(self.start, self.end)]
        edges = [_size(_minus(x[a], x[b])) for x in (self.start, self.end) for a, b in EDGES[kind]]
        self.longest = max(edges)
        self.shortest = min((each for each in edges if each), default=0)

    def at(self, t):
        return [[p + t * v for p, v in zip(*pair)] for pair in zip(self.start, self.speed)]

    def volume(self, x):
        return _determinant(*(_minus(x[i], x[0]) for i in (1, 2, 3)))

    def squares(self, x):
        """The squares of three lengths whose product bounds F: of the first primitive, of the
        second, and between them."""

        def sum_of(pairs):
            return [_dot(_minus(x[a], x[b]), _minus(x[a], x[b])) for a, b in pairs]

        gaps, edges = sum_of(GAPS[self.kind]), sum_of(EDGES[self.kind])
        mean = sum(edges) / len(edges)
        first, second = edges if self.kind == 'ee' else (mean, mean)
        return first, second, sum(gaps) / len(gaps)


def _is_extreme(query):
    largest = max(abs(x) for x in query.numbers)
    if largest != 0 and not 1e-30 <= largest <= 1e30:
        return True
    longest = query.longest
    if longest == 0:
        return False
    fastest = max(_size(v) for v in query.speed)
    return (
        longest > VERY_FAR * query.shortest
        or fastest > FAR * longest
        or Fraction(largest) > VERY_FAR * longest
    )


def _is_flat_at_an_end(query):
    if query.longest == 0 or query.start == query.end:
        return True
    if query.kind not in GAPS:
        return False
    for x in query.start, query.end:
        first, second, gap = query.squares(x)
        if query.volume(x) ** 2 <= VERY_NEARLY * first * second * gap:
            return True
    return False


def _is_near_segment(p, a, b, squared):
    along = _minus(b, a)
    length = _dot(along, along)
    weight = min(max(_dot(_minus(p, a), along) / length, 0), 1) if length else 0
    off = [x - y - weight * z for x, y, z in zip(p, a, along)]
    return _dot(off, off) <= squared


def _root(query, lo, hi):
    """A time near the root of F that lies in an enclosure of the earliest time."""
    lo, hi = Fraction(lo), Fraction(hi)
    at_0, at_1, at_2, at_3 = (query.volume(query.at(t)) for t in range(4))
    first, second, third = at_1 - at_0, at_2 - 2 * at_1 + at_0, at_3 - 3 * at_2 + 3 * at_1 - at_0

    def volume(t):
        return at_0 + t * (first + (t - 1) / 2 * (second + (t - 2) / 3 * third))

    left = volume(lo)
    if left == 0 or lo == hi:
        return lo
    if left * volume(hi) > 0:
        return (lo + hi) / 2
    for _ in range(100):
        middle = (lo + hi) / 2
        if volume(middle) * left > 0:
            lo = middle
        else:
            hi = middle
    return (lo + hi) / 2


def _is_special_contact(query, lo, hi):
    """Whether contact is at an end of the step, on a border, or at a multiple root."""
    if hi <= NEARLY or lo >= 1 - NEARLY:
        return True
    if query.h > 0 or query.kind not in GAPS:
        return not query.h > 0
    x = query.at(_root(query, lo, hi))
    squared = Fraction(NEARLY * float(query.longest)) ** 2
    if query.kind == 'vt':
        borders = [(0, a, b) for a, b in EDGES['vt']]
    else:
        borders = [(0, 2, 3), (1, 2, 3), (2, 0, 1), (3, 0, 1)]
    if any(_is_near_segment(x[p], x[a], x[b], squared) for p, a, b in borders):
        return True
    spans, rates = ([_minus(of[i], of[0]) for i in (1, 2, 3)] for of in (x, query.speed))
    slope = sum(
        _determinant(*(rates[j] if j == i else spans[j] for j in range(3))) for i in range(3)
    )
    first, second, gap = query.squares(x)
    rate_first, rate_second, rate_gap = query.squares(query.speed)
    bound = rate_first * second * gap + first * rate_second * gap + first * second * rate_gap
    return slope**2 <= VERY_NEARLY * bound


def _numbers(line):
    return [float.fromhex(x) if 'x' in x else float(x) for x in line.split()]


def query_classes(nearmiss, kind, lines):
    """The classes of queries, which are given as lines."""
    queries = {line: _Moving(kind, _numbers(line)) for line in lines}
    classes = {line: 'extreme' for line, query in queries.items() if _is_extreme(query)}
    for line, query in queries.items():
        if line not in classes and (
            _is_flat_at_an_end(query) or query.longest > FAR * query.shortest
        ):
            classes[line] = 'degenerate'
    left = [line for line in queries if line not in classes]
    nearer, farther = [], []
    for line in left:
        query = queries[line]
        change = NEARLY * (query.h or float(query.longest))
        nearer.append(with_separation(kind, line, max(query.h - change, 0.0)))
        farther.append(with_separation(kind, line, min(query.h + change, sys.float_info.max)))
    is_nearer = dict(zip(left, nearmiss.collisions(kind, nearer)))
    is_farther = dict(zip(left, nearmiss.within(kind, farther)))
    met = [line for line in left if is_nearer[line]]
    times = dict(zip(met, zip(*nearmiss.times(kind, met)))) if met else {}
    for line in left:
        is_special = (
            _is_special_contact(queries[line], *times[line])
            if is_nearer[line]
            else is_farther[line]
        )
        classes[line] = 'degenerate' if is_special else 'ordinary'
    return [classes[line] for line in lines]


def exoticness(of, kind, numbers):
    """The rank of a query when failures are sorted."""
    count = VERTICES[kind]
    points = [tuple(numbers[i : i + 3]) for i in range(0, 6 * count, 3)]
    coincide = len(set(points[:count])) < count or len(set(points[count:])) < count
    if of == 'degenerate':
        return 3 if len(set(points)) == 1 else 1 + coincide
    return {'ordinary': 0, 'extreme': 4 + coincide, 'unclassified': 6}[of]


def complexity(kind, numbers):
    """How simple a query is. The simpler of two queries has the smaller tuple."""
    paths = 3 * VERTICES[kind]
    start, end, h = numbers[:paths], numbers[paths : 2 * paths], (*numbers, 0)[2 * paths]
    magnitudes = {abs(x) for x in numbers if x}

    def awkward(m):
        if m < 10 and m == int(m):
            return 0
        return 1 if m < 100 and 4 * m == int(4 * m) else 2

    def bits(m):
        odd = Fraction(m).numerator
        return (odd // (odd & -odd)).bit_length()

    return (
        sum(map(awkward, magnitudes)),
        sum((a != 0) + (b not in (0, a)) for a, b in zip(start, end)) + (h != 0),
        sum(a != b for a, b in zip(start, end)),
        len(magnitudes),
        sum(map(bits, magnitudes)),
        sum(abs(math.frexp(m)[1] - 1) for m in magnitudes),
        sum(math.copysign(1, x) < 0 for x in numbers[: 2 * paths]),
    )
