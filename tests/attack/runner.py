"""Commands run in forks of a server, each in a folder of its own, and what they did."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

from tests.helpers.dask import Dask
from tests.helpers.no_home import package_without_folders, without_home
from tests.helpers.processes import PATIENCE

REPOSITORY = Path(__file__).parents[2]


@dataclass(frozen=True)
class Outcome:
    """What a command did.

    Attributes
    ----------
    arguments : tuple of str
        Words of the command.
    status : int
        Exit status, or minus the number of the signal that ended it.
    ended : bool
        Whether it ended by itself, within the time it had.
    out, err : str
        What it printed.
    seconds : float
        Its time [s].
    processor : float
        Its time on the processor, with that of workers that it waited for [s].
    peak : int
        Largest memory of its process, without those of workers [bytes].
    changed : tuple of str
        Paths of all files that it made, wrote, moved or removed, without those of workers.
    group : int
        Number of its group of processes, to which its workers belong.
    """

    arguments: tuple[str, ...]
    status: int
    ended: bool
    out: str
    err: str
    seconds: float
    processor: float
    peak: int
    changed: tuple[str, ...]
    group: int


class Runner:
    """A server of commands, with a private home and folder of temporary files; use it as a context.

    Parameters
    ----------
    home : Path
        Folder for all of these.
    poor : bool
        Whether the user has no home, the package cannot be written to, and a thread beside that which forks
        the commands has all locks for ever.
    """

    def __init__(self, home: Path, *, poor: bool = False) -> None:
        self.home, self.told = home / "home", home / "told"
        self.temporary, self._of_cluster = home / "tmp", home / "cluster"
        for folder in (self.home, self.told, self.temporary):
            folder.mkdir(parents=True)
        environment = {
            **os.environ,
            "HOME": str(self.home),
            "TMPDIR": str(self.temporary),
            "MPLCONFIGDIR": str(self.home / "matplotlib"),
            "COLUMNS": "200",
            # Commands are run two at a time.
            "OMP_NUM_THREADS": "1",
            "OPENBLAS_NUM_THREADS": "1",
        }
        if poor:
            environment |= without_home(package_without_folders(home))
        self._server = subprocess.Popen(
            [sys.executable, "-B", "-m", "tests.attack.server", *(["poor"] if poor else [])],
            cwd=REPOSITORY, env=environment, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        )  # fmt: skip
        self._cluster: Dask | None = None
        self._scheduler = ""
        self._line()

    def __enter__(self) -> Runner:
        return self

    def __exit__(self, *_: object) -> None:
        if self._cluster is not None:
            self._cluster.end()
        self._server.communicate(timeout=PATIENCE)

    def _line(self) -> dict[str, float]:
        assert self._server.stdout is not None
        return json.loads(self._server.stdout.readline())

    def run(
        self, *arguments: str, folder: Path, limit: float = 600.0, processor: float | None = None
    ) -> Outcome:
        """Run a command in a folder, and kill it where it hangs, or at a moment of its work.

        Parameters
        ----------
        *arguments : str
            Words of the command.
        folder : Path
            Folder to run in.
        limit : float
            Time after which it is killed, which only ends a command that hangs [s].
        processor : float, optional
            Time on the processor at which it is killed [s], however long a busy machine takes for it.
        """
        files = {name: self.told / name for name in ("out", "err", "changes")}
        request = {"arguments": arguments, "folder": str(folder), "limit": limit, "processor": processor}
        request |= {name: str(path) for name, path in files.items()}
        assert self._server.stdin is not None
        print(json.dumps(request), file=self._server.stdin, flush=True)
        answer = self._line()
        out, err, changes = (
            path.read_text(encoding="utf-8", errors="surrogateescape") for path in files.values()
        )
        return Outcome(
            arguments, int(answer["status"]), bool(answer["ended"]), out, err, answer["seconds"],
            answer["processor"], int(answer["peak"]), tuple(dict.fromkeys(changes.splitlines())),
            int(answer["group"]),
        )  # fmt: skip

    def scheduler(self) -> str:
        """Address of a Dask scheduler whose worker lacks the package; both are started by the first call."""
        if self._cluster is None:
            self._of_cluster.mkdir()
            self._cluster = Dask(self._of_cluster)
            _, self._scheduler = self._cluster.scheduler()
            self._cluster.worker_without_package(self._scheduler)
        return self._scheduler

    def left_behind(self) -> list[str]:
        """Temporary files, and files of the home folder that are none of matplotlib's."""
        folders = (self.temporary, self.home)
        paths = [path for folder in folders for path in folder.rglob("*") if path.is_file()]
        return [str(path) for path in paths if "matplotlib" not in path.parts]


def workers_gone(group: int, patience: float = PATIENCE) -> bool:
    """Whether no process of a group comes to be left, after at most some seconds."""
    deadline = time.monotonic() + patience
    while time.monotonic() < deadline:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.02)
    return False
