"""Session of a tab: its inputs over time, its temporary folder, and its work. All end with the tab."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from ehlectric.app.answers.call import Call
from ehlectric.app.inputs import History, Inputs
from ehlectric.app.work import Job, Work
from ehlectric.errors import LostError


class Session:
    """Session of one tab.

    Parameters
    ----------
    work : Work
        Work of the server.
    inputs : Inputs
        First inputs.

    Attributes
    ----------
    work : Share
        Share of the session in the work.
    history : History
        Inputs over time.
    """

    def __init__(self, work: Work, inputs: Inputs) -> None:
        self.work = work.share()
        self.history = History(inputs)
        self._server = work
        self._folder: Path | None = None
        self._closed = False

    @property
    def inputs(self) -> Inputs:
        """Present inputs."""
        return self.history.now

    @property
    def folder(self) -> Path:
        """Temporary folder of the session, which only this user can read; made when first used.

        Raises
        ------
        LostError
            If the session has ended: nobody would remove a folder that is made after that.
        """
        if self._closed:
            raise LostError("the page was closed")
        if self._folder is None:
            self._folder = self._server.scratch.new()
        return self._folder

    @property
    def made_folder(self) -> Path | None:
        """Temporary folder of the session; None where it has none yet, and so no uploaded files."""
        return self._folder

    def start(self, function: Call[Any], *values: Any) -> Job:
        """Start a job that ends with the session."""
        return self.work.start(function, *values)

    def close(self) -> None:
        """End the jobs, and remove the folder."""
        self._closed = True
        self.work.close()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None
