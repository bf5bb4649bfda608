"""Files of the examples, in an installed package or in the repository, and the schemas of the package."""

from __future__ import annotations

from pathlib import Path

from ehlectric.errors import InputError

_HERE = Path(__file__).parent


def examples_folder() -> Path:
    """Folder of the examples: in an installed package beside this module, else that of the repository.

    Raises
    ------
    InputError
        If neither exists, as in a package that was copied without its data.
    """
    for folder in (_HERE / "examples", *(parent / "examples" for parent in _HERE.parents[2:3])):
        if (folder / "line_contact.toml").is_file():
            return folder
    raise InputError("examples", "are not part of this installation", takes="one by pip, or the repository")


def example_text(name: str) -> str:
    """Text of an example by its name, such as "bearing_6208".

    Raises
    ------
    InputError
        If the examples are not part of this installation.
    """
    return (examples_folder() / f"{name}.toml").read_text(encoding="utf-8")


def schemas_folder() -> Path:
    """Folder of the JSON Schemas of case, bearing, drive and sweep files, which is part of the package."""
    return _HERE / "schemas"
