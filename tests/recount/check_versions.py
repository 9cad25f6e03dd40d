"""Checks which queries versions of a CCD fix and break."""

import numpy as np

from tally import CLASSES


def fails(asked):
    """For each query, whether the subject misses it, is late, or exceeds its bound."""
    refuted = asked.ratios.hi > 1 if asked.claims else False
    return asked.false_negative | asked.impact.late | refuted


def check_versions(comparison, where, report, answers):
    """Checks the section versions of report.json, and the findings that are broken."""
    found = report.get('versions', [])
    pairs = sorted({(each['before'], each['after']) for each in found})
    expected = [row for pair in pairs for row in rows(*pair, report, answers)]
    comparison.same('versions', where, found, expected)
    for i, each in enumerate(report['findings']):
        before = each.get('broken_since')
        place = answers.place(each['kind'], each['provenance'])
        if before is None or place is None:
            continue
        known = answers.asked.get((before, each['kind']))
        is_right = known is not None and not fails(known)[place]
        comparison.same('versions', f'findings {i} broken since {before}', is_right, True)


def rows(before, after, report, answers):
    """A row for each class of families and each kind."""
    for of in CLASSES:
        for kind in answers.kinds(after):
            families = report['subjects'][after][kind]['families']
            own = np.isin(
                answers.family[kind], [f for f in families if families[f]['class'] == of]
            )
            if not own.any():
                continue
            one, other = (fails(answers.asked[subject, kind])[own] for subject in (before, after))
            counts = {
                'fixed': one & ~other,
                'broken': other & ~one,
                'both': one & other,
                'neither': ~(one | other),
                'queries': np.ones_like(one),
            }
            yield {
                'before': before,
                'after': after,
                'kind': kind,
                'class': of,
                **{name: int(each.sum()) for name, each in counts.items()},
            }
