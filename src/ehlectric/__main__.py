"""``python -m ehlectric`` is the ``ehlectric`` command."""

from ehlectric.cli import main

main()
