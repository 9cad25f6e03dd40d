"""Draws mutants by a seed, evenly over folders and over operators.

The order depends only on each mutant's own text, so that a change elsewhere does not change a
draw."""

import inspect
import multiprocessing
import pickle
import signal
from itertools import zip_longest

import syntax
from processes import Stopped, stopping
from sites import mutants_of
from sources import ROOT, WORK, cpp_files, read, sha

CACHE = WORK / 'trees'


def kept_tree(name):
    """The path that keeps a file's syntax tree. It depends on the file's text."""
    return CACHE / sha(name, read(ROOT / name), inspect.getsource(syntax.Node))


def sites_of(task):
    """The mutants of some files, which are parsed in a compiled file that includes all of them."""
    unit, arguments, names = task
    missing = [name for name in names if not kept_tree(name).exists()]
    if missing:
        CACHE.mkdir(parents=True, exist_ok=True)
        trees = syntax.parse(ROOT / unit, arguments, [ROOT / name for name in missing])
        for name, tree in zip(missing, trees):
            kept_tree(name).write_bytes(pickle.dumps(tree))
    trees = [pickle.loads(kept_tree(name).read_bytes()) for name in names]
    return [
        m for name, tree in zip(names, trees) for m in mutants_of(name, read(ROOT / name), tree)
    ]


def end_on_signals():
    """Ignores SIGINT in a process of the pool, because the first process ends the others."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)


def all_sites(compiled, copy, folders, jobs):
    """The mutants of all compiled files in folders."""
    names = {}
    for name in cpp_files(folders):
        for unit in compiled.units(name)[:1]:
            names.setdefault(unit, []).append(name)
    tasks = [(unit, compiled.arguments(unit, copy), names[unit]) for unit in names]
    with multiprocessing.Pool(jobs, end_on_signals) as pool:
        found = pool.map_async(sites_of, tasks, chunksize=1)
        while not found.ready():
            found.wait(0.2)
            if stopping.is_set():
                raise Stopped
        return [mutation for each in found.get() for mutation in each]


def in_turn(lists):
    """Interleaves lists: the first of each list, then the second of each, and so on."""
    return [each for row in zip_longest(*lists) for each in row if each is not None]


class Lines:
    """The lines that already have a mutant. A line gets at most one."""

    def __init__(self):
        self.taken = set()

    def take(self, mutation):
        lines = {(mutation.file, line) for line in range(mutation.line, mutation.last_line + 1)}
        if lines & self.taken:
            return False
        self.taken |= lines
        return True


def draw(mutations, folders, seed, count):
    """Up to `count` mutants of each folder, from each operator in turn."""
    chosen = []
    for folder in folders:
        by_operator = {}
        for each in mutations:
            if each.file.split('/')[0] == folder:
                by_operator.setdefault(each.operator, []).append(each)
        for operator in by_operator:
            by_operator[operator].sort(key=lambda each: sha(str(seed), each.identity))
        order = sorted(by_operator, key=lambda each: sha(str(seed), folder, each))
        lines = Lines()
        turns = in_turn([by_operator[operator] for operator in order])
        chosen.append([each for each in turns if lines.take(each)][:count])
    return in_turn(chosen)
