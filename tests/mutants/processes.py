"""Commands that stop when they are told to."""

import os
import re
import signal
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass

stopping = threading.Event()


class Stopped(Exception):
    """The user wants to stop."""


@dataclass
class Ended:
    """How a command ended, and what it used with all of its children."""

    code: int  # negative: the signal
    output: str
    cpu: float
    wall: float
    late: bool = False


def stop_on_signals():
    """SIGINT and SIGTERM end the commands that run, within a fraction of a second."""
    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, lambda *_: stopping.set())


def kill(process):
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass


def latest_step(output):
    """The last progress that a build has written to its output, such as [12/250]."""
    size = os.fstat(output.fileno()).st_size
    end = os.pread(output.fileno(), 4096, max(0, size - 4096)).decode('utf-8', 'replace')
    return (re.findall(r'^\[\d+/\d+\]', end, re.MULTILINE) or [''])[-1]


def wait(process, seconds, progress=lambda: None):
    """Waits for the end; whether it was too late, its status and usage."""
    begin = shown = time.monotonic()
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
        if time.monotonic() - shown > 30:
            shown = time.monotonic()
            progress()
        time.sleep(pause)
        pause = min(2 * pause, 0.1)


def limits(cpu=None, memory=None):
    """Words before a command that limit each of its processes, in seconds and bytes."""
    words = ['nice', '-n', '2', 'prlimit', '--core=0']
    if cpu is not None:
        words.append(f'--cpu={int(cpu)}:{int(cpu) + 1}')
    if memory is not None:
        words.append(f'--as={memory}')
    return words


def seal():
    """Words before a command that may do anything: it sees and kills no other processes, and leaves none. The first process of
    theirs is a shell, since a first process ignores signals; a command that a signal ends has 128 more than its number.
    """
    user = [] if os.geteuid() == 0 else ['--user', '--map-current-user']
    return [
        'unshare',
        *user,
        '--pid',
        '--fork',
        '--kill-child',
        '--mount-proc',
        'sh',
        '-c',
        '"$@"; exit $?',
        'sh',
    ]


def run(command, cwd, env=None, seconds=3600, before=(), say=None):
    """Runs a command in a group of its own, after words such as `limits` and `seal`."""
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
        late, code, usage = wait(process, seconds, lambda: say and say(latest_step(output)))
        if stopping.is_set():
            raise Stopped
        output.seek(0)
        text = output.read(20_000_000).decode('utf-8', 'replace')
    wall = time.monotonic() - begin
    return Ended(code, text, usage.ru_utime + usage.ru_stime, wall, late)
