"""Finds all mutants that the operators make of a file."""

import re
from collections import Counter
from dataclasses import replace

from mutation import Edit, Mutation, placed
from operators import NEVER, OPERATORS

FUNCTIONS = {
    'FUNCTION_DECL',
    'FUNCTION_TEMPLATE',
    'CXX_METHOD',
    'CONSTRUCTOR',
    'CONVERSION_FUNCTION',
    'LAMBDA_EXPR',
}
VARIABLES = {'VAR_DECL', 'FIELD_DECL'}
CLASSES = {'CLASS_DECL', 'STRUCT_DECL', 'CLASS_TEMPLATE'}


def head(text, node):
    """A function's text before its body."""
    body = [child for child in node.children if child.kind == 'COMPOUND_STMT']
    return text[node.start : body[-1].start if body else node.end]


def is_constexpr(text, node):
    return (
        node.kind in FUNCTIONS and re.search(r'\bconst(expr|eval)\b', head(text, node)) is not None
    )


def made_variable(text, node):
    """The edit that gives a constexpr variable its value at run time. None for other nodes."""
    found = re.match(r'[\w\s\[\]:]*?\b(constexpr)\b', text[node.start : node.end])
    if node.kind not in VARIABLES or not found:
        return None
    start, end = node.start + found.start(1), node.start + found.end(1)
    if node.parent is not None and node.parent.kind == 'DECL_STMT':
        return Edit(start, end, 'const' if 'static' in found[0] else '')
    is_member = node.parent is not None and node.parent.kind in CLASSES
    return Edit(start, end, 'inline const' if is_member and 'inline' not in found[0] else 'const')


def context(text, node):
    """Whether a node is in a constexpr function, and the edits that its constexpr variables
    need. None if the node cannot be mutated."""
    at_compile_time, constants = False, []
    for each in [node, *node.ancestors()]:
        if each.kind in NEVER or (each is not node and each.kind == 'CXX_THROW_EXPR'):
            return None
        at_compile_time = at_compile_time or is_constexpr(text, each)
        if edit := made_variable(text, each):
            constants.append(edit)
    return at_compile_time, tuple(constants)


def changes(text, nodes):
    """Yields the edits of each operator for each node, as (node, operator, form, edits)."""
    for root in nodes:
        for node in (each for each in root.walk() if each.end > each.start):
            for operator, edits_of in OPERATORS.items():
                for form, edits in edits_of(text, node):
                    yield node, operator, form, tuple(edits)


def mutants_of(file, text, nodes):
    """The mutants of a file, each once, in the order of the syntax tree."""
    found, known, count = [], set(), Counter()
    for node, operator, form, edits in changes(text, nodes):
        where = context(text, node) if edits not in known else None
        known.add(edits)
        if where is None:
            continue
        mutation = placed(text, Mutation(file, operator, edits, form, *where))
        if mutation.before != mutation.after:
            count[mutation.identity] += 1
            found.append(replace(mutation, nth=count[mutation.identity] - 1))
    return found
