"""Way of a file from ``ehlectric run`` to Newton's method: frames, reads, preparations and loaded modules.

``python -m benchmarks.run_chain examples/line_contact.toml`` runs the command in this process. It prints the
longest chain of functions of the package down to Newton's method, and the counts as JSON on the last line.
"""

from __future__ import annotations

import io
import json
import sys
import tempfile
from contextlib import redirect_stdout
from dataclasses import asdict, dataclass, field
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

SOURCE = str(Path(__file__).parents[1] / "src" / "ehlectric")

# Functions that are counted, each with the end of the path of its module.
NEWTON = ("film/newton.py", "newton")
PREPARE = ("contact/preparation.py", "prepare")
PARSE = ("cases/table.py", "tables_of_text")


@dataclass
class Counts:
    """Counts of one run."""

    file: Path
    chain: list[str] = field(default_factory=list)  # longest chain of functions down to Newton's method
    opened: int = 0  # number of times that the file is opened
    parsed: int = 0  # number of times that its text is parsed
    prepared: int = 0  # number of times that the contact is prepared

    def __post_init__(self) -> None:
        self._text = self.file.read_text(encoding="utf-8")

    def audit(self, event: str, arguments: tuple[Any, ...]) -> None:
        """Count an opening of the file; a hook of ``sys.addaudithook``."""
        if event == "open" and isinstance(arguments[0], str | Path):
            path = Path(arguments[0])
            self.opened += path.name == self.file.name and path.samefile(self.file)

    def profile(self, frame: FrameType, event: str, _: object) -> None:
        """Count a call; a function of ``sys.setprofile``."""
        if event != "call":
            return
        code = frame.f_code
        if _is(code, NEWTON):
            self.chain = max(self.chain, _functions(frame), key=len)
        elif _is(code, PREPARE):
            self.prepared += 1
        elif _is(code, PARSE):
            self.parsed += next(iter(frame.f_locals.values())) == self._text


def _is(code: CodeType, function: tuple[str, str]) -> bool:
    module, name = function
    return code.co_name == name and code.co_filename.endswith(module)


def _functions(frame: FrameType | None) -> list[str]:
    """Functions of the package from the outermost frame to this one."""
    names = []
    while frame is not None:
        code = frame.f_code
        if code.co_filename.startswith(SOURCE):
            module = Path(code.co_filename).relative_to(SOURCE).with_suffix("")
            names.append(f"{'.'.join(module.parts)}.{code.co_qualname}")
        frame = frame.f_back
    return names[::-1]


def counts_of(file: Path, *options: str) -> dict[str, Any]:
    """Counts of ``ehlectric run FILE`` in this process, which must not have loaded the package before."""
    counts = Counts(file)
    with tempfile.TemporaryDirectory() as folder, redirect_stdout(io.TextIOWrapper(io.BytesIO())):
        sys.argv = ["ehlectric", "run", str(file), "--output", folder, *options]
        from ehlectric.__main__ import main

        sys.addaudithook(counts.audit)
        sys.setprofile(counts.profile)
        try:
            main()
        except SystemExit as ended:
            status = ended.code
        finally:
            sys.setprofile(None)
    modules = sorted(name for name in sys.modules if name.partition(".")[0] == "ehlectric")
    numbers = {key: value for key, value in asdict(counts).items() if key != "file"}
    return {"status": status, "frames": len(counts.chain), **numbers, "modules": modules}


if __name__ == "__main__":
    found = counts_of(Path(sys.argv[1]), *sys.argv[2:])
    print("\n".join(found["chain"]), f"{len(found['modules'])} modules", json.dumps(found), sep="\n")
