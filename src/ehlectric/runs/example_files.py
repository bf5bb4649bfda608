"""Files of the examples, in an installed package or in the repository."""

from __future__ import annotations

from difflib import get_close_matches
from pathlib import Path

from ehlectric.errors import InputError, shown

_HERE = Path(__file__).parent


def examples_folder() -> Path:
    """Folder of the examples: in an installed package next to this module, else in the repository. Raises
    InputError if neither exists, as in a package that was copied without its data.
    """
    for folder in (_HERE / "examples", *(parent / "examples" for parent in _HERE.parents[2:3])):
        if (folder / "line_contact.toml").is_file():
            return folder
    raise InputError("examples", "are not part of this installation", takes="one by pip, or the repository")


def example(name: str) -> Path:
    """Return the path of an example that comes with ehlectric, or of a surface or measurement that it needs.

    Parameters
    ----------
    name : str
        Name of an example as ``ehlectric examples`` lists it, such as "bearing_6208", or of a file that one
        needs, such as "surfaces/dektak-1.csv".

    Returns
    -------
    Path
        The file, which belongs to the package: copy it before you change it.

    Raises
    ------
    InputError
        If there is no such example, or the examples are not part of this installation.

    Examples
    --------
    >>> example("line_contact").name
    'line_contact.toml'
    >>> example("bearing_620")
    Traceback (most recent call last):
    ehlectric.errors.InputError: example: got 'bearing_620'; expected an example or a file that one needs, as
    'bearing_6208'
    """
    folder, name = examples_folder(), str(name)
    files = [path.relative_to(folder).as_posix() for path in folder.rglob("*.*") if path.suffix != ".md"]
    file_name = name if name in files else f"{name}.toml"
    if file_name not in files:
        (near,) = get_close_matches(name, [file.removesuffix(".toml") for file in files], n=1, cutoff=0.0)
        takes = f"an example or a file that one needs, as {near!r}"
        raise InputError("example", got=shown(name), takes=takes)
    return folder / file_name


def example_text(name: str) -> str:
    """Text of an example by its name, such as "bearing_6208". Raises InputError if the examples are not part
    of this installation.
    """
    return (examples_folder() / f"{name}.toml").read_text(encoding="utf-8")
