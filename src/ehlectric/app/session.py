"""Session of a tab: its inputs over time, uploaded files, and its work.

Inputs name an uploaded file relative to the folder of the session, as a case names one relative to its own
folder; a download with case and files is then complete. The content of a file goes to the readers of
``ehlectric surface`` and to nothing else.
"""

from __future__ import annotations

import os
import re
import shutil
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from starlette.formparsers import MultiPartParser

from ehlectric.app.page_inputs import History, Inputs
from ehlectric.app.work import Work
from ehlectric.errors import InputError, LostError, printable
from ehlectric.readable import readable

if TYPE_CHECKING:
    from nicegui.elements.upload_files import FileUpload

# Largest size of an uploaded file, and of a request with its envelope [bytes].
LARGEST = 60_000_000
_LARGEST_REQUEST = LARGEST + 100_000

# Largest size of all uploaded files of a session [bytes].
MOST_TOGETHER = 4 * LARGEST

# Folder of uploaded surfaces in the folder of a session.
SURFACES = "surfaces"

# Endings that a file dialogue offers first; what a file is, its content decides.
ENDINGS = (".csv", ".txt", ".asc", ".dat", ".hfm", ".x3p", ".al3d")

# Longest name that is shown.
_LONGEST_NAME = 80


def shown_name(given: str) -> str:
    r"""Name of a file as a page shows it: without folders and characters that cannot be seen.

    Examples
    --------
    >>> shown_name("../../etc/passwd"), shown_name("C:\\data\\a b.csv"), shown_name("")
    ('passwd', 'a b.csv', 'unnamed')
    """
    name = printable(re.split(r"[/\\]", given)[-1]).strip()
    return name[-_LONGEST_NAME:] or "unnamed"


def stored_name(given: str, number: int) -> str:
    """Name under which an uploaded file is kept; only its ending is the user's, as readers look at it.

    Examples
    --------
    >>> stored_name("../../etc/Scan.X3P", 1), stored_name("a.csv/../../b", 2), stored_name("a.b c", 3)
    ('surface-1.x3p', 'surface-2.dat', 'surface-3.dat')
    """
    ending = re.search(r"\.[A-Za-z0-9]{1,8}\Z", shown_name(given))
    return f"surface-{number}{ending.group().lower() if ending else '.dat'}"


def new_file(given: str, folder: Path) -> str:
    """Make an empty file for an upload; its name is relative to the folder of its session.

    The file is there before its content, so that uploads at the same time have different names. The numbers
    of files go on, so that inputs that were undone keep theirs.
    """
    place = folder / SURFACES
    place.mkdir(exist_ok=True)
    taken = {path.stem for path in place.iterdir()}
    number = next(number for number in count(1) if f"surface-{number}" not in taken)
    name = stored_name(given, number)
    (place / name).touch(exist_ok=False)
    return f"{SURFACES}/{name}"


def session_file(name: str, folder: Path) -> Path | None:
    """Path of a file of the folder of a session; None where it is not there, or lies elsewhere.

    The name is judged before the file system is asked, and again where its links lead.
    """
    if "\0" in name:
        return None
    roots = (os.path.abspath(folder), os.path.realpath(folder))  # noqa: PTH100
    if not any(Path(os.path.normpath(Path(root, name))).is_relative_to(root) for root in roots):
        return None
    path = Path(os.path.realpath(Path(roots[1], name)))
    return path if path.is_relative_to(roots[1]) and path.is_file() else None


def keep_in_memory() -> None:
    """Keep uploads in memory until a page writes them into the folder of its session.

    Otherwise the reader of forms writes large ones into the system's folder of temporary files.
    """
    MultiPartParser.spool_max_size = _LARGEST_REQUEST


class Session:
    """Session of one tab."""

    def __init__(self, work: Work, inputs: Inputs) -> None:
        self.work = work.share()
        self.history = History(inputs)
        self._server = work
        self._folder: Path | None = None
        self._closed = False
        # Names that users gave to uploaded files, and sizes of files that are being stored [bytes], by path.
        self._names: dict[str, str] = {}
        self._coming: dict[str, int] = {}

    @property
    def inputs(self) -> Inputs:
        """Present inputs."""
        return self.history.now

    @property
    def made_folder(self) -> Path | None:
        """Temporary folder of the session; None if no file was uploaded."""
        return self._folder if self._folder is not None and (self._folder / SURFACES).is_dir() else None

    @property
    def folder(self) -> Path:
        """Temporary folder of the session, which only this user can read; made when first used.

        It is a LostError to use it after the session has ended: nobody would remove the folder.
        """
        if self._closed:
            raise LostError("the page was closed")
        if self._folder is None:
            self._folder = self._server.scratch.new()
        return self._folder

    def path_of(self, file: str) -> Path | None:
        """Path of an uploaded file of this session; None where it has none of this name."""
        return None if self._folder is None else session_file(file, self._folder)

    def name_of(self, file: str) -> str:
        """Name of a file as its user knows it."""
        return self._names.get(file, shown_name(file))

    def named(self, text: str) -> str:
        """Text with the names that users know instead of paths of uploaded files.

        Errors name a file by its path, warnings without the folders of the machine.
        """
        if not self._names or self._folder is None:
            return text
        names = {Path(file).name: name for file, name in self._names.items()}
        roots = "|".join(re.escape(f"{root}{os.sep}") for root in (self._folder, self._folder.resolve()))
        stored = "|".join(map(re.escape, names))
        pattern = rf"(?<![\w./\\-])(?:(?:{roots})?{SURFACES}[/\\])?({stored})(?![\w-])"
        return re.sub(pattern, lambda match: names[match[1]], text)

    def named_error(self, error: Exception) -> Exception:
        """Error in which paths of uploaded files are the names that their users know."""
        if self.named(str(error)) == str(error):
            return error
        if isinstance(error, InputError):
            return error.with_text(error.key and self.named(error.key), self.named(error.text))
        return LostError(self.named(str(error))) if isinstance(error, LostError) else error

    async def store(self, file: FileUpload, most: int = LARGEST) -> str:
        """Store an uploaded file of at most a size [bytes], and return its name relative to the folder of the
        session.

        Raises InputError if it is too large or cannot be stored, and LostError if the session has ended.
        """
        size, given, folder = file.size(), shown_name(file.name), self.folder
        self._refuse_too_much(given, size, most)
        name = new_file(file.name, folder)
        self._coming[name] = size
        try:
            await file.save(folder / name)
        except OSError:
            (folder / name).unlink(missing_ok=True)
            raise InputError.worded(None, f"{given}: could not be stored; try again") from None
        finally:
            del self._coming[name]
        if self._closed:
            shutil.rmtree(folder, ignore_errors=True)
            raise LostError("the page was closed")
        self._names[name] = given
        return name

    def add(self, given: str, content: bytes) -> str:
        """Store a file of the program as if it had been uploaded, and return its name relative to the folder.

        Raises InputError if the session has no room for it.
        """
        self._refuse_too_much(given, len(content))
        name = new_file(given, self.folder)
        (self.folder / name).write_bytes(content)
        self._names[name] = given
        return name

    def _refuse_too_much(self, given: str, size: int, most: int = LARGEST) -> None:
        """Raise InputError for a file that is larger than ``most`` [bytes], or too large together with the
        files of the session.
        """
        kept = sum(
            max(path.stat().st_size, self._coming.get(f"{SURFACES}/{path.name}", 0))
            for path in self.folder.glob(f"{SURFACES}/*")
        )
        if size > most or kept + size > MOST_TOGETHER:
            limits = f"at most {most / 1e6:g} MB, and {MOST_TOGETHER / 1e6:g} MB of all uploaded files"
            raise InputError.worded(None, f"{given}: has {readable(size / 1e6, 4)} MB; expected {limits}")

    def close(self) -> None:
        """End the jobs, and remove the folder."""
        self._closed = True
        self.work.close()
        if self._folder is not None:
            shutil.rmtree(self._folder, ignore_errors=True)
            self._folder = None
