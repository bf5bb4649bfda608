"""What a page gives, and what the command says of it: downloads, links, and runs of the downloaded case."""

import json

from ehlectric.app.page_inputs import Inputs
from tests.helpers.commands import run_command
from tests.helpers.processes import PATIENCE, wait_until

# Options with which the command prints its numbers and draws nothing.
NUMBERS = ("--json", "--no-plots", "-o", "out")


def address_of(path, table):
    """Address of a page with the tables of an input file."""
    return f"{path}?{Inputs(table).address()}"


def downloaded(page, test_id, folder):
    """Path of the file that a button of a page downloads, in a folder."""
    with page.expect_download(timeout=1e3 * PATIENCE) as info:
        page.get_by_test_id(test_id).click()
    path = folder / info.value.suggested_filename
    info.value.save_as(path)
    return path


def command(*words, folder, status=0):
    """Output and errors of the command, which ends with a status."""
    done = run_command(*words, cwd=folder)
    assert done.returncode == status, done.stderr
    return done.stdout, done.stderr


def summary_by_command(kind, path, folder, *options):
    """Numbers that the command prints for a file; ``kind`` is bearing or run."""
    output, _ = command(kind, path, *options, *NUMBERS, folder=folder)
    return json.loads(output)


def bearing_by_command(page, folder, contacts="atlas"):
    """Numbers of the command for the case that the bearing page downloads now."""
    folder.mkdir(exist_ok=True)
    path = downloaded(page, "download-toml", folder)
    return summary_by_command("bearing", path, folder, "--contacts", contacts)


def overflow(page):
    """Width by which a page is wider than its window [px]."""
    return page.evaluate("document.documentElement.scrollWidth - document.documentElement.clientWidth")


def fits(page):
    """Whether a page comes to be no wider than its window; figures follow it in their own time."""
    return wait_until(lambda: overflow(page) <= 0)
