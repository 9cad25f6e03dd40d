"""A mutant: one small change of a line of code."""

from dataclasses import dataclass

from sources import sha, shown


@dataclass(frozen=True)
class Mutation:
    """Replaces `old`, the text of the line with number `line` in a file, by `new`. `nth`
    distinguishes equal mutants of equal lines."""

    file: str
    operator: str
    line: int
    old: str
    new: str
    nth: int = 0
    reason: str = ''  # why the mutant changes no answer, if equivalent.txt lists it

    @property
    def identity(self):
        """A text that identifies the mutant, and does not depend on other lines of the file."""
        return '|'.join([self.file, self.operator, self.old, self.new, str(self.nth)])

    @property
    def name(self):
        return sha(self.identity)[:12]

    @property
    def where(self):
        return f'{self.file}:{self.line}'

    @property
    def before(self):
        return shown(self.old)

    @property
    def after(self):
        return shown(self.new)

    def applied(self, text):
        """The text of the file with the mutant."""
        lines = text.split('\n')
        lines[self.line - 1] = self.new
        return '\n'.join(lines)
