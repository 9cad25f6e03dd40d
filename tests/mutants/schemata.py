"""Writes the text of a file that contains several mutants, each switched on by its number."""

import re

from mutation import Edit, applied

# The forms in which a mutant is compiled. As a switch, 'now' is evaluated at run time, 'chosen'
# selects between values of different types, and 'constexpr' works in constexpr functions. 'alone'
# means a separate build, and 'invalid' means that the mutant does not compile.
SWITCHES = {'now', 'chosen', 'constexpr'}
NOT_CONSTANT = re.compile(
    r'constexpr|constant.expression|is not (a )?constant|not usable in a const'
)


def first_form(mutation):
    return 'constexpr' if mutation.at_compile_time else 'now'


def next_form(form, errors):
    """The form to try after `form`, which does not compile."""
    if NOT_CONSTANT.search(errors):
        return 'alone' if form == 'constexpr' else 'constexpr'
    return 'chosen' if form == 'now' and '?:' in errors else 'invalid'


def one_line(text):
    """Removes comments and line ends from code, so that the lines after it keep their numbers."""
    text = re.sub(r'("(?:\\.|[^"\\\n])*")|//[^\n]*', lambda found: found[1] or '', text)
    return ' '.join(text.split())


def switched(original, edit, number, form, what):
    """The code with a switch that replaces the original text of an edit."""
    on = f'mutants::{"mutant" if form == "constexpr" else "now"}({number})'
    changed = one_line(edit.text)
    if what == 'statement':
        return f'{{ if (!{on}) {original} }}'
    if what == 'condition':
        if changed.startswith('!(') and one_line(original) in changed:
            return f'({on} != static_cast<bool>({original}))'
        return f'({on} ? static_cast<bool>({changed}) : static_cast<bool>({original}))'
    if form == 'chosen':
        return (
            f'mutants::choose({on}, [&] {{ return mutants::value({changed}); }}, '
            f'[&] {{ return mutants::value({original}); }})'
        )
    return f'({on} ? ({changed}) : ({original}))'


def with_switches(text, mutants):
    """The text of a file with all of its mutants, given as (number, mutation, form)."""
    edits = set()
    for number, mutation, form in mutants:
        for edit in mutation.edits:
            original = text[edit.start : edit.end]
            edits.add(
                Edit(edit.start, edit.end, switched(original, edit, number, form, mutation.form))
            )
        edits |= set(mutation.constants)
    return applied(text, edits)


def by_itself(text, mutation):
    """The text of a file with one mutant, without a switch."""
    return applied(text, mutation.edits)
