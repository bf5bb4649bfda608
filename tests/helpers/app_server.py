"""The web app as a user starts it: the command in a process and a folder of its own."""

import os
import re
import signal
import socket
import subprocess
import sys
import threading
from contextlib import contextmanager

from ehlectric.runtime.worker_processes import cores
from tests.helpers.commands import COMMAND
from tests.helpers.processes import PATIENCE, memory_of, tree, wait_until

_ADDRESS = re.compile(r"ehlectric is at (http://\S+)")

# The command with longer times for an answer, for a message on a page, and for a browser that is away [s], so
# that a busy machine ends none of them. The modules of the pages are loaded when the command would load them.
_PATIENT = """
import sys
from dataclasses import replace
from ehlectric.app import session, work

limits_of, keep_in_memory = work.limits_of, session.keep_in_memory

def longer(**given):
    return replace(limits_of(**given), patience=600.0)

def keep_and_wait():
    keep_in_memory()
    from ehlectric.app import server
    from ehlectric.app.pages import page_parts
    server._RECONNECT, page_parts._BRIEF = {away}, 60.0

work.limits_of, session.keep_in_memory = longer, keep_and_wait
sys.argv[0] = "ehlectric"
from ehlectric.__main__ import main
main()
"""


@contextmanager
def kept_port():
    """Port that no other program is given meanwhile, so that servers of a test may come and go on it."""
    with socket.socket() as keeper:
        # Servers may share it with a socket that does not listen, and that allows it.
        keeper.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        keeper.bind(("127.0.0.1", 0))
        yield keeper.getsockname()[1]


def _heeds_hangup():
    """Take the signal of a closed terminal, which is ignored where the tests themselves run after nohup."""
    signal.signal(signal.SIGHUP, signal.SIG_DFL)


class AppServer:
    """Server of the app.

    Parameters
    ----------
    folder : Path
        Folder in which the command is typed, and beside which its temporary files lie.
    *options : str
        Further options of the command.
    patient : bool
        Whether it has longer time limits than the command, for tests that wait for its answers.
    away : float
        Time after which a patient server ends what a browser has left [s].
    """

    def __init__(self, folder, *options, patient=False, away=60.0):
        self.folder, self.temporary = folder / "typed_here", folder / "tmp"
        for path in (self.folder, self.temporary):
            path.mkdir(exist_ok=True)
        self.log = folder / "log"
        begin = [sys.executable, "-c", _PATIENT.format(away=away)] if patient else [COMMAND]
        port = () if "--port" in options else ("--port", "0")
        words = [*begin, "app", "--no-browser", *port, *options]
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(
                words,
                cwd=self.folder,
                env=os.environ | {"TMPDIR": str(self.temporary)},
                stdout=subprocess.PIPE,
                stderr=log,
                text=True,
                preexec_fn=_heeds_hangup,
            )
        self.address = self._told(PATIENCE)

    def _told(self, seconds):
        """Address of the app, which the command prints when it answers."""
        late = threading.Timer(seconds, self.process.kill)
        late.start()
        line = self.process.stdout.readline()
        late.cancel()
        found = _ADDRESS.match(line)
        if found is None:
            self.stop(signal.SIGKILL)
            raise AssertionError(f"{line}{self.log.read_text()}")
        return found[1]

    @property
    def port(self):
        """Port of the server."""
        return int(re.search(r":(\d+)/", self.address)[1])

    def processes(self):
        """Numbers of the processes of the server."""
        return tree(self.process.pid)

    def started(self):
        """Numbers of its processes, once there are all that it begins with: those of jobs come later."""
        # The server, the process that the others are forked from, its tracker, and those of quick answers.
        assert wait_until(lambda: len(self.processes()) >= 3 + min(4, cores()))
        return self.processes()

    def memory(self):
        """Memory of all processes of the server [bytes]."""
        return memory_of(self.processes())

    def stop(self, number=signal.SIGINT):
        """Stop the server by a signal; returns its exit status."""
        self.process.send_signal(number)
        try:
            return self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        finally:
            self.process.stdout.close()
