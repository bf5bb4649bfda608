"""PDF of the paper on the software: python paper/build.py."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

HERE = Path(__file__).parent


def main() -> None:
    """Build paper/paper.pdf from paper.md and paper.bib."""
    import pypandoc
    import typst

    with TemporaryDirectory() as folder:
        source = Path(folder) / "paper.typ"
        pypandoc.convert_file(
            HERE / "paper.md",
            "typst",
            outputfile=source,
            extra_args=["--standalone", "--citeproc", f"--bibliography={HERE / 'paper.bib'}"],
        )
        typst.compile(source, output=HERE / "paper.pdf")


if __name__ == "__main__":
    main()
