"""A mutant: one small change of a file's text, with the context that decides how it can be
switched on."""

from dataclasses import asdict, dataclass

from sources import sha, shown


@dataclass(frozen=True)
class Edit:
    """An edit that replaces text[start:end]."""

    start: int
    end: int
    text: str


@dataclass(frozen=True)
class Mutation:
    file: str
    operator: str
    edits: tuple  # the edits of one mutant, in order
    form: str  # what the edits change: 'expression', 'condition' or 'statement'
    at_compile_time: bool  # whether the change is in a constexpr function
    constants: tuple = ()  # edits that make constexpr variables depend on the switch
    line: int = 0
    last_line: int = 0
    before: str = ''  # the changed lines before the edits, and after
    after: str = ''
    nth: int = 0  # distinguishes equal changes of equal lines

    @property
    def identity(self):
        return '|'.join([self.file, self.operator, self.before, self.after, str(self.nth)])

    @property
    def name(self):
        return sha(self.identity)[:12]

    @property
    def where(self):
        return f'{self.file}:{self.line}'

    def lines(self, text):
        """The lines that a compiler may name in an error about this mutant."""
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
    """Applies edits that do not overlap to a text."""
    for edit in sorted(edits, key=lambda each: each.start, reverse=True):
        text = text[: edit.start] + edit.text + text[edit.end :]
    return text


def placed(text, mutation):
    """The mutation with `before` and `after`, the lines that it changes."""
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
