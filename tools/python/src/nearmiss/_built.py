"""Raises an ImportError that says how to build the compiled modules if this Python does not have them."""

import pathlib
import sys
from importlib.machinery import EXTENSION_SUFFIXES

_folder = pathlib.Path(__file__).parent
_module = '_interface'  # the module that every build has
_this = f'Python {sys.version_info.major}.{sys.version_info.minor} ({sys.executable})'


def _missing() -> str:
    """Why this Python does not find the module; '' if it does."""
    built = sorted(file.name for file in _folder.glob(f'{_module}.*') if file.suffix != '.pyi')
    if any(_module + suffix in built for suffix in EXTENSION_SUFFIXES):
        return ''
    if built:
        return (
            f'{_folder} has {", ".join(built)}, which is for another Python than {_this}; '
            'tools/python/README.md says how to make a wheel for this one'
        )
    build = _folder.parents[1]
    command = (
        f'cmake --build {build} --target nearmiss_python' if _is_build(build) else 'tools/setup'
    )
    return f'nearmiss.{_module} is not built in {_folder}, expected it for {_this}: run {command}'


def _is_build(folder: pathlib.Path) -> bool:
    return (folder / 'CMakeCache.txt').exists()


if _missing():
    raise ImportError(_missing())
