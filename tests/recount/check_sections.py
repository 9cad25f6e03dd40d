"""Checks error against time and the ladder of precisions in report.json."""

import math

import numpy as np
from scipy import stats

from asking import KINDS
from check_counts import check_rates
from check_numbers import ROUNDING, SOLVED, quantile
from comparison import Near, Within
from enclosed import BORDERS
from scalars import ALGORITHMS, EPSILONS, exponent, paper_bound, place
from tally import ON_REQUEST, Tally, failures_of

TIME = 'ns_per_query'  # the field with the run time, by which a front compares subjects
MESHES = KINDS[:2]  # the kinds whose bounds are multiples of B
COARSEST, FINEST = -23, -127  # range of binary exponents of epsilon in a fit


def check_borders(comparison, where, report):
    """Checks the histogram's lower borders."""
    expected = {'histogram_borders': tuple(Near(border, ROUNDING) for border in (0.0, *BORDERS))}
    comparison.entries('histogram borders', where, report, expected)


def places(subject):
    """The expected algorithm, scalar and epsilon of a subject."""
    algorithm, scalar, power = place(subject)
    return {'algorithm': algorithm, 'scalar': scalar, 'epsilon': 2.0**power}


def slack(subject):
    """The relative error of a claim that comes from rounding B in the subject's scalar."""
    return 65 * 2.0 ** place(subject)[2] + ROUNDING


def check_trade_offs(comparison, where, found, answers, units):
    """Checks error against run time: sums over the kinds and families that all subjects were
    asked, and their Pareto fronts."""
    comparison.same('names', where, sorted(found['subjects']), answers.subjects)
    kinds_of = [set(answers.kinds(subject)) for subject in answers.subjects]
    shared = tuple(kind for kind in KINDS if all(kind in kinds for kinds in kinds_of))
    for subject, each in found['subjects'].items():
        tally = Tally.of(answers, subject, shared)
        check_rates(comparison, f'{where} {subject}', each, tally)
        largest, unit = each['max_fp_distance_over_bound'], units.of_distances(subject)
        errors, most = tally.times.errors, each['max_time_error']
        expected = {
            **places(subject),
            'max_time_error': Within(*errors.most()),
            'median_time_error': quantile(errors, 0.5, most),
            'q99_time_error': quantile(errors, 0.99, most),
            'sound': not set(failures_of(each, {})) - ON_REQUEST,
            'farthest_over_B': Near(
                unit and largest * unit if tally.false_positives else 0, slack(subject)
            ),
        }
        comparison.entries('trade-offs', f'{where} {subject}', each, expected)
    _check_fronts(comparison, where, found)
    scalars = {}
    for subject in answers.subjects:
        algorithm, scalar, _ = place(subject)
        scalars.setdefault(algorithm, set()).add(scalar)
    comparison.same('fronts', 'by scalars', 'ladder' in found, max(map(len, scalars.values())) > 2)


def _check_fronts(comparison, where, found):
    """Checks the Pareto fronts. The expected fronts use the report's own run times."""
    sound = {name: each for name, each in found['subjects'].items() if each['sound']}
    bounds = {
        name: {TIME: each[TIME], 'earliness': each['q99_early'][1]}
        for name, each in sound.items()
        if each['time_sort'] == 'lower-bound'
    }
    expected = {
        'front_by_distance': front(sound, 'max_fp_distance_over_bound'),
        'front_by_rate': front(sound, 'false_positive_rate'),
        'front_by_earliness': front(bounds, 'earliness'),
    }
    comparison.entries('fronts', where, found, expected)
    if 'ladder' in found:
        known = {name: each for name, each in sound.items() if each['farthest_over_B'] is not None}
        expected = {
            'front_by_distance': front(known, 'farthest_over_B'),
            'paper_bound': Near(paper_bound(2.0 ** EPSILONS['double']), SOLVED),
        }
        comparison.entries('fronts', f'{where} ladder', found['ladder'], expected)


def front(subjects, error):
    """The names on the front, fastest first. A subject is on the front if every other one is
    slower or has a larger error.

    If several subjects have equal times and errors, only the first name is on the front."""
    chosen = [
        name
        for name in subjects
        if not any(_beats(other, name, subjects, error) for other in subjects)
    ]
    return sorted(chosen, key=lambda name: subjects[name][TIME])


def _beats(other, name, subjects, error):
    """Whether the other subject keeps this one off the front."""
    costs, own = ((subjects[each][TIME], subjects[each][error]) for each in (other, name))
    if costs == own:
        return other < name
    return costs[0] <= own[0] and costs[1] <= own[1]


def check_ladder(comparison, where, report, answers, units):
    """Checks the ladder of precisions: a rung for each subject on it, and the fits."""
    rungs = [
        (subject, *place(subject))
        for subject in answers.subjects
        if place(subject)[0] in ALGORITHMS
    ]
    rungs.sort(key=lambda rung: -rung[3])
    is_ladder = any(
        len({power for _, own, _, power in rungs if own == algorithm}) > 1
        for algorithm in ALGORITHMS
    )
    comparison.same('ladder', f'{where} is there', 'ladder' in report, is_ladder)
    if not is_ladder or 'ladder' not in report:
        return
    found = report['ladder']
    names = [rung['subject'] for rung in found['rungs']]
    comparison.same('names', where, names, [rung[0] for rung in rungs])
    for rung in found['rungs']:
        subject = rung['subject']
        check_rates(comparison, f'{where} {subject}', rung, Tally.of(answers, subject, MESHES))
        farthest = rung['claimed'] * rung['max_fp_distance_over_bound']
        expected = {
            **places(subject),
            'claimed': Near(units.claimed(subject), slack(subject)),
            'farthest': Near(farthest, ROUNDING),
        }
        comparison.entries('ladder', f'{where} {subject}', rung, expected)
    lines = fits(report)
    comparison.same('fits', f'{where} number of fits', len(found['fits']), len(lines))
    for fit, line in zip(found['fits'], lines):
        own = f'{where} {fit["algorithm"]} {fit["origin"]}'
        comparison.entries('fits', own, fit, line)


def fits(report):
    """The expected fits, in which each algorithm's farthest distance is a power of epsilon.

    A fit is over all families ("") or over one. The fits use the report's largest ratios, which
    other modules check."""
    lines = []
    families = sorted(
        {
            name
            for each in report['subjects'].values()
            for kind in MESHES
            for name in each[kind]['families']
        }
    )
    for algorithm in ALGORITHMS:
        for origin in ['', *families]:
            points = _points(report, algorithm, origin)
            precisions = len({x for x, _, _ in points})
            if precisions < 3:
                continue
            x, y, part = np.array(points).T
            line = stats.linregress(x, y)
            half_width = line.stderr * stats.t.ppf(0.975, len(points) - 2)
            lines.append(
                {
                    'algorithm': algorithm,
                    'origin': origin,
                    'points': len(points),
                    'precisions': precisions,
                    'exponent': Within(line.slope - SOLVED, line.slope + SOLVED),
                    'standard_error': Within(line.stderr - SOLVED, line.stderr + SOLVED),
                    'half_width_95': Near(half_width, SOLVED),
                    'least_part_of_claimed': Near(part.min(), SOLVED),
                    'greatest_part_of_claimed': Near(part.max(), SOLVED),
                    'restates_the_bound': bool(part.min() > 0.9),
                }
            )
    return lines


def _points(report, algorithm, origin):
    """For each rung: the exponent of epsilon, the binary logarithm of the farthest distance in
    units of B, and the ratio of this distance to the claimed one."""
    points = []
    for rung in report['ladder']['rungs']:
        own = report['subjects'][rung['subject']]
        parts = [
            own[kind]['families'][origin] if origin else own[kind]
            for kind in MESHES
            if not origin or origin in own[kind]['families']
        ]
        part = max(part['max_fp_distance_over_bound'] for part in parts)
        farthest = rung['claimed'] * part
        power = exponent('' if rung['scalar'] == 'double' else rung['scalar'])
        if rung['algorithm'] == algorithm and FINEST <= power <= COARSEST and part >= BORDERS[0]:
            points.append((power, math.log2(farthest), part))
    return points
