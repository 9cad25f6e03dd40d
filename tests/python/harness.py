"""Reads the queries and answers that answered_queries writes, in the format of
tests/installed/answers.cpp. Runs programs in another interpreter, and sets modes of the processor."""

import contextlib
import ctypes
import os
import subprocess
import sys
from dataclasses import dataclass
from typing import Optional

import numpy as np

KINDS = {1: 'vt', 2: 'ee'}


@dataclass
class Block:
    kind: str
    x: np.ndarray  # (n, 2, 4, 3)
    separation: np.ndarray
    collides: np.ndarray
    wang: np.ndarray
    bound: np.ndarray
    times: Optional[np.ndarray] = None  # (2, n), lo and hi
    distances: Optional[np.ndarray] = None


def run_python(program, *arguments, **variables):
    """Runs a program in another interpreter, with `variables` in its environment. Returns the exit
    code, standard output and standard error of the program."""
    command = [sys.executable, '-c', program, *arguments]
    run = subprocess.run(command, capture_output=True, text=True, env={**os.environ, **variables})
    return run.returncode, run.stdout, run.stderr


def answered_queries(program, count, seed):
    # CMakeLists.txt preloads the sanitizers' runtime for Python. `program` is linked with this
    # runtime, so it must not be preloaded again.
    environment = {key: value for key, value in os.environ.items() if key != 'LD_PRELOAD'}
    command = [program, str(count), str(seed)]
    data = subprocess.run(command, capture_output=True, check=True, env=environment).stdout
    at = 0

    def read(dtype, *shape):
        nonlocal at
        array = np.frombuffer(data, dtype, int(np.prod(shape)), at)
        at += array.nbytes
        return array.reshape(shape).copy()  # the copy is aligned

    blocks = []
    while at < len(data):
        kind, n, timed = read(np.int32, 3)
        x, separation = read(float, n, 2, 4, 3), read(float, n)
        collides, wang = read(np.int8, n) == 1, read(np.int8, n) == 1
        block = Block(KINDS[kind], x, separation, collides, wang, read(float, n))
        if timed:
            block.times, block.distances = read(float, 2, n), read(float, 2, n)
        blocks.append(block)
    return blocks


@contextlib.contextmanager
def processor_mode(bits):
    """Sets bits of the processor's register MXCSR during a `with` block, by fegetenv and fesetenv of libm."""
    libm = ctypes.CDLL('libm.so.6')
    saved, changed = ((ctypes.c_uint32 * 8)() for _ in range(2))  # the last element is MXCSR
    libm.fegetenv(saved)
    libm.fegetenv(changed)
    changed[7] |= bits
    libm.fesetenv(changed)
    try:
        yield
    finally:
        libm.fesetenv(saved)
