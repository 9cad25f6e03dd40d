"""A survey of named edits of the oracle: makes one at a time, and runs the oracle's tests."""

import math
from dataclasses import asdict

import copied
from asking import Answer, ask
from sources import ROOT, read
from suite import baseline, steps_of
from survey import Survey, say

# The groups of tests and their targets, in the order in which they run. The first one is built
# soonest and notices most. The proofs notice halved bounds, which random
# queries do not show.
GROUPS = {'judge_answers': 'judge_answers', 'oracle': 'oracle_tests', 'proofs': 'proofs_tests'}
QUERIES = 20000  # whose answers are proved; they take half a minute of a core
MOST_SECONDS = 1800  # tests that take longer without an edit, even on a busy machine, are left out


def text_with(edit):
    """A function that gives the text of each C++ file with an edit, a character for each byte."""

    def text_of(name):
        if name not in {place.file for place in edit.places}:
            return read(ROOT / name)
        return edit.applied(name, (ROOT / name).read_text('utf-8')).encode().decode('latin-1')

    return text_of


class NamedSurvey(Survey):
    """Named edits, each in a separate build. If no test notices an edit that has a reason, its
    verdict is 'equivalent'."""

    def __init__(self, edits, groups, jobs):
        super().__init__(jobs)
        self.drawn, self.groups = edits, groups

    def prepare(self):
        """Builds the copy, and measures the tests without an edit, unless all results are known."""
        if all(map(self.results.get, self.drawn)):
            return
        copied.make_copy(lambda name: read(ROOT / name))
        copied.configure()
        targets = [GROUPS[group] for group in self.groups]
        ended = copied.ninja(targets, self.jobs, lambda step: say(f'building {step}'))
        if ended.code != 0:
            raise SystemExit(f'the copy is not built:\n{ended.output[-4000:]}')
        steps = [step for group in self.groups for step in steps_of(group, QUERIES)]
        found = baseline(steps, self.jobs, say, MOST_SECONDS)
        self.steps = [step for step in found if step.fine]
        for group in self.groups:
            if not self.steps_of(group):
                raise SystemExit(f'{group}: all tests fail or take too long without an edit')

    def steps_of(self, group):
        return [step for step in self.steps if step.group == group]

    def find(self, edit):
        """Builds and runs one group of tests after the other with an edit, until one notices it.
        The verdict is 'invalid' if the edit does not compile, and 'open' if no group notices it
        but not all groups were asked."""
        answer = Answer()
        copied.make_copy(text_with(edit))
        for group in self.groups:
            if copied.ninja([GROUPS[group]], self.jobs).code != 0:
                return {'verdict': 'invalid', 'noticed_by': ''}
            ask(0, self.steps_of(group), 'oracle', answer, budget=math.inf)
            if answer.noticed_by:
                return {'verdict': 'noticed', **asdict(answer)}
        is_asked = set(self.groups) == set(GROUPS)
        return {'verdict': 'survived' if is_asked else 'open', **asdict(answer)}

    def result_of(self, edit):
        """The result of an edit. It is stored if it is final."""
        if (result := self.results.get(edit)) is None:
            result = self.find(edit)
            if result['verdict'] in ('noticed', 'survived'):
                self.results.put(edit, result)
        if result['verdict'] == 'survived' and edit.reason:
            result = {**result, 'verdict': 'equivalent'}
        self.show(edit, result)
        return edit, result

    def take(self):
        """All results, as pairs of an edit and its result."""
        return [self.result_of(edit) for edit in self.drawn]


def contradictions(results):
    """A line for each edit that contradicts its list. Such an edit does not compile, has a reason
    although a test notices it, or has no reason although no test notices it."""
    lines = []
    for edit, result in results:
        verdict = result['verdict']
        if verdict == 'noticed' and edit.reason:
            by = f'noticed by {result["noticed_by"]} in spite of its reason'
            lines.append(f'{edit.title}: {by}: {edit.reason}')
        elif verdict == 'survived':
            lines.append(f'{edit.title}: noticed by no test, and has no reason: {edit.about}')
        elif verdict == 'invalid':
            lines.append(f'{edit.title}: does not compile')
    return lines
