"""Nights, and the machine on which they run. A night is a run of a campaign that ends early."""

import os
import pathlib
import random
import resource
import signal
import subprocess
import time

from campaigns import Failure

SIGNALS = {
    'SIGKILL': signal.SIGKILL,
    'SIGTERM': signal.SIGTERM,
    'SIGINT': signal.SIGINT,
    'SIGHUP': signal.SIGHUP,
}
PATIENCE = 300  # seconds until a process counts as hanging; far more than any process needs
FOUND, REFUSED, INTERRUPTED = 1, 2, 130  # exit codes of nearmiss


class Machine:
    """Runs nearmiss, and finds the processes that it leaves behind."""

    def __init__(self, nearmiss, plugins, folder):
        self.nearmiss, self.plugins, self.folder = nearmiss, plugins, folder

    def start(self, command, jumps=False, largest_file=None):
        environment = {**os.environ, 'NEARMISS_ONE_IN': '500'}
        if jumps:
            clock = self.plugins / 'jumping_clock.so'
            environment.update(LD_PRELOAD=str(clock), NEARMISS_JUMP=str(10**8))

        def prepare():
            for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
                signal.signal(each, signal.SIG_DFL)
            if largest_file is not None:
                resource.setrlimit(resource.RLIMIT_FSIZE, (largest_file, largest_file))

        with (self.folder / 'said').open('w', encoding='utf-8') as said:
            # Python ignores SIGXFSZ, the signal for a file that is too large. If file sizes are
            # limited, nearmiss inherits this from Python, and ignores SIGXFSZ, too. So a write
            # beyond the limit fails, but no signal ends nearmiss.
            return subprocess.Popen(
                [self.nearmiss, *command], cwd=self.folder, env=environment, preexec_fn=prepare,
                stdout=subprocess.DEVNULL, stderr=said, restore_signals=largest_file is None,
            )  # fmt: skip

    def call(self, command, campaign):
        """Runs a command to its end."""
        process = self.start(command)
        try:
            code = process.wait()
        finally:
            process.kill()
        if code not in (0, FOUND):
            raise Failure(f'{campaign}: {command[0]} ends with {code}: {self.said()}')

    def said(self):
        return (self.folder / 'said').read_text(encoding='utf-8').strip()

    def left(self):
        """The processes that still run in this machine's folder."""
        found = []
        for each in pathlib.Path('/proc').glob('[0-9]*'):
            try:
                if self.folder in (here := pathlib.Path(os.readlink(each / 'cwd')), *here.parents):
                    found.append(int(each.name))
            except OSError:
                continue  # the process has ended
        return found

    def wait_until_alone(self):
        """Waits until no process is left. The children of a killed process take a moment to end."""
        end = time.monotonic() + PATIENCE
        while left := self.left():
            if time.monotonic() >= end:
                raise Failure(f'processes {left} are left running')
            time.sleep(0.01)

    def clean(self):
        for each in self.left():
            os.kill(each, signal.SIGKILL)
        while self.left():
            time.sleep(0.01)


def catches(process, number):
    """Whether a process is ready for a signal. It is ready if it has a handler for the signal. It
    is always ready for SIGKILL."""
    if number == signal.SIGKILL:
        return True
    try:
        status = pathlib.Path(f'/proc/{process.pid}/status').read_text(encoding='utf-8')
    except OSError:
        return False
    caught = next(line.split()[1] for line in status.splitlines() if line.startswith('SigCgt:'))
    return bool(int(caught, 16) >> (number - 1) & 1)


def last_save(store):
    """The time at which a store was last saved; None before its first save."""
    try:
        return store.with_name(f'{store.name}-wal').stat().st_mtime_ns
    except FileNotFoundError:
        return None


class Night:
    """One run of a campaign, and how it ends. The seed and the night's number determine all
    choices."""

    def __init__(self, number, seed, seconds):
        self.draw = random.Random(f'{seed} night {number}')
        self.end = self.draw.choice([*SIGNALS, *SIGNALS, 'full disk', 'full disk', 'time limit'])
        self.after = self.draw.uniform(0.02, seconds)
        self.seconds = seconds
        self.saves_first = self.draw.random() < 0.5
        self.room = self.draw.randrange(
            300_000
        )  # number of bytes that can be written before the disk is full
        self.jobs = self.draw.choice([1, 2, 3])
        self.jumps = self.draw.random() < 0.3

    def __str__(self):
        text = f'{self.end} {self.after:.2f} s after its {"first save" if self.saves_first else "start"}'
        if self.end == 'full disk':
            text = f'a disk that is full after {self.room:,} bytes'
        return text + (', a clock that jumps' if self.jumps else '')

    def run(self, campaign, machine):
        """Runs the night, and returns the exit code. Raises Failure if `end` cannot give this code."""
        if self.end == 'full disk':
            largest = max([file.stat().st_size for file in campaign.files()] + [0]) + self.room
            process = machine.start(
                campaign.command(campaign.store, self.jobs), self.jumps, largest
            )
            code = self.wait(process, signal.SIGTERM, self.seconds)
            expected = {INTERRUPTED, REFUSED}
        else:
            command = campaign.command(campaign.store, self.jobs)
            if self.end == 'time limit':
                command += ['--time', f'{max(1, int(1000 * self.after))}ms']
            saved = last_save(campaign.store)
            process = machine.start(command, self.jumps)
            if self.saves_first:
                while process.poll() is None and last_save(campaign.store) == saved:
                    time.sleep(0.005)
            code = self.wait(process, SIGNALS.get(self.end), self.after)
            expected = {'SIGKILL': {-signal.SIGKILL}, 'time limit': set()}
            expected = expected.get(self.end, {INTERRUPTED})
        machine.wait_until_alone()
        if code not in {0, FOUND} | expected:
            raise Failure(f'{campaign}: {self}, and the exit code is {code}: {machine.said()}')
        return code

    @staticmethod
    def wait(process, end, after):
        """Waits until a process ends, or sends it the signal `end` after some seconds. Returns the exit
        code."""
        try:
            if end is not None:
                try:
                    return process.wait(after)
                except subprocess.TimeoutExpired:
                    while not catches(process, end) and process.poll() is None:
                        time.sleep(0.001)
                    process.send_signal(end)
            return process.wait(PATIENCE)
        except subprocess.TimeoutExpired as error:
            raise Failure(f'{process.args} does not end') from error
        finally:
            process.kill()
            process.wait()
