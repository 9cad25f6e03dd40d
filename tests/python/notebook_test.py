"""Runs the notebook of the Python package, and compares its output with the output saved in the file.
Usage: notebook_test.py
"""

import os
import pathlib
import unittest

import nbformat
from nbclient import NotebookClient

NOTEBOOK = pathlib.Path(__file__).resolve().parents[2] / 'tools/python/notebook.ipynb'


def shown(cell):
    """Returns the texts and pictures that a cell outputs. Gives only the type of a picture,
    because the pixels depend on versions of libraries."""
    for output in cell.get('outputs', []):
        if output.get('name') == 'stderr':  # the progress of trials
            continue
        data = output.get('data', {})
        yield sorted(data), output.get('text') or data.get('text/html') or data.get('text/plain')


class Notebook(unittest.TestCase):
    def test_gives_what_it_shows(self):
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        kept = [list(shown(cell)) for cell in notebook.cells]
        os.environ['PYDEVD_DISABLE_FILE_VALIDATION'] = '1'  # no warning about the debugger
        NotebookClient(notebook, timeout=200, kernel_name='python3').execute()
        for before, cell in zip(kept, notebook.cells):
            self.assertEqual(list(shown(cell)), before, cell.source)
        self.assertTrue(any('image/png' in types for cell in kept for types, _ in cell))


if __name__ == '__main__':
    unittest.main()
