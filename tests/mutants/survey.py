"""Surveys mutants: makes one of them at a time in the copy, and runs the tests with it."""

from dataclasses import asdict

import copied
from asking import Answer, ask
from results import Results
from suite import all_steps, baseline


def say(text):
    print(text, flush=True)


class Survey:
    """The results of mutants, each in a separate build."""

    def __init__(self, drawn, jobs):
        self.drawn, self.jobs = drawn, jobs
        self.results = Results()
        self.done = 0

    def prepare(self):
        """Builds the copy, and measures the tests without a mutant, unless all results are known."""
        if all(map(self.results.get, self.drawn)):
            return
        copied.make_copy()
        copied.configure()
        say('building the copy without a mutant')
        ended = copied.ninja(['all'], self.jobs)
        if ended.code != 0:
            raise SystemExit(f'the copy is not built:\n{ended.output[-4000:]}')
        self.steps = [step for step in baseline(all_steps(), self.jobs, say) if step.fine]

    def find(self, mutation):
        """Builds and runs first the tests of the mutant's own folder, then all others."""
        own = mutation.file.split('/')[0]
        answer = Answer()
        copied.make_copy(mutation)
        for target, is_own in ((f'{own}_tests', True), ('all', False)):
            if copied.ninja([target], self.jobs).code != 0:
                return {'verdict': 'invalid', 'noticed_by': ''}
            ask([step for step in self.steps if (step.group == own) == is_own], answer)
            if answer.noticed_by:
                return {'verdict': 'noticed', **asdict(answer)}
        return {'verdict': 'survived', **asdict(answer)}

    def known(self, mutation):
        """The result of a mutant: a stored result or, if there is none, a new one, which is then stored."""
        if mutation.reason:
            return {'verdict': 'equivalent', 'noticed_by': ''}
        if (result := self.results.get(mutation)) is None:
            result = self.find(mutation)
            self.results.put(mutation, result)
        return result

    def result_of(self, mutation):
        """A mutant with its result. Prints a line of progress."""
        result = self.known(mutation)
        by = f' by {result["noticed_by"]}, {result["cpu"]:.1f} s' if result['noticed_by'] else ''
        self.done += 1
        say(f'[{self.done}] {mutation.where} {mutation.operator}: {result["verdict"]}{by}')
        return mutation, result

    def take(self):
        """All results, as pairs of a mutant and its result."""
        return [self.result_of(mutation) for mutation in self.drawn]
