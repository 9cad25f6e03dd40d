"""The operators. Each yields edits for a node of the syntax tree.

An operator is a function of (text, node) that yields (form, edits); Mutation explains the forms.
To add an operator, write a function with the decorator @operator."""

import re

from mutation import Edit

OPERATORS = {}

STRICTNESS = {'<': '<=', '<=': '<', '>': '>=', '>=': '>'}
SIGNS = {'+': '-', '-': '+', '+=': '-=', '-=': '+='}
EQUALITY = {'==': '!=', '!=': '=='}
DROPPED_RIGHT = {'+', '-', '*', '/', '&&', '||'}
DROPPED_LEFT = {'+', '*', '&&', '||'}
EXTREMES = {
    'min': 'max',
    'max': 'min',
    'minCoeff': 'maxCoeff',
    'maxCoeff': 'minCoeff',
    'cwiseMin': 'cwiseMax',
    'cwiseMax': 'cwiseMin',
    'min_element': 'max_element',
    'max_element': 'min_element',
    'lower_bound': 'upper_bound',
    'upper_bound': 'lower_bound',
}
# For these functions, the order of the arguments makes no difference.
SYMMETRIC = re.compile(r'\b(min|max|swap|hypot|tie|midpoint|gcd|dot)\s*(<[^()]*>)?$')
OPERATOR_KINDS = {'BINARY_OPERATOR', 'CALL_EXPR', 'COMPOUND_ASSIGNMENT_OPERATOR', 'UNEXPOSED_EXPR'}
STATEMENTS = OPERATOR_KINDS | {'UNARY_OPERATOR', 'CONTINUE_STMT', 'BREAK_STMT'}
BODIES = {'IF_STMT', 'FOR_STMT', 'WHILE_STMT', 'CXX_FOR_RANGE_STMT'}
# The values of these nodes are known at compile time even without constexpr.
NEVER = {'STATIC_ASSERT', 'ENUM_CONSTANT_DECL', 'ENUM_DECL', 'CONCEPT_DECL'}
LITERALS = {'INTEGER_LITERAL', 'FLOATING_LITERAL'}


def operator(function):
    OPERATORS[function.__name__.replace('_', ' ')] = function
    return function


def binary(text, node):
    """The sign of a binary operator, the sign's place, and the operands. None for other nodes."""
    if node.kind not in OPERATOR_KINDS or len(node.children) < 2:
        return None
    left, right = node.children[0], node.children[-1]
    if left.start != node.start or right.end != node.end or left.end > right.start:
        return None
    sign = text[left.end : right.start].strip()
    place = text.index(sign, left.end) if sign else 0
    return sign, place, left, right


def of(node, text):
    return text[node.start : node.end]


def exchanged(text, node, table):
    """The edits that exchange the binary operator of a node by this table."""
    found = binary(text, node)
    if found is None or found[0] not in table:
        return None
    sign, place, left, right = found
    if '"' in (text[left.start], text[left.end - 1], text[right.start]) or 'string' in left.type:
        return None  # the node is text, not an operator
    return [
        Edit(
            node.start,
            node.end,
            text[node.start : place] + table[sign] + text[place + len(sign) : node.end],
        )
    ]


@operator
def strictness(text, node):
    """Exchanges < and <=, and > and >=."""
    if edits := exchanged(text, node, STRICTNESS):
        yield 'expression', edits


@operator
def sign(text, node):
    """Exchanges + and -, and += and -=, or leaves out a minus sign."""
    if edits := exchanged(text, node, SIGNS):
        yield 'expression', edits
    if node.kind == 'UNARY_OPERATOR' and re.match(r'-[^-]', of(node, text)):
        yield 'expression', [Edit(node.start, node.end, text[node.start + 1 : node.end])]


@operator
def dropped_term(text, node):
    """Leaves out a term of a sum, a factor, a conjunct or a disjunct."""
    found = binary(text, node)
    if found is None:
        return
    sign, _, left, right = found
    if sign in DROPPED_RIGHT:
        yield 'expression', [Edit(node.start, node.end, of(left, text))]
    if sign in DROPPED_LEFT:
        yield 'expression', [Edit(node.start, node.end, of(right, text))]


def is_value(text, node):
    """Whether a literal is a value, and neither a template's argument nor a case label."""
    if node.parent is None or node.parent.kind in (
        'CASE_STMT',
        'DECL_REF_EXPR',
        'MEMBER_REF_EXPR',
    ):
        return False
    before = text[max(0, node.start - 200) : node.start].rstrip()
    return before[-1:] != '<' or binary(text, node.parent) is not None


@operator
def index(text, node):
    """Puts x[i + 1] in place of x[i], or makes a whole number off by one."""
    if (
        node.kind in ('ARRAY_SUBSCRIPT_EXPR', 'CALL_EXPR', 'UNEXPOSED_EXPR')
        and len(node.children) > 1
    ):
        place = node.children[-1]
        is_bracket = text[place.end : node.end].strip() == ']'
        if is_bracket and not re.match(r'[\d"]', of(place, text)):
            yield 'expression', [Edit(place.start, place.end, f'({of(place, text)}) + 1')]
    if node.kind == 'INTEGER_LITERAL' and is_value(text, node):
        if of(node, text) in ('0', '1', '2', '3'):
            number = int(of(node, text))
            yield 'expression', [
                Edit(node.start, node.end, str(number - 1 if number > 1 else 1 - number))
            ]
            if number == 1:
                yield 'expression', [Edit(node.start, node.end, '2')]


@operator
def constant(text, node):
    """Multiplies a constant by two or ten, or halves it."""
    if node.kind not in LITERALS or not is_value(text, node):
        return
    literal = of(node, text)
    if re.fullmatch(r"[01]u?|0\.0*f?|'.*'", literal) or not re.match(r'[0-9.]', literal):
        return
    if node.kind == 'INTEGER_LITERAL' and text[node.end :].lstrip()[:1] == ']':
        return
    for changed in (f'2 * {literal}', f'10 * {literal}', f'{literal} / 2'):
        yield 'expression', [Edit(node.start, node.end, f'({changed})')]


def arguments(text, node):
    """The arguments of a call, or the elements of a list, between brackets and commas."""
    found = []
    for child in node.children:
        before = text[node.start : child.start].rstrip()[-1:]
        after = text[child.end : node.end].lstrip()[:1]
        if child.is_expression and before in ('(', '{', ',') and after in (')', '}', ','):
            found.append(child)
    return found


def plain(type_name):
    return re.sub(r'\bconst\b|[&\s]', '', type_name)


def is_alike(one, other):
    """Whether the types of two arguments allow exchanging them."""
    if 'dependent' in one.type + other.type:
        return True
    return plain(one.type) == plain(other.type) != ''


@operator
def swapped_arguments(text, node):
    """Exchanges two neighbouring arguments."""
    if node.kind not in ('CALL_EXPR', 'INIT_LIST_EXPR', 'UNEXPOSED_EXPR'):
        return
    given = arguments(text, node)
    if given and SYMMETRIC.search(text[node.start : given[0].start].rstrip()[:-1].rstrip()):
        return
    for one, other in zip(given, given[1:]):
        texts = of(one, text), of(other, text)
        if texts[0] != texts[1] and is_alike(one, other) and '[&' not in texts[0] + texts[1]:
            yield 'expression', [
                Edit(one.start, one.end, texts[1]),
                Edit(other.start, other.end, texts[0]),
            ]


def is_statement(node):
    """Whether a node is a statement by itself."""
    if node.parent is None or node.kind not in STATEMENTS:
        return False
    if node.parent.kind == 'COMPOUND_STMT':
        return True
    if node.parent.kind == 'IF_STMT':
        return node is not condition_of(node.parent)
    return node.parent.kind in BODIES and node is node.parent.children[-1]


@operator
def statement_left_out(text, node):
    """Leaves out an assignment, an increment, a call or a jump."""
    if not is_statement(node):
        return
    rest = text[node.end : node.end + 200]
    gap = len(rest) - len(rest.lstrip())
    is_hint = re.search(r'\breserve\([^()]*(\([^()]*\)[^()]*)*\)$', of(node, text))
    if rest[gap : gap + 1] == ';' and not is_hint:
        yield 'statement', [Edit(node.start, node.end + gap + 1, '')]


def condition_of(node):
    """The condition of an if, a while or a ?:. None if it is not an expression."""
    if node.kind not in ('IF_STMT', 'WHILE_STMT', 'CONDITIONAL_OPERATOR'):
        return None
    return next((child for child in node.children if child.is_expression), None)


@operator
def negated_condition(text, node):
    """Negates the condition of an if, a while or a ?:; exchanges == and !=; drops a negation."""
    if edits := exchanged(text, node, EQUALITY):
        yield 'expression', edits
    is_condition = node.parent is not None and condition_of(node.parent) is node
    if node.kind == 'UNARY_OPERATOR' and re.match('![^=]', of(node, text)) and not is_condition:
        yield 'condition', [Edit(node.start, node.end, text[node.start + 1 : node.end])]
    condition = condition_of(node)
    if condition is not None and not re.match(r'if\s+constexpr', text[node.start :]):
        yield 'condition', [Edit(condition.start, condition.end, f'!({of(condition, text)})')]


@operator
def min_for_max(text, node):
    """Exchanges a minimum and a maximum, or a lower and an upper bound."""
    if node.kind != 'CALL_EXPR' or '(' not in of(node, text) or not node.children:
        return
    callee = re.search(r'\b(\w+)\s*(<[^()]*>)?$', of(node.children[0], text))
    if callee and callee[1] in EXTREMES and node.children[0].start == node.start:
        start = node.start + callee.start(1)
        changed = (
            text[node.start : start]
            + EXTREMES[callee[1]]
            + text[start + len(callee[1]) : node.end]
        )
        yield 'expression', [Edit(node.start, node.end, changed)]
