"""README: its files exist."""

import re

from tests.helpers.places import ROOT

README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_the_links_of_the_readme_lead_somewhere():
    links = re.findall(r"\]\(([\w/.-]+)\)|src=\"([^\"]+)\"", README)
    assert len(links) > 10
    for link in links:
        assert (ROOT / "".join(link)).exists(), link
