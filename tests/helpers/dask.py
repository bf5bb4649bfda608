"""Clusters of Dask for tests: a scheduler and its workers, each started by its own command."""

import json
import os
import subprocess
import sys

from tests.helpers.processes import PATIENCE, wait_until


class Dask:
    """Processes of a cluster, with their logs in a folder; as a context it ends with all of them."""

    def __init__(self, folder):
        self.folder, self._processes = folder, []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def end(self):
        """End all processes."""
        for process in reversed(self._processes):
            process.terminate()
            process.wait(timeout=PATIENCE)

    def _start(self, what, *options, **environment):
        arguments = [sys.executable, "-m", f"distributed.cli.dask_{what}", "--no-dashboard", *options]
        taken = os.environ | environment
        with (self.folder / f"{what}.log").open("w") as log:
            process = subprocess.Popen(arguments, cwd=self.folder, env=taken, stdout=log, stderr=log)
        self._processes.append(process)
        return process

    def scheduler(self):
        """Start a scheduler without workers; its process and its address."""
        file = self.folder / "scheduler.json"
        process = self._start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--scheduler-file", str(file)
        )
        # The scheduler writes the file while it is looked for.
        assert wait_until(lambda: file.exists() and "}" in file.read_text())
        return process, json.loads(file.read_text())["address"]

    def worker(self, address, **environment):
        """Start a worker of a scheduler, and wait until both answer."""
        from distributed import Client

        self._start(
            "worker", address, "--nthreads", "1", "--local-directory", str(self.folder), **environment
        )
        # The scheduler answers in the time that a sweep waits for it once it has answered before.
        with Client(address, timeout=PATIENCE, set_as_default=False) as client:
            client.wait_for_workers(1, timeout=PATIENCE)

    def worker_without_package(self, address):
        """Start a worker on a machine that lacks the package, as far as it knows."""
        packages = self.folder / "packages"
        packages.mkdir()
        (packages / "ehlectric.py").write_text("raise ImportError('not on this machine')\n")
        self.worker(address, PYTHONPATH=str(packages))
