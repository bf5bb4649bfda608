"""The web app as a user starts it: the command in a process and a folder of its own."""

import os
import re
import signal
import subprocess
import threading

from tests.helpers.commands import COMMAND
from tests.helpers.processes import memory_of, tree

_ADDRESS = re.compile(r"ehlectric is at (http://\S+)")


class AppServer:
    """Server of the app.

    Parameters
    ----------
    folder : Path
        Folder in which the command is typed, and beside which its temporary files lie.
    *options : str
        Further options of the command.
    """

    def __init__(self, folder, *options):
        self.folder, self.temporary = folder / "typed_here", folder / "tmp"
        for path in (self.folder, self.temporary):
            path.mkdir(exist_ok=True)
        self.log = folder / "log"
        words = [COMMAND, "app", "--no-browser", *(() if "--port" in options else ("--port", "0")), *options]
        with self.log.open("wb") as log:
            self.process = subprocess.Popen(
                words,
                cwd=self.folder,
                env=os.environ | {"TMPDIR": str(self.temporary)},
                stdout=subprocess.PIPE,
                stderr=log,
                text=True,
            )
        self.address = self._told(60.0)

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

    def memory(self):
        """Memory of all processes of the server [bytes]."""
        return memory_of(self.processes())

    def stop(self, number=signal.SIGINT):
        """Stop the server by a signal; returns its exit status."""
        self.process.send_signal(number)
        try:
            return self.process.wait(20.0)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        finally:
            self.process.stdout.close()
