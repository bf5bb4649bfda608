"""Texts of the commands: each belongs to a command or to one of its parameters."""

import inspect

from typer.testing import CliRunner

from ehlectric.commands.command_line import COMMANDS, app
from ehlectric.commands.options import TEXTS
from ehlectric.commands.start_commands import TEMPLATES


def test_every_text_is_that_of_a_command_or_a_parameter():
    assert set(TEXTS["commands"]) == set(COMMANDS)
    parameters = {name: set(inspect.signature(command).parameters) for name, command in COMMANDS.items()}
    for name, texts in TEXTS["commands"].items():
        own = set(texts.get("parameters", {}))
        assert own <= parameters[name]
        assert parameters[name] <= own | set(TEXTS["shared"])
    assert set(TEXTS["shared"]) <= set().union(*parameters.values())


def test_the_kinds_of_templates_are_those_that_init_takes():
    listed = CliRunner().invoke(app, ["init", "--help"], env={"COLUMNS": "200"}).stdout
    assert ", ".join(TEMPLATES) in " ".join(listed.split())
