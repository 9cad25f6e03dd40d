"""Check certificates of continuous collision detection (CCD) in exact arithmetic.

The primitives A and B of a query are convex hulls of vertices. A vertex is at (1 - t) s + t e; x
lists s of all vertices, then e of all vertices. For h >= 0, a certificate proves one claim:
  apart: their distance is > h ("strict": false: >= h) at all t in [from, to] ("open": [from, to))
  meets: their distance is <= h ("strict": true: < h) at some t in [from, to].
The functions apart, at, bracket and edge say why their tests suffice. On [p, q], a polynomial f of
degree n has a form, a polynomial in u and v: f((p u + q v) / (u + v)) times (u + v)^n. For each t
in [p, q], t = p u + q v with some u, v >= 0 and u + v = 1. So f > 0 on [p, q] if all coefficients
of the form are > 0, and f > 0 on [p, q) if the first is > 0 and the others are >= 0. The first
coefficient is f(p), the last f(q). Positive factors, as in whole(), change no sign.
Compare the Statement with your question: a line may prove something other than you asked."""

import re
import sys
from collections import namedtuple
from fractions import Fraction
from functools import reduce
from itertools import chain, permutations, product, zip_longest
from json import JSONDecoder
from math import lcm

KINDS = {'vv': 'AB', 've': 'ABB', 'vt': 'ABBB', 'ee': 'AABB'}  # the primitive of each vertex
AREAS = {'vt': ('023', '031', '012'), 'ee': ('023', '132', '021', '013')}  # triangles in bracket()
NUMBER = r'(-?)(\d+)(?:/0*([1-9]\d*))?|(-?0x[01])(?:\.([\da-f]+))?p([+-]?)(\d{1,4})'
# integer() converts 600 digits at a time, because the limit of int() may be as low as 640 digits.
integer = lambda s: reduce(lambda n, d: n * 10 ** len(d) + int(d), re.findall('.{1,600}', s), 0)
is_double = lambda v: abs(v) < 2**1024 - 2**970 and Fraction(float(v)) == v
# Reads an object as a tuple of pairs, and any unquoted number as its text's length. Refuses NaN.
JSON = JSONDecoder(object_pairs_hook=tuple, parse_int=len, parse_float=len, parse_constant=int)
Statement = namedtuple('Statement', 'kind x h claim from_ to open strict')


class Refused(Exception):
    """The line proves nothing; the message says why."""


def require(truth, reason):
    if not truth:
        raise Refused(reason)


def read(line):
    require(len(line) <= 1 << 19, 'unreadable: more than 512 KiB')
    require(line.isascii() and '\\' not in line, 'unreadable: a backslash, or not ASCII')
    try:
        pairs = JSON.decode(line)
    except (RecursionError, ValueError) as e:
        raise Refused(f'unreadable: {type(e).__name__}') from None
    require(isinstance(pairs, tuple), 'unreadable: not an object')
    require(len(dict(pairs)) == len(pairs), 'a key comes twice')
    return dict(pairs)


def numbers(value, *lengths):
    """Return the number in a string or, if lengths are given, the numbers in nested arrays."""
    if lengths:
        require(isinstance(value, list) and len(value) in lengths[0], 'an array has a bad length')
        return [numbers(item, *lengths[1:]) for item in value]
    match = isinstance(value, str) and len(value) <= 10000 and re.fullmatch(NUMBER, value, re.A)
    require(match, 'a number is malformed, too long or not a string')
    minus, p, q, lead, digits, sign, power = match.groups('')
    if p:
        return Fraction(int(minus + '1') * integer(p), integer(q or '1'))
    value = int(lead + digits, 16) * Fraction(2) ** (int(sign + power) - 4 * len(digits))
    require(int(power) <= 1074 and is_double(value), 'a hexadecimal number is not a double')
    return value


def whole(values):
    common = lcm(*(value.denominator for value in values))
    return [value.numerator * (common // value.denominator) for value in values]


class Row(tuple):
    """A form, as the coefficients of u^n, u^(n-1) v, ..., v^n; or a vector of three forms."""

    __add__ = lambda a, b: Row(i + j for i, j in zip(a, b))
    __sub__ = lambda a, b: Row(i - j for i, j in zip(a, b))
    dot = lambda a, b: a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
    cross = lambda a, b: Row(a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3))
    positive = lambda a, opens=False: a[0] > 0 and min(a) >= 0 if opens else min(a) > 0

    def __mul__(a, b):
        result = [0] * (len(a) + len(b) - 1)
        for (i, c), (j, d) in product(enumerate(a), enumerate(b)):
            result[i + j] += c * d
        return Row(result)


def forms(vectors, p, q):
    """Replace each polynomial [c0, c1, ...] in the vectors by its form on [p, q]."""
    one, p, q = whole([1, p, q])
    bases = [[Row([1])]]  # bases[n][k] is t^k as a form of degree n
    for _ in range(4):
        bases.append([f * Row([one, one]) for f in bases[-1]] + [bases[-1][-1] * Row([p, q])])
    form = lambda f: Row(sum(c * b for c, b in zip(f, bs)) for bs in zip(*bases[len(f) - 1]))
    return [Row(map(form, vector)) for vector in vectors]


def apart(s, vectors, body):
    """On each piece, n . (a - b) > 0 and (n . (a - b))^2 > h^2 n . n for all vertices a of A and b
    of B. So |n| |a - b| >= n . (a - b) > h |n|, for all vertices, so for all points a and b."""
    times = numbers(body['times'], range(2, 20002))
    require(times[0] == s.from_ and times[-1] == s.to, '"times" does not span "from" to "to"')
    normals = numbers(body['normals'], [len(times) - 1], [3], range(1, 6))
    for i, (p, q, n) in enumerate(zip(times, times[1:], normals), 1):
        opens, a = s.open and i == len(normals), KINDS[s.kind].count('A')
        require(p < q or p == q and not opens, f'piece {i}: the times do not increase')
        n = whole([c for column in zip_longest(*n, fillvalue=0) for c in column])
        *x, h, n = forms([*vectors, (n[0::3], n[1::3], n[2::3])], p, q)
        square = h.dot(h) * n.dot(n)
        for along in [n.dot(a - b) for a, b in product(x[:a], x[a:])]:
            gap = along * along - square
            far = gap.positive(opens) if s.strict else min(gap) >= 0 < s.h
            require(along.positive(opens) and far, f'piece {i}: n does not separate A and B')


def at(s, vectors, body):
    """At one time, the points of A and B that the weights give are at most h apart."""
    t, a = numbers(body['at']), KINDS[s.kind].count('A')
    require(s.from_ <= t <= s.to, '"at" is not in ["from", "to"]')
    *x, h = forms(vectors, t, t)
    one, *w = whole([1, *numbers(body['weights'], [len(x)])])
    require(min(w) >= 0 and sum(w[:a]) == one == sum(w[a:]), 'not weights of two points')
    r = [sum(c * v[k][0] for c, v in zip(w[:a] + [-c for c in w[a:]], x)) for k in range(3)]
    excess = sum(c * c for c in r) - (one * h[0][0]) ** 2
    require(excess < 0 if s.strict else excess <= 0, 'the two points are too far apart')


def bracket(s, vectors, body):
    """At a time in [p, q], F = n . (x2 - x0) is zero, so all vertices are in one plane. At this
    time, the weights divided by n . n are positive: barycentric coordinates of a common point."""
    p, q = numbers(body['bracket'], [2])
    require(s.h == 0 and s.from_ <= p < q <= s.to, 'h is not 0, or not from <= p < q <= to')
    *x, h = forms(vectors, p, q)
    if 'edge' in body:
        return edge(KINDS[s.kind], x, body['edge'])
    require(s.kind in AREAS, 'only vt and ee have a bracket without an edge')
    area = lambda i, j, k: (x[j] - x[i]).cross(x[k] - x[i])
    n = area(1, 2, 3) if s.kind == 'vt' else (x[1] - x[0]).cross(x[3] - x[2])
    f = n.dot(x[2] - x[0])
    weights = [n.dot(n), *(n.dot(area(*map(int, corners))) for corners in AREAS[s.kind])]
    require(f[0] * f[-1] <= 0 and all(w.positive() for w in weights), 'no contact')


def edge(kind, x, names):
    """A component of (v - y) x (z - y) is zero at a time in [p, q]. The others are its multiples.
    So v is on the line through y and z. Two inner products show that v is between y and z."""
    edges = [e for e in permutations(range(len(x)), 3) if kind[e[0]] != kind[e[1]] == kind[e[2]]]
    require(names in [[*map(str, e)] for e in edges], '"edge" is not a vertex and an edge')
    v, y, z = (x[int(name)] for name in names)
    rows = (v - y).cross(z - y)
    zero = any(c[0] * c[2] < 0 and all(c.cross(d) == (0, 0, 0) for d in rows) for c in rows)
    require(zero and (v - y).dot(z - y).positive() and (z - v).dot(z - y).positive(), 'no contact')


def check(line):
    """Return the Statement that a line proves, or raise Refused."""
    body = read(line)
    claim, kind, why = body.get('claim', 0), body.get('kind'), body.get('why')
    require(claim is not None, f'no certificate: {ascii(why)[1:-1] if type(why) is str else 0}')
    require(claim in ('apart', 'meets') and kind in list(KINDS), 'unknown claim or kind')
    prove = apart if claim == 'apart' else at if 'at' in body else bracket
    own = {apart: 'times normals|open strict', at: 'at weights|strict', bracket: 'bracket|edge'}
    must, may = (set(k.split()) for k in f'kind x h claim from to {own[prove]} query'.split('|'))
    require(must <= {*body} <= must | may, 'a key is missing or does not belong here')
    other = body.get('open', False), body.get('strict', claim == 'apart'), body.get('query', '')
    require([*map(type, other)] == [bool, bool, str], '"open", "strict" or "query" has a bad type')
    values = [*numbers(body['x'], [6 * len(KINDS[kind])]), numbers(body['h'])]
    require(all(map(is_double, values)) and values[-1] >= 0, 'x or h is not a double, or h < 0')
    *x, h = map(float, values)
    s = Statement(kind, tuple(x), h, claim, numbers(body['from']), numbers(body['to']), *other[:2])
    require(0 <= s.from_ <= s.to <= 1, 'not 0 <= from <= to <= 1')
    *x, h = whole(values)
    lines = [(a, b - a) for a, b in zip(x, x[len(x) // 2 :])]
    prove(s, [*zip(lines[0::3], lines[1::3], lines[2::3]), ((h, 0), (0, 0), (0, 0))], body)
    return s


if __name__ == '__main__':
    names, verdicts = [a for a in sys.argv[1:] if a != '-q'] or ['-'], []
    if {'--help', '-h'} & {*names}:
        sys.exit(print('usage: check.py [-q] [FILE ...]  check certificates; "-" is stdin'))
    try:
        for name in names:
            with open(0 if name == '-' else name, encoding='latin-1', newline='\n') as file:
                take = lambda: file.readline((1 << 19) + 2)
                for i, line in enumerate(chain([take()], iter(take, '')), 1):
                    try:
                        verdicts.append(bool(check(line.rstrip('\n'))))
                    except Refused as error:
                        require(str(error)[:10] != 'unreadable', f'{name}:{i}: {error}')
                        told = f'{name}:{i}: refused: {error}'
                        verdicts.append('-q' not in sys.argv and print(told))
        print(f'accepted {verdicts.count(True)} of {len(verdicts)}')
        sys.stdout.close()
    except (OSError, Refused, ValueError, AttributeError) as error:
        sys.exit(print(f'check: {error}', file=sys.stderr) or 2)
    sys.exit(not all(verdicts))
