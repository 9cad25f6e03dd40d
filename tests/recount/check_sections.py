"""Checks the sections of report.json other than counters: error against time, ladder, findings."""

import math

import numpy as np
from scipy import stats

from asking import KINDS
from check_counts import check_false_positive, check_rates
from check_numbers import ROUNDING, SOLVED, check_query
from check_times import check_extreme_times, check_trade_off_times
from enclosed import BORDERS, reported
from scalars import ALGORITHMS, EPSILONS, exponent, paper_bound, place
from tally import Tally, failures_of

TIME = 'ns_per_query'  # the field with the time that a front compares
COARSEST, FINEST = -23, -127  # range of exponents of epsilon in a fit


def check_borders(comparison, where, found):
    """Checks the histogram's lower borders."""
    expected = [0.0, *BORDERS]
    comparison.same('histogram borders', f'{where} number', len(found), len(expected))
    for i, (border, value) in enumerate(zip(found, expected)):
        comparison.near('histogram borders', f'{where} {i}', border, value, ROUNDING)


def check_places(comparison, where, found, subject):
    """Checks the algorithm, scalar and epsilon of a subject."""
    algorithm, scalar, power = place(subject)
    comparison.same('names', f'{where} {subject} algorithm', found['algorithm'], algorithm)
    comparison.same('names', f'{where} {subject} scalar', found['scalar'], scalar)
    comparison.same('names', f'{where} {subject} epsilon', found['epsilon'], 2.0**power)


def slack(subject):
    """Relative error of a claim from the rounding of B in the subject's scalar."""
    return 65 * 2.0 ** place(subject)[2] + ROUNDING


def check_trade_offs(comparison, where, found, answers, units):
    """Checks error against run time: sums over kinds and families, and their Pareto fronts.

    The expected fronts use the report's own times."""
    comparison.same('names', where, sorted(found['subjects']), answers.subjects)
    for subject, each in found['subjects'].items():
        own = f'{where} {subject}'
        tally = Tally.of(answers, subject, KINDS)
        check_rates(comparison, own, each, tally)
        check_places(comparison, where, each, subject)
        check_trade_off_times(comparison, own, each, tally.times)
        sound = not set(failures_of(each, {})) - {'unknown'}
        comparison.same('fronts', f'{own} sound', each['sound'], sound)
        unit = units.of_distances(subject)
        in_B = (
            0 if tally.false_positives == 0 else unit and each['max_fp_distance_over_bound'] * unit
        )
        comparison.near(
            'ladder', f'{own} in units of B', each['farthest_over_B'], in_B, slack(subject)
        )
    sound = {name: each for name, each in found['subjects'].items() if each['sound']}
    for name, error in (
        ('distance', 'max_fp_distance_over_bound'),
        ('rate', 'false_positive_rate'),
    ):
        comparison.same('fronts', f'by {name}', found[f'front_by_{name}'], front(sound, error))
    bounds = {
        name: {TIME: each[TIME], 'earliness': each['q99_early'][1]}
        for name, each in sound.items()
        if each['time_sort'] == 'lower-bound'
    }
    expected = front(bounds, 'earliness')
    comparison.same('fronts', 'by earliness', found['front_by_earliness'], expected)
    if 'ladder' in found:
        known = {name: each for name, each in sound.items() if each['farthest_over_B'] is not None}
        comparison.same(
            'fronts',
            'in units of B',
            found['ladder']['front_by_distance'],
            front(known, 'farthest_over_B'),
        )
        paper = paper_bound(2.0 ** EPSILONS['double'])
        comparison.near(
            'ladder', "the paper's bound", found['ladder']['paper_bound'], paper, SOLVED
        )
    scalars = {}
    for subject in answers.subjects:
        algorithm, scalar, _ = place(subject)
        scalars.setdefault(algorithm, set()).add(scalar)
    comparison.same('fronts', 'by scalars', 'ladder' in found, max(map(len, scalars.values())) > 2)


def front(subjects, error):
    """The names on the front, fastest first: no other subject is at least as fast with at most the
    same error.

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
    """Checks the ladder of precisions: a rung for each subject of its algorithms, and the fits."""
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
        _check_rung(comparison, where, rung, answers, units)
    _check_fits(comparison, where, found['fits'], fits(report))


def _check_rung(comparison, where, rung, answers, units):
    subject = rung['subject']
    own = f'{where} {subject}'
    check_places(comparison, where, rung, subject)
    check_rates(comparison, own, rung, Tally.of(answers, subject, KINDS))
    claimed = units.claimed(subject)
    comparison.near('ladder', f'{own} claimed', rung['claimed'], claimed, slack(subject))
    farthest = rung['claimed'] * rung['max_fp_distance_over_bound']
    comparison.near('ladder', f'{own} farthest', rung['farthest'], farthest, ROUNDING)


def _check_fits(comparison, where, found, expected):
    names = [
        [(fit['algorithm'], fit['origin']) for fit in fits_of] for fits_of in (found, expected)
    ]
    comparison.same('names', f'{where} fits', *names)
    for fit, line in zip(found, expected):
        own = f'{where} {fit["algorithm"]} {fit["origin"]}'
        for name in ('points', 'precisions', 'restates_the_bound'):
            comparison.same('fits', f'{own} {name}', fit[name], line[name])
        for name in ('exponent', 'standard_error'):
            least, most = line[name] - SOLVED, line[name] + SOLVED
            comparison.within('fits', f'{own} {name}', fit[name], least, most)
        for name in ('half_width_95', 'least_part_of_claimed', 'greatest_part_of_claimed'):
            comparison.near('fits', f'{own} {name}', fit[name], line[name], SOLVED)


def fits(report):
    """The fits of each algorithm's farthest distance as a power of epsilon.

    The fits are over all families ("") and by family. The fits use the report's largest ratios,
    which are checked elsewhere."""
    lines = []
    families = sorted(
        {
            name
            for each in report['subjects'].values()
            for kind in KINDS
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
            lines.append(
                {
                    'algorithm': algorithm,
                    'origin': origin,
                    'points': len(points),
                    'precisions': precisions,
                    'exponent': line.slope,
                    'standard_error': line.stderr,
                    'half_width_95': line.stderr * stats.t.ppf(0.975, len(points) - 2),
                    'least_part_of_claimed': part.min(),
                    'greatest_part_of_claimed': part.max(),
                    'restates_the_bound': bool(part.min() > 0.9),
                }
            )
    return lines


def _points(report, algorithm, origin):
    """Exponents of epsilon, binary logarithms of the farthest distances in units of B, and the
    ratios of these distances to the claimed ones."""
    points = []
    for rung in report['ladder']['rungs']:
        own = report['subjects'][rung['subject']]
        parts = [
            own[kind]['families'][origin] if origin else own[kind]
            for kind in KINDS
            if not origin or origin in own[kind]['families']
        ]
        part = max(part['max_fp_distance_over_bound'] for part in parts)
        farthest = rung['claimed'] * part
        power = exponent('' if rung['scalar'] == 'double' else rung['scalar'])
        if rung['algorithm'] == algorithm and FINEST <= power <= COARSEST and part >= BORDERS[0]:
            points.append((power, math.log2(farthest), part))
    return points


def check_findings(comparison, section, report, answers):
    """Checks that findings and farthest false positives are queries that fail in the recorded
    way."""
    seen = {
        (each['what'], each['subject'], each['signature']): each['seen']
        for each in report['signatures']
    }
    for i, found in enumerate(report['findings']):
        where = f'{section} {i}'
        check_finding(comparison, where, answers, found)
        signature = found['what'], found['subject'], found['signature']
        comparison.same('signatures', f'{where} seen', found['seen'], seen.get(signature))
        place_of = answers.place(found['kind'], found['provenance'])
        if place_of is not None:
            judged = answers.asked[found['subject'], found['kind']].judged[place_of]
            check_query(comparison, where, found['original'], judged)
    check_extreme_times(comparison, 'extreme times', report['extreme_times'], report, answers)
    rows = [(far['subject'], far['kind'], far['family']) for far in report['farthest']]
    expected = [
        (subject, kind, family)
        for subject in answers.subjects
        for kind in KINDS
        for family in answers.families(kind)
        if Tally.of(answers, subject, [kind], family).false_positives
    ]
    comparison.same('names', f'{section} farthest', rows, expected)
    for found in report['farthest']:
        where = f'farthest {found["subject"]} {found["kind"]} {found["family"]}'
        check_false_positive(comparison, where, answers, found['subject'], found['kind'], found)
        comparison.same('names', where, found['shown_family'], found['family'])
        own = report['subjects'][found['subject']][found['kind']]['families'][found['family']]
        comparison.same('names', f'{where} class', found['class'], own['class'])
        comparison.same('largest ratios', where, found['ratio'], own['max_fp_distance_over_bound'])
        comparison.same(
            'counters', f'{where} bound', found['bound_of_distances'], own['bound_of_distances']
        )


def check_finding(comparison, where, answers, found):
    """Checks a missed collision, a late time or a refuted bound by its provenance."""
    place_of = answers.place(found['kind'], found['provenance'])
    asked = answers.asked.get((found['subject'], found['kind']))
    if place_of is None or asked is None:
        return comparison.fail(
            'provenances', where, found['provenance'], 'a query of the campaign'
        )
    refutes = found['what'] == 'refuted-bound'
    ends = reported(asked.ratios.lo[place_of], asked.ratios.hi[place_of]) if refutes else (0, 0)
    ratio = float(found['ratio'] if 'ratio' in found else found['distance_over_bound'])
    comparison.within('largest ratios', where, ratio, *ends)
    after = asked.impact.after
    late_by = (
        reported(after.lo[place_of], after.hi[place_of]) if found['what'] == 'late' else (0, 0)
    )
    comparison.within('times', f'{where} late', float(found.get('late_by', 0)), *late_by)
    is_so = {
        'false-negative': asked.false_negative[place_of],
        'refuted-bound': asked.claims and asked.ratios.hi[place_of] > 1,
        'late': asked.impact.late[place_of],
    }
    comparison.same(
        'provenances', f'{where} {found["what"]}', bool(is_so.get(found['what'])), True
    )
    comparison.same(
        'provenances', f'{where} family', found['family'], found['provenance'].rsplit(':', 2)[0]
    )
    (of,) = answers.classes(found['kind'], [asked.judged[place_of]])
    comparison.same('names', f'{where} class', found['class'], of)
