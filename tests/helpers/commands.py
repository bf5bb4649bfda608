"""Run the ehlectric command as a user types it, without the time that its imports take.

A server process imports the package once; each command is a fork of it, with its own folder, output and exit
status.
"""

import multiprocessing
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from tests.helpers.preloaded import NAMES

COMMAND = Path(sys.executable).with_name("ehlectric")

_server = multiprocessing.get_context("forkserver")
_server.set_forkserver_preload([__name__, *NAMES])


def _command(arguments, folder, output, errors):
    """Run the command in this process, with output and errors in files."""
    from ehlectric.commands.app import main

    for number, path in ((1, output), (2, errors)):
        os.dup2(os.open(path, os.O_WRONLY | os.O_CREAT), number)
    os.chdir(folder)
    sys.argv = [str(COMMAND), *arguments]
    main()


def run_command(*words, cwd, timeout=300):
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
    arguments = [str(word) for word in words]
    with tempfile.TemporaryDirectory() as scratch:
        output, errors = Path(scratch) / "output", Path(scratch) / "errors"
        process = _server.Process(target=_command, args=(arguments, cwd, output, errors))
        process.start()
        process.join(timeout)
        if process.exitcode is None:
            process.kill()
            raise subprocess.TimeoutExpired(arguments, timeout)
        return subprocess.CompletedProcess(
            arguments, process.exitcode, output.read_text("utf-8"), errors.read_text("utf-8")
        )
