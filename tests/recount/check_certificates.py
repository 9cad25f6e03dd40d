"""Checks the certificates of findings with the checker of tools/certificates/."""

import math
import sys
from pathlib import Path

from asking import VERTICES

sys.path.append(str(Path(__file__).resolve().parents[2] / 'tools' / 'certificates'))
from check import Refused, Statement, check  # pylint: disable=wrong-import-position


def check_certificates(comparison, where, report, answers):
    """Checks that the certificate of each finding proves that the subject is wrong about its
    shrunk query."""
    for i, found in enumerate(report['findings']):
        own = f'{where} {i} certificate'
        if found['what'] == 'refuted-bound':
            claimed = answers.asked[found['subject'], found['kind']].claimed
            line = ' '.join(float(number).hex() for number in found['shrunk'])
            comparison.same('certificates', f'{own} bound', found['bound'], claimed(line))
        if found['certificate'] is None:
            if found['what'] != 'fault':  # a tie, for which there may be no proof
                comparison.fail('certificates', own, None, 'a proof')
            continue
        try:
            proven = check(found['certificate'])
        except Refused as reason:
            comparison.fail('certificates', own, reason, 'a proof')
        else:
            comparison.same('certificates', own, proven, _expected(found, proven))


def _expected(found, proven):
    """What the certificate of a finding must prove."""
    count = 6 * VERTICES[found['kind']]
    x, h = tuple(found['shrunk'][:count]), (*found['shrunk'], 0)[count]
    if found['what'] == 'refuted-bound':
        beyond = found['bound'] if h == 0 else math.nextafter(h + found['bound'], math.inf)
        return Statement(found['kind'], x, beyond, 'apart', 0, 1, False, True)
    if found['what'] == 'late':
        to = proven.to if proven.to < found['toi'] else None
        return Statement(found['kind'], x, h, 'meets', 0, to, False, h > 0)
    if found['what'] in ('committed', 'unsafe-step'):
        step, to = tuple(found['step'][:count]), proven.to if proven.to < 1 else None
        return Statement(found['kind'], step, h, 'meets', 0, to, False, h > 0)
    if found['what'] == 'false-negative':
        return Statement(found['kind'], x, h, 'meets', 0, 1, False, h > 0)
    return Statement(found['kind'], x, h, proven.claim, 0, 1, False, proven.strict)
