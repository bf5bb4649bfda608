"""``python -m ehlectric`` is the ``ehlectric`` command."""

from ehlectric.commands.app import main

main()
