"""Renew the outputs in pages from the runs of their commands: python -m docs.renew, or with names of files.

The module docs.recipes describes the comments in the pages.
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from docs.pages import pages
from docs.recipes import Walk, recipes


def by_command(words: list[str]) -> subprocess.CompletedProcess[str]:
    """Run a command in a process of its own."""
    return subprocess.run(
        [sys.executable, "-m", "ehlectric", *words], capture_output=True, check=False, encoding="utf-8"
    )


def main(files: list[Path]) -> None:
    """Renew the pages that contain a block of output, all pages by default."""
    for file in files or pages():
        text = file.read_text("utf-8")
        if any(block.language == "text" for block in recipes(text)):
            walk = Walk(file.resolve(), by_command)
            with TemporaryDirectory() as folder:
                file.write_text(walk.walk(Path(folder)), "utf-8")
            sys.stderr.writelines(f"{file}:{fault}\n" for fault in walk.faults)


if __name__ == "__main__":
    main([Path(name) for name in sys.argv[1:]])
