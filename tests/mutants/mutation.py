"""A mutant: one small change of a file's text, and the context that says how it can be switched on."""

import hashlib
from dataclasses import asdict, dataclass

from sources import shown


@dataclass(frozen=True)
class Edit:
    """Text that takes the place of text[start:end]."""

    start: int
    end: int
    text: str


@dataclass(frozen=True)
class Mutation:
    file: str
    operator: str
    edits: tuple  # of one mutant, in order
    form: str  # what the edits change: 'expression', 'condition' or 'statement'
    at_compile_time: bool  # in a constexpr function
    constants: tuple = ()  # edits without which a constexpr variable is known before the program runs
    line: int = 0
    last_line: int = 0
    before: str = ''  # the lines, and what becomes of them
    after: str = ''
    nth: int = 0  # of equal changes of equal lines

    @property
    def identity(self):
        return '|'.join([self.file, self.operator, self.before, self.after, str(self.nth)])

    @property
    def name(self):
        return hashlib.sha256(self.identity.encode()).hexdigest()[:12]

    def lines(self, text):
        """Lines of which a compiler may speak that has trouble with this mutant."""
        own = set(range(self.line, self.last_line + 1))
        return own | {line_of(text, edit.start) for edit in self.constants}


def from_dict(values):
    def edits(each):
        return tuple(Edit(**edit) for edit in each)

    return Mutation(
        **{**values, 'edits': edits(values['edits']), 'constants': edits(values['constants'])}
    )


def to_dict(mutation):
    return asdict(mutation)


def line_of(text, offset):
    return text.count('\n', 0, offset) + 1


def applied(text, edits):
    """The text after edits that do not overlap."""
    for edit in sorted(edits, key=lambda each: each.start, reverse=True):
        text = text[: edit.start] + edit.text + text[edit.end :]
    return text


def placed(text, mutation):
    """The mutation with its lines, before and after."""
    first = text.rfind('\n', 0, mutation.edits[0].start) + 1
    last = text.find('\n', mutation.edits[-1].end)
    last = len(text) if last < 0 else last
    edits = [Edit(e.start - first, e.end - first, e.text) for e in mutation.edits]
    lines = text[first:last]
    values = to_dict(mutation)
    values['line'] = line_of(text, mutation.edits[0].start)
    values['last_line'] = line_of(text, mutation.edits[-1].end)
    values['before'] = shown(lines)
    values['after'] = shown(applied(lines, edits))
    return from_dict(values)
