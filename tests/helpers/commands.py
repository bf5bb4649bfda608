"""Run the ehlectric command as a user types it, without the time that its imports take.

A server process imports the package once; each command is a fork of it, with its own folder, output and exit
status.
"""

import multiprocessing
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import weakref
from pathlib import Path

from tests.helpers.preloaded import NAMES

# Time after which a command that hangs is killed [s]; a busy machine takes several times as long as an idle
# one.
_PATIENCE = 900.0

COMMAND = Path(sys.executable).with_name("ehlectric")

_server = multiprocessing.get_context("forkserver")
_server.set_forkserver_preload([__name__, *NAMES])


def _command(arguments, folder, output, errors, group):
    """Run the command in this process, with output and errors in files."""
    from ehlectric.__main__ import main

    if group:
        os.setsid()
    if hasattr(signal, "SIGHUP"):
        # The command respects a signal that is ignored, as it is where the tests themselves run after nohup.
        signal.signal(signal.SIGHUP, signal.SIG_DFL)
    for number, path in ((1, output), (2, errors)):
        os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT), number)
    os.chdir(folder)
    sys.argv = [str(COMMAND), *arguments]
    main()


class Begun:
    """A command that runs, with what is used here of ``subprocess.Popen``.

    Parameters
    ----------
    *words : str or Path
        Arguments and options of the command.
    cwd : Path
        Folder to run in.
    group : bool
        Whether it leads a group of processes of its own.
    """

    def __init__(self, *words, cwd, group=False):
        self.args = [str(word) for word in words]
        scratch = tempfile.mkdtemp()
        weakref.finalize(self, shutil.rmtree, scratch, ignore_errors=True)
        self._files = [Path(scratch) / name for name in ("output", "errors")]
        self._process = _server.Process(target=_command, args=(self.args, cwd, *self._files, group))
        self._process.start()
        self.pid = self._process.pid
        self.kill, self.terminate = self._process.kill, self._process.terminate

    @property
    def returncode(self):
        """Exit status, minus the signal that ended it; None while it runs."""
        return self._process.exitcode

    def poll(self):
        return self.returncode

    def send_signal(self, number):
        os.kill(self.pid, number)

    def errors(self):
        """Errors that it has written so far."""
        return self._files[1].read_text("utf-8") if self._files[1].exists() else ""

    def communicate(self, timeout=_PATIENCE):
        """Output and errors, once it has ended; a command that hangs is killed."""
        self._process.join(timeout)
        if self.returncode is None:
            self.kill()
            raise subprocess.TimeoutExpired(self.args, timeout)
        return tuple(path.read_text("utf-8") if path.exists() else "" for path in self._files)


def run_command(*words, cwd, timeout=_PATIENCE):
    """Run the command in a folder.

    Parameters
    ----------
    *words : str or Path
        Arguments and options of the command.
    cwd : Path
        Folder to run in.
    timeout : float
        Time limit [s], after which a command that hangs is killed.

    Returns
    -------
    subprocess.CompletedProcess
        Exit status, output and errors of the command.
    """
    begun = Begun(*words, cwd=cwd)
    output, errors = begun.communicate(timeout)
    return subprocess.CompletedProcess(begun.args, begun.returncode, output, errors)
