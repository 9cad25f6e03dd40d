"""Runs commands that the user can stop."""

import os
import signal
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass

stopping = threading.Event()


class Stopped(Exception):
    """Raised when the user wants to stop."""


@dataclass
class Ended:
    """How a command ended, its wall time, and the CPU time of the command and all of its children."""

    code: int  # exit code, or minus the number of the signal that ended it
    output: str
    cpu: float
    wall: float
    late: bool = False


def stop_on_signals():
    """Makes SIGINT and SIGTERM end the running commands within a fraction of a second."""
    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, lambda *_: stopping.set())


def kill(process):
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def wait(process, seconds):
    """Waits for a process to end, but kills it after `seconds`. Returns a triple: whether the process
    exceeded this time, its exit code, and the resources that it used."""
    begin = time.monotonic()
    late, pause = False, 0.002
    while True:
        ended, status, usage = os.wait4(process.pid, os.WNOHANG)
        if ended:
            process.returncode = os.waitstatus_to_exitcode(status)
            return late, process.returncode, usage
        if not late and time.monotonic() - begin > seconds:
            late = True
            kill(process)
        if stopping.is_set():
            kill(process)
        time.sleep(pause)
        pause = min(2 * pause, 0.1)


def limits(memory=None):
    """Words to put before a command to lower its priority, to forbid core dumps, and to limit the
    memory of each of its processes to `memory` bytes, if given."""
    words = ['nice', '-n', '2', 'prlimit', '--core=0']
    if memory is not None:
        words.append(f'--as={memory}')
    return words


def seal():
    """Words to put before a command to isolate its processes: they cannot see or kill other
    processes, and none of them survives the command. The first process in a PID namespace ignores
    signals. Therefore the first process is a shell, and the command that it runs is the second
    process. If a signal ends the command, the shell's exit code is 128 plus the number of the
    signal.
    """
    user = [] if os.geteuid() == 0 else ['--user', '--map-current-user']
    shell = ['sh', '-c', '"$@"; exit $?', 'sh']
    return ['unshare', *user, '--pid', '--fork', '--kill-child', '--mount-proc', *shell]


def run(command, cwd, env=None, seconds=3600, before=()):
    """Runs a command in its own process group. Puts the words `before`, or those of limits() if
    `before` is empty, before the command."""
    if stopping.is_set():
        raise Stopped
    begin = time.monotonic()
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(
            [str(word) for word in [*(before or limits()), *command]],
            cwd=cwd,
            env={**os.environ, **(env or {})},
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        late, code, usage = wait(process, seconds)
        if stopping.is_set():
            raise Stopped
        output.seek(0)
        text = output.read(20_000_000).decode('utf-8', 'replace')
    wall = time.monotonic() - begin
    return Ended(code, text, usage.ru_utime + usage.ru_stime, wall, late)
