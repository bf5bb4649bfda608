"""Parameters of the commands, with their texts of ``command_texts.toml``, and their completion by a shell."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, TypeAlias, TypedDict, TypeVar, get_type_hints

import typer

from ehlectric.errors import InputError, shown
from ehlectric.quantities.quantity import data_file


def files_ending(*suffixes: str) -> Callable[[str], list[str]]:
    """Function that completes the name of a file with one of some suffixes, or of a folder on the way."""

    def complete(incomplete: str) -> list[str]:
        folder, slash, begun = incomplete.rpartition("/")
        start = folder + slash
        try:
            entries = sorted(Path(start or ".").iterdir())
        except OSError:
            return []
        matching = [entry for entry in entries if entry.name.startswith(begun)]
        if not begun:
            matching = [entry for entry in matching if not entry.name.startswith(".")]
        folders = [f"{start}{entry.name}/" for entry in matching if entry.is_dir()]
        return [f"{start}{entry.name}" for entry in matching if entry.suffix in suffixes] + folders

    return complete


def names_from(*names: str) -> Callable[[str], list[str]]:
    """Function that completes one of some names."""
    return lambda incomplete: [name for name in names if name.startswith(incomplete)]


def chosen(option: str, value: str, names: Sequence[str]) -> str:
    """Value of an option that takes one of some names. Raises InputError if it is none of them."""
    if value not in names:
        raise InputError(option, got=shown(value), takes=f"one of {', '.join(names)}")
    return value


# Values of a parameter: all of them, or a function that lists those that complete what was typed.
Values: TypeAlias = Sequence[str] | Callable[..., list[str]]

_Command = TypeVar("_Command", bound=Callable[..., None])

# Texts of all commands and of their parameters, and the functions of the commands.
TEXTS = data_file("ehlectric.commands", "command_texts.toml")
COMMANDS: dict[str, Callable[..., None]] = {}


def command(name: str, /, **values: Values) -> Callable[[_Command], _Command]:
    """Decorator of a command, whose parameters get their texts.

    ``values`` has the values of some parameters, or a function that completes them, where they are no texts
    of the file. In a help text, {values} stands for all of them.
    """
    texts = {**TEXTS["shared"], **TEXTS["commands"][name].get("parameters", {})}

    def described(function: _Command) -> _Command:
        function.__annotations__ = {
            key: Annotated[kind, _parameter(texts[key], values.get(key))]
            for key, kind in get_type_hints(function).items()
            if key != "return"
        }
        COMMANDS[name] = function
        return function

    return described


def _parameter(texts: Mapping[str, Any], values: Values | None) -> typer.models.ParameterInfo:
    """Argument or option with its texts, whose ``values`` a shell completes."""
    options = dict(texts)
    kind = typer.Argument if options.pop("argument", False) else typer.Option
    names = options.pop("names", ())
    values = options.pop("values", values)
    if "files" in options:
        values = files_ending(*options.pop("files"))
    elif values is not None and not callable(values):
        options["help"] = options["help"].replace("{values}", ", ".join(values))
        values = names_from(*values)
    made: typer.models.ParameterInfo = kind(*names, autocompletion=values, **options)
    return made


class Look(TypedDict):
    """Formats and style of figures, as functions that draw take them."""

    formats: tuple[str, ...]
    style: str


def figure_options(formats: Sequence[str] | None, style: str) -> Look:
    """Formats and style of figures, from the options of a command. Raises InputError if there is no such
    format or style.
    """
    from ehlectric.figures.figure_names import FORMATS, STYLES

    checked = tuple(chosen("--format", name, FORMATS) for name in formats or ("png",))
    return Look(formats=checked, style=chosen("--style", style, STYLES))
