"""The syntax tree of a C++ file from libclang, reduced to the kinds and extents of its nodes."""

from clang import cindex

# For cursors of these kinds, the children's types matter.
TYPED = {'CALL_EXPR', 'INIT_LIST_EXPR'}


class Node:
    """One node, with libclang's name of its kind, its begin and its end."""

    __slots__ = ('kind', 'start', 'end', 'type', 'is_expression', 'parent', 'children')

    def __init__(self, cursor, parent):
        self.kind = cursor.kind.name
        self.start = cursor.extent.start.offset
        self.end = cursor.extent.end.offset
        self.is_expression = cursor.kind.is_expression()
        self.parent = parent
        self.type = ''
        if parent is not None and parent.kind in TYPED:
            self.type = cursor.type.get_canonical().spelling
        self.children = [Node(child, self) for child in cursor.get_children()]

    def ancestors(self):
        node = self.parent
        while node is not None:
            yield node
            node = node.parent

    def walk(self):
        yield self
        for child in self.children:
            yield from child.walk()


def parse(path, arguments, wanted):
    """Parses a file and all that it includes. Returns the nodes of the wanted files."""
    unit = cindex.Index.create().parse(str(path), args=arguments)
    found = {str(each): [] for each in wanted}
    for cursor in unit.cursor.get_children():
        if cursor.location.file and cursor.location.file.name in found:
            found[cursor.location.file.name].append(Node(cursor, None))
    return [found[str(each)] for each in wanted]
