"""Asks the tests about a mutant: the quick ones first, until one fails."""

import re
from dataclasses import dataclass, field

from copied import BUILD
from processes import run
from suite import MEMORY, command, forget

BUDGET = 120  # seconds of one core that a mutant may take, by what its tests take without it


@dataclass
class Answer:
    """What the tests said of a mutant."""

    noticed_by: str = ''  # the first test that failed, or ''
    how: str = ''  # 'failed', 'crashed' or 'too slow'
    cpu: float = 0
    wall: float = 0
    asked: int = 0  # tests
    unasked: list = field(default_factory=list)  # tests for which no time was left
    spent: dict = field(default_factory=dict)  # seconds by test, as without a mutant


def batches(steps, folder):
    """Steps in the order of their time, in batches that take twice as long each; the folder's own first."""
    batch, size, limit = [], 0, 0.5
    for step in sorted(steps, key=lambda each: (each.cpu, each.name)):
        if batch and size + step.cpu > limit:
            yield by_group(batch, folder)
            batch, size, limit = [], 0, 2 * limit
        batch.append(step)
        size += step.cpu
    if batch:
        yield by_group(batch, folder)


def by_group(batch, folder):
    """The steps of a batch, by executable."""
    groups = {}
    for step in batch:
        groups.setdefault(step.group, []).append(step)
    order = sorted(groups, key=lambda each: (each != folder, sum(s.cpu for s in groups[each])))
    return [groups[each] for each in order]


def affordable(steps):
    """The quick ones that fit the budget, and the names of the others."""
    kept, left, total = [], [], 0
    for step in sorted(steps, key=lambda each: (each.cpu, each.name)):
        total += step.cpu
        if total <= BUDGET:
            kept.append(step)
        else:
            left.append(step.name)
    return kept, left


def culprit(group, ended):
    """Which test failed, and how."""
    how = (
        'too slow'
        if ended.late or ended.code in (-24, -9)
        else 'failed'
        if ended.code > 0
        else 'crashed'
    )
    failed = re.search(r'\[  FAILED  \] ([\w./]+)', ended.output)
    begun = re.findall(r'\[ RUN      \] (\S+)', ended.output)
    test = failed[1] if failed else begun[-1] if begun else ''
    return (f'{group}.{test}' if test else group), how


def ask(number, steps, folder):
    """What the tests say of the mutant with a number, 0 for one that is built in."""
    answer = Answer()
    kept, answer.unasked = affordable(steps)
    for batch in batches(kept, folder):
        for group in batch:
            words = command(group[0].group, [step.test for step in group])
            cpu = sum(step.cpu for step in group)
            wall = sum(step.wall for step in group)
            try:
                ended = run(
                    words,
                    cwd=BUILD,
                    env={'NEARMISS_MUTANT': str(number)},
                    seconds=30 + 10 * wall,
                    cpu=4 + 4 * cpu,
                    memory=MEMORY,
                )
            finally:
                forget(words)
            answer.cpu += ended.cpu
            answer.wall += ended.wall
            answer.asked += len(group)
            answer.spent.update({step.name: step.cpu for step in group})
            if ended.code != 0 or ended.late:
                answer.noticed_by, answer.how = culprit(group[0].group, ended)
                return answer
    return answer
