"""One query on which a subject fails: its numbers, its explanation and its picture."""

import dataclasses
import html
import importlib
from dataclasses import dataclass
from typing import Any, Callable, Literal

import numpy as np
from numpy.typing import NDArray

from nearmiss._functions import certificate, earliest_time
from nearmiss._queries import _LAYOUTS, kind_of

# The edges of the first and of the second primitive, by the numbers of their vertices.
_LINES: dict[str, tuple[list[tuple[int, int]], list[tuple[int, int]]]] = {
    'vt': ([], [(1, 2), (2, 3), (3, 1)]),
    'ee': ([(0, 1)], [(2, 3)]),
    'vv': ([], []),
    've': ([], [(1, 2)]),
}
_COLORS = ('#b2182b', '#2166ac')  # of the first primitive, and of the second
_WIDTH, _HEIGHT, _MARGIN = 320, 240, 16  # of a picture, in pixels


@dataclass(frozen=True)
class Finding:
    """A query on which a subject fails.

    x, separation:     if is_shrunk, the simplest query that fails in the same way, otherwise the original
                       query; x is (2, v, 3), where v is 4, or 2 for 'vv' and 3 for 've'
    kind, what, class_, subject, family, signature, provenance: as in Findings
    """

    x: NDArray[np.float64]
    separation: float
    is_shrunk: bool
    kind: Literal['vt', 'ee', 'vv', 've']
    what: str
    class_: str
    subject: str
    family: str
    signature: str
    provenance: str
    _explain: Callable[..., str] = dataclasses.field(repr=False)

    @property
    def explanation(self) -> str:
        """What happens in the query, in words."""
        return self._explain(self.kind, self.x, self.separation)

    @property
    def certificate(self) -> str:
        """The proof of the exact answer, which check.py of tools/certificates/ checks; '' if there is none."""
        return str(certificate(self.kind, self.x, self.separation))

    @property
    def code(self) -> str:
        """The query as Python code that can be pasted."""
        numbers = np.array2string(self.x, separator=', ', floatmode='unique', threshold=100)
        return f'x = np.array({numbers})\nassert nearmiss.collides({self.kind!r}, x, {self.separation!r})'

    def plot(self, ax: Any = None) -> Any:
        """Draws the query with Matplotlib, in three dimensions: dashed at t = 0, solid at contact or at t = 1."""
        if ax is None:
            ax = importlib.import_module('matplotlib.pyplot').figure().add_subplot(projection='3d')
        for _, color, dashed, a, b in _segments(self.kind, self._places()):
            ax.plot(
                *np.stack([a, b]).T, color=color, linestyle='--' if dashed else '-', marker='.'
            )
        ax.set_title(f'{self.what} of {self.subject}: {self.signature}')
        return ax

    def _places(self) -> NDArray[np.float64]:
        """The vertices at t = 0 and at contact, (2, v, 3). Without contact, at t = 0 and t = 1."""
        end = float(earliest_time(self.kind, self.x, self.separation).lo)
        t = end if 0 < end <= 1 else 1.0
        with np.errstate(all='ignore'):
            return np.stack([self.x[0], (1 - t) * self.x[0] + t * self.x[1]])

    def _repr_html_(self) -> str:
        """The picture and the facts, for notebooks."""
        facts = {
            'missed'
            if self.what == 'false-negative'
            else self.what: f'{self.class_} {self.kind} of {self.subject}',
            'what happens': self.explanation,
            'way to fail': self.signature,
            'found in': self.provenance,
        }
        rows = ''.join(
            f'<tr><th style="text-align:left">{html.escape(name)}</th>'
            f'<td style="text-align:left">{html.escape(value)}</td></tr>'
            for name, value in facts.items()
        )
        return f'<div>{_picture(self.kind, self._places())}<table>{rows}</table></div>'


def _segments(kind: str, places: NDArray[np.float64]) -> list[tuple[int, str, bool, Any, Any]]:
    """The lines to draw: (primitive, color, is dashed, one end, other end). A vertex is a line of length
    0."""
    split = 2 if kind == 'ee' else 1
    lines = []
    for primitive, (edges, color) in enumerate(zip(_LINES[kind], _COLORS)):
        vertices = range(split) if primitive == 0 else range(split, places.shape[1])
        for dashed, at in ((True, places[0]), (False, places[1])):
            for a, b in edges or [(v, v) for v in vertices]:
                lines.append((primitive, color, dashed, at[a], at[b]))
    return lines


def _picture(kind: str, places: NDArray[np.float64]) -> str:
    """The query as SVG, seen from a corner: dashed at t = 0, solid at contact or at t = 1."""
    with np.errstate(all='ignore'):
        centre = places.reshape(-1, 3).mean(0)
        moved = places - centre
        scale = np.abs(moved).max()
        moved = moved / scale if np.isfinite(scale) and scale > 0 else np.zeros_like(moved)
    view = np.array([[0.8, -0.6, 0.0], [-0.35, -0.45, 0.82]])
    flat = moved @ view.T
    span = max(np.abs(flat).max(), 1e-9)
    size = min(_WIDTH, _HEIGHT) / 2 - _MARGIN
    flat = flat / span * size * [1, -1] + [_WIDTH / 2, _HEIGHT / 2]
    parts = []
    for _, color, dashed, a, b in _segments(kind, flat):
        dash = ' stroke-dasharray="4 3"' if dashed else ''
        parts.append(
            f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{color}"'
            f' stroke-width="2" stroke-linecap="round"{dash}/>'
            f'<circle cx="{a[0]:.1f}" cy="{a[1]:.1f}" r="3" fill="{color}"/>'
            f'<circle cx="{b[0]:.1f}" cy="{b[1]:.1f}" r="3" fill="{color}"/>'
        )
    return f'<svg width="{_WIDTH}" height="{_HEIGHT}" xmlns="http://www.w3.org/2000/svg">{"".join(parts)}</svg>'


def finding_of(columns: dict[str, Any], explain: Callable[..., str]) -> Finding:
    """Makes a finding. `columns` has the finding's value in each array of Findings, by the array's name."""
    kind: Any = str(columns['kind'])
    count = _LAYOUTS[kind_of(kind)].vertices
    shrunk = bool(columns['is_shrunk'])
    x = columns['shrunk'] if shrunk else columns['x']
    separation = columns['shrunk_separation'] if shrunk else columns['separation']
    names = ('what', 'class_', 'subject', 'family', 'signature', 'provenance')
    return Finding(
        x=x[:, :count].copy(),
        separation=float(separation),
        is_shrunk=shrunk,
        kind=kind,
        _explain=explain,
        **{name: str(columns[name]) for name in names},
    )
