"""The results of mutants, which are saved after each mutant."""

import json
import os

from sources import FOLDERS, WORK, fingerprint

FILE = WORK / 'results.json'
CODE = {'.cpp', '.hpp', '.c', '.h'}
PAGES_AND_BUILD = {'.js', '.css', '.html', '.cmake', '.txt', '.py', '.sh'}
TEST_DATA = {'.py', '.txt', '.case'}


class Results:
    """The stored result of each mutant. A change of the product makes every result invalid. A
    change of the tests makes a result invalid if no test noticed the mutant."""

    def __init__(self, file=FILE):
        self.file = file
        self.product = fingerprint([*FOLDERS, 'tools'], CODE | PAGES_AND_BUILD)
        self.tests = fingerprint(['tests', 'corpus/cases'], CODE | TEST_DATA)
        self.kept = json.loads(file.read_text()) if file.exists() else {}

    def get(self, mutation):
        """The result of a mutant, or None if it has no valid result."""
        result = self.kept.get(mutation.name)
        if result is None or result['product'] != self.product:
            return None
        if not result['noticed_by'] and result['tests'] != self.tests:
            return None
        return result

    def put(self, mutation, values):
        self.kept[mutation.name] = {**values, 'product': self.product, 'tests': self.tests}
        fresh = self.file.with_suffix('.new')
        fresh.write_text(json.dumps(self.kept, indent=1))
        os.replace(fresh, self.file)
