"""Count constructions that make the texts of this repository hard to read, and reject a count that rises.

`make lint` runs `python -m tools.lint_prose`. The allowed counts, for each rule and each group of texts, are
in tools/prose_counts.toml. If a count is higher, the exit status is 1.

`python -m tools.lint_prose C5` lists all places of a rule. `--renew` lowers the allowed counts to the counts
of the texts, and raises none. `--table` prints the counts, and the lengths of pages and sentences.
"""

import argparse
import ast
import io
import re
import subprocess
import sys
import tokenize
import tomllib
from collections import Counter
from collections.abc import Callable, Iterator
from functools import cached_property
from pathlib import Path
from typing import Any, NamedTuple

from docs.pages import written_pages

from tools.term_links import Glossary, links_terms, unlinked

ROOT = Path(__file__).parents[1]
COUNTS = Path("tools/prose_counts.toml")
PACKAGE = "src/ehlectric"
QUANTITIES = f"{PACKAGE}/quantities"

MOST_WORDS_OF_A_PAGE = 2500
MOST_WORDS_OF_A_SENTENCE = 35
MOST_WORDS_OF_A_WARNING = 40
MOST_WORDS_OF_A_MEANING = 30  # of a result
MOST_OF = 3  # times the word "of" in a sentence

TEXT_FILES = (
    "report_texts.toml",
    "page_texts.toml",
    "command_texts.toml",
    "parameters.toml",
    "netlist_texts.toml",
)
# Files and folders of texts.
FILES = ("README", "CHANGELOG", "CONTRIBUTING", "SECURITY")
FOLDERS = ("changes", "open_benchmark")
# Directives whose body is prose.
PROSE_DIRECTIVES = ("figure", "image", "glossary", "note", "warning", "tip", "admonition")

IMPERATIVES = (
    "accept add allow ask assume average avoid begin calculate change check choose close compare complete "
    "compute confirm consider convert correct decrease delete describe divide do double enlarge ensure "
    "enter estimate exclude expect extend find free get give halve ignore import improve include increase "
    "install judge keep leave let limit look lower make mark measure move multiply name narrow note omit "
    "open pass pick prefer provide put raise read reduce refer refine remove rename repair repeat replace "
    "report request round run save scale see select send set shift shorten smooth solve specify split "
    "start state stop subtract switch take treat trust try turn type use verify wait widen write"
)
ACTION = re.compile(
    rf"(?i)(?:^|[.:;,]\s+|\b(?:and|or|then)\s+)(?:{'|'.join(IMPERATIVES.split())})\b"
    r"|no action is needed|\{advice\}"
)
# First words of a meaning that does not begin with its quantity.
NO_QUANTITY = re.compile(
    r"(?:of|at|in|on|above|below|where|how|what|when|whether|which|absolute|as|both|if|for|from|by|with|that"
    r"|those|it|its|given|used|computed|taken|solved|made|neglected|holds|makes|takes|gives|sets|needs|uses)\b"
)


class Line(NamedTuple):
    """A line of prose: file relative to the root, number of the line, and text without code and formulas."""

    file: str
    line: int
    text: str


class Place(NamedTuple):
    """A place that a rule counts: the group of texts, the file, the line and the words."""

    texts: str
    file: str
    line: int
    words: str


class Texts:
    """Read the texts of a repository in groups.

    The groups are README, CHANGELOG, CONTRIBUTING, SECURITY, changes, open_benchmark, docs, docstrings,
    comments, strings, which are texts in the code, and data, the data files.
    """

    def __init__(self, root: Path) -> None:
        self.root = root

    def _name(self, file: Path) -> str:
        return file.relative_to(self.root).as_posix()

    @cached_property
    def pages(self) -> list[Path]:
        """Return the pages of the documentation that are written by hand."""
        return written_pages(self.root / "docs")

    @cached_property
    def groups(self) -> dict[str, list[Line]]:
        """Return the lines of prose of each group of texts."""
        pages = {name: [self.root / f"{name}.md"] for name in FILES}
        pages |= {name: sorted((self.root / name).rglob("*.md")) for name in FOLDERS}
        pages["docs"] = self.pages
        groups = {
            name: [line for file in files for line in self._markdown(file)] for name, files in pages.items()
        }
        groups["docstrings"] = [
            line for docstring in self.docstrings for line in _lines_of_docstring(docstring)
        ]
        groups["comments"] = [line for name, text in self._modules for line in _comments(name, text)]
        groups["strings"] = [line for name, text in self._modules for line in _strings(name, text)]
        groups["data"] = [line for file in self._data_files() for line in self._data(file)]
        return groups

    def _data_files(self) -> list[Path]:
        files = sorted((self.root / "src").rglob("*.toml"))
        return [
            file for file in files if {"quantities", "templates"} & {*file.parts} or file.name in TEXT_FILES
        ]

    def _markdown(self, file: Path) -> Iterator[Line]:
        if file.exists():
            lines = file.read_text(encoding="utf-8").splitlines()
            yield from (
                Line(self._name(file), number, _clean(line)) for number, line in _prose_of_markdown(lines)
            )

    def _data(self, file: Path) -> Iterator[Line]:
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            for text in _texts_of_data(line):
                yield Line(self._name(file), number, text)

    def entries(self, name: str) -> dict[str, Any]:
        """Return the tables of a data file of the package, none if there is no such file."""
        file = self.root / name
        return tomllib.loads(file.read_text(encoding="utf-8")) if file.exists() else {}

    def line_of(self, name: str, words: str) -> int:
        """Return the first line of a file that contains the words, or 1."""
        lines = (self.root / name).read_text(encoding="utf-8").splitlines()
        return next((number for number, line in enumerate(lines, 1) if words in line), 1)

    @cached_property
    def _modules(self) -> list[tuple[str, str]]:
        files = sorted((self.root / "src").rglob("*.py"))
        return [(self._name(file), file.read_text(encoding="utf-8")) for file in files]

    @cached_property
    def docstrings(self) -> list[Line]:
        """Return the docstrings as they are, with the number of their first line."""
        return [Line(name, line, words) for name, text in self._modules for line, words in _docstrings(text)]


def _prose_of_markdown(lines: list[str]) -> Iterator[tuple[int, str]]:
    """Yield numbers and lines of prose: no code, no output and no displayed formulas."""
    fence, prose, formula = "", False, False
    for number, line in enumerate(lines, 1):
        text = line.strip()
        mark = re.match(r"(`{3,}|:{3,}|~{3,})(.*)", text)
        if fence and text.startswith(fence) and {*text} <= {fence[0]}:
            fence = ""
        elif fence:
            yield from ((number, part) for part in [_text_in_directive(line)] if prose and part)
        elif mark:
            fence = mark[1] if mark[1][0] == "`" else ""
            prose = mark[2].strip().startswith("{") and any(name in mark[2] for name in PROSE_DIRECTIVES)
        elif text.startswith("$$"):
            formula = formula != (not re.match(r"\$\$.*\$\$", text))
        elif not formula:
            yield number, line


def _text_in_directive(line: str) -> str:
    """Return the prose in a line of a directive: of its options only the description of a figure."""
    text = line.strip()
    return text.removeprefix(":alt:") if text.startswith(":alt:") or not text.startswith(":") else ""


def _clean(line: str) -> str:
    """Return a line of Markdown with formulas as X, code as K and links as their text."""
    line = re.sub(r"\$[^$]*\$", "X", line)
    line = re.sub(r"`[^`]*`", "K", line)
    line = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", line)
    return re.sub(r"<[^>]+>", "", re.sub(r"\{[a-z:]+\}", "", line))


def _definitions(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a module with its classes and functions, however deep; expressions contain none."""
    if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
        yield node
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.stmt | ast.ExceptHandler | ast.match_case):
            yield from _definitions(child)


def _docstrings(text: str) -> Iterator[tuple[int, str]]:
    """Yield first line and text of each docstring of a module."""
    for node in _definitions(ast.parse(text)):
        first = node.body[0] if node.body else None  # type: ignore[attr-defined]
        constant = first.value if isinstance(first, ast.Expr) else None
        if isinstance(constant, ast.Constant) and isinstance(constant.value, str):
            yield constant.lineno, constant.value


def _lines_of_docstring(docstring: Line) -> Iterator[Line]:
    for number, line in enumerate(docstring.text.splitlines(), docstring.line):
        if not line.strip().startswith((">>>", "...")):
            yield Line(docstring.file, number, re.sub(r"``[^`]*``", "K", line))


def _comments(name: str, text: str) -> Iterator[Line]:
    if "#" in text:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            if token.type == tokenize.COMMENT:
                yield Line(name, token.start[0], token.string[1:])


def _strings(name: str, text: str) -> Iterator[Line]:
    """Yield the texts in the code of a module: strings of three words or more that are no docstrings.

    Parts of one text follow each other in one string; attributes of HTML are no words.
    """
    tree = ast.parse(text)
    docstrings = {node.value for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and node not in docstrings:
            words = re.sub(r"<[^>]*>?|[\w-]+=[\"\'][^\"\']*[\"\']", "", node.value)
            if len(re.findall(r"[A-Za-z]{2,}", words)) > 2:
                yield Line(name, node.lineno, re.sub(r"``?[^`]*``?", "K", words))


def _texts_of_data(line: str) -> Iterator[str]:
    """Yield the texts of a line of TOML: strings, lines of longer strings, and comments."""
    for text in re.finditer(r'"((?:[^"\\]|\\.){20,})"|\'([^\']{20,})\'', line):
        yield _clean(text[1] or text[2])
    if re.match(r"\s{4}\S", line) and "=" not in line[:12] and not line.strip().startswith(('"', "[", "{")):
        yield _clean(line)
    comment = line.partition("#")[2]
    if len(comment) > 15 and '"' not in comment[:3]:
        yield comment


class Sentence(NamedTuple):
    """A sentence of a page with its file and the line where it begins."""

    file: str
    line: int
    text: str


def _sentences(lines: list[Line]) -> Iterator[Sentence]:
    """Yield the sentences of pages. A paragraph, an item of a list and a cell of a table end a sentence."""
    for block in _blocks(lines):
        words = [(line, word) for line in block for word in line.text.split()]
        start = 0
        for index, (_, word) in enumerate(words):
            following = words[index + 1][1] if index + 1 < len(words) else ""
            if not following or (
                re.search(r"[.!?][)*\"]*$", word) and re.match(r"[(*\"\[]*[A-Z]", following)
            ):
                first = words[start][0]
                yield Sentence(first.file, first.line, " ".join(text for _, text in words[start : index + 1]))
                start = index + 1


def _blocks(lines: list[Line]) -> Iterator[list[Line]]:
    """Yield paragraphs, items of lists and cells of tables, without headings."""
    block: list[Line] = []
    for line in lines:
        text = line.text.strip()
        begins = bool(re.match(r"#|\||[-*+] |\d+\. |:|\Z", text))
        if block and (begins or line.file != block[-1].file or line.line != block[-1].line + 1):
            yield block
            block = []
        if text.startswith("|"):
            yield from ([Line(line.file, line.line, cell)] for cell in text.split("|"))
        elif text and not text.startswith("#"):
            block.append(line)
    if block:
        yield block


Places = Callable[[Texts], Iterator[Place]]


def _matches(pattern: str) -> Places:
    """Return the function that yields the places of a pattern in all groups of texts."""
    compiled = re.compile(pattern)

    def places(texts: Texts) -> Iterator[Place]:
        for group, lines in texts.groups.items():
            for line in lines:
                for match in compiled.finditer(line.text):
                    words = line.text[max(0, match.start() - 50) : match.end() + 50]
                    yield Place(group, line.file, line.line, words.strip())

    return places


def _warnings(texts: Texts) -> Iterator[tuple[str, str]]:
    """Yield code and text of each situation of each warning."""
    for code, entry in texts.entries(f"{QUANTITIES}/warning_texts.toml").items():
        for situation, text in entry.items():
            if situation != "explanation":
                yield code, text


def warnings_without_an_action(texts: Texts) -> Iterator[Place]:
    """Yield warnings whose text contains no imperative."""
    name = f"{QUANTITIES}/warning_texts.toml"
    for code, text in _warnings(texts):
        if not ACTION.search(text):
            yield Place("data", name, texts.line_of(name, code), f"{code}: {text}")


def long_warnings(texts: Texts) -> Iterator[Place]:
    """Yield warnings with too many words."""
    name = f"{QUANTITIES}/warning_texts.toml"
    for code, text in _warnings(texts):
        if len(text.split()) > MOST_WORDS_OF_A_WARNING:
            yield Place("data", name, texts.line_of(name, code), f"{code}: {len(text.split())} words")


def _meanings(texts: Texts, names: list[str]) -> Iterator[tuple[str, str, str]]:
    """Yield file, key and meaning of each quantity of the files."""

    def leaves(key: str, entry: Any) -> Iterator[tuple[str, str]]:
        if isinstance(entry, dict):
            if isinstance(entry.get("meaning"), str):
                yield key, entry["meaning"]
            for name, inner in entry.items():
                yield from leaves(f"{key}.{name}".lstrip("."), inner)

    for name in names:
        yield from ((name, *pair) for pair in leaves("", texts.entries(name)))


def meanings_without_the_quantity(texts: Texts) -> Iterator[Place]:
    """Yield meanings of inputs that do not begin with the quantity."""
    names = [f"{QUANTITIES}/inputs.toml", f"{PACKAGE}/lubricant/parameters.toml"]
    for name, key, text in _meanings(texts, names):
        if NO_QUANTITY.match(text):
            yield Place("data", name, texts.line_of(name, text.splitlines()[0][:40]), f"{key}: {text[:80]}")


def long_meanings(texts: Texts) -> Iterator[Place]:
    """Yield meanings of results with too many words."""
    folder = texts.root / QUANTITIES
    names = [f"{QUANTITIES}/{file.name}" for file in sorted(folder.glob("*_results.toml"))]
    for name, key, text in _meanings(texts, names):
        if len(text.split()) > MOST_WORDS_OF_A_MEANING:
            line = texts.line_of(name, text.splitlines()[0][:40])
            yield Place("data", name, line, f"{key}: {len(text.split())} words")


def long_sentences(texts: Texts) -> Iterator[Place]:
    """Yield sentences of pages with too many words."""
    for group in (*FILES, *FOLDERS, "docs"):
        for sentence in _sentences(texts.groups[group]):
            count = len(sentence.text.split())
            if count > MOST_WORDS_OF_A_SENTENCE:
                yield Place(group, sentence.file, sentence.line, f"{count} words: {sentence.text[:80]} ...")


def rows_of_of(texts: Texts) -> Iterator[Place]:
    """Yield sentences of pages, and first sentences of docstrings, with the word "of" too often."""
    for group in (*FILES, *FOLDERS, "docs"):
        for sentence in _sentences(texts.groups[group]):
            if len(re.findall(r"\bof\b", sentence.text)) > MOST_OF:
                yield Place(group, *sentence)
    for docstring in texts.docstrings:
        summary = re.split(r"\n\s*\n|\.\s", docstring.text, maxsplit=1)[0]
        if len(re.findall(r"\bof\b", summary)) > MOST_OF:
            yield Place("docstrings", docstring.file, docstring.line, " ".join(summary.split()))


def words_of_page(file: Path) -> int:
    """Return the number of words of a page, with its code and tables."""
    return len(file.read_text(encoding="utf-8").split())


def long_pages(texts: Texts) -> Iterator[Place]:
    """Yield a place for each page to be split off a long page, so that splitting raises no count."""
    for file in texts.pages:
        count = words_of_page(file)
        for part in range(1, -(-count // MOST_WORDS_OF_A_PAGE)):
            yield Place(
                "docs", file.relative_to(texts.root).as_posix(), 1, f"{count} words, page {part + 1} of it"
            )


def warnings_described_by_hand(texts: Texts) -> Iterator[Place]:
    """Yield rows of tables in pages that describe a code of a warning."""
    topics = texts.entries(f"{QUANTITIES}/warning_codes.toml").get("codes", {}).values()
    codes = {code for topic in topics for code in topic}
    for file in texts.pages:
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            if line.startswith("|"):
                for code in re.findall(r"`([a-z-]+)`", line.split("|")[1]):
                    if code in codes:
                        yield Place("docs", file.relative_to(texts.root).as_posix(), number, code)


def numbers_without_an_output(texts: Texts) -> Iterator[Place]:
    """Yield numbers of tutorials, with rpm, V or %, that no block of output or input on the page contains."""
    for file in texts.pages:
        name = file.relative_to(texts.root).as_posix()
        if name.startswith("docs/tutorials/"):
            lines = file.read_text(encoding="utf-8").splitlines()
            prose = dict(_prose_of_markdown(lines))
            blocks = " ".join(line for number, line in enumerate(lines, 1) if number not in prose)
            printed = {*re.findall(r"\d[\d.]*\d|\d", blocks)}
            for number, line in prose.items():
                for match in re.finditer(r"(\d[\d.]*\d|\d) (?:rpm|V|%)", line):
                    if match[1] not in printed:
                        yield Place("docs", name, number, match[0])


def terms_without_a_link(texts: Texts) -> Iterator[Place]:
    """Yield first uses of terms of the glossary on pages for users that are not linked."""
    file = texts.root / "docs" / "reference" / "glossary.md"
    glossary = Glossary(file.read_text(encoding="utf-8") if file.exists() else "")
    for file in texts.pages:
        page = file.relative_to(texts.root / "docs").as_posix()
        if links_terms(page):
            text = file.read_text(encoding="utf-8")
            for use in unlinked(text, page, glossary):
                words = " ".join(text[use.start : use.end].split())
                yield Place("docs", f"docs/{page}", text.count("\n", 0, use.start) + 1, words)


class Rule(NamedTuple):
    """A construction that is counted: what it is, what to write instead, and its places."""

    what: str
    write: str
    places: Places


RULES = {
    "C1": Rule(
        '"that of" or "those of" instead of a noun',
        "repeat the noun: the voltage of the bearing",
        _matches(r"\b(?:[Tt]hat|[Tt]hose) of\b"),
    ),
    "C2": Rule(
        '"that at", "those with" instead of a noun',
        "repeat the noun: the voltage at 3000 rpm",
        _matches(
            r"(?<!so )(?<!means )(?<!say )(?<!says )(?<!than )\b(?:that|those) (?:at|by|with|under|around"
            r"|outside|inside|beside|behind|below|above|without)\b(?! (?:least|once))"
        ),
    ),
    "C3": Rule(
        '"in place of", "in its place"',
        "instead of",
        _matches(r"\b[Ii]n (?:place of|its place|their place)\b"),
    ),
    "C4": Rule(
        '"beside"',
        "next to (a place), compared with (a comparison) or in addition to",
        _matches(r"\b[Bb]eside\b"),
    ),
    "C5": Rule(
        '"say so", "tells", "told" of things',
        "issues a warning, prints, reports, shows or rejects",
        _matches(r"\bsa(?:ys?|id) so\b|\b[Tt]ells?\b|\btold\b"),
    ),
    "C6": Rule(
        '"left out", "leaves out"',
        "neglected, not modelled (physics), omitted or skipped",
        _matches(r"\b[Ll]e(?:ft|aves?|aving) (?:\w+ ){0,2}out\b"),
    ),
    "C7": Rule(
        '"over" for a quotient',
        "divided by, or a/b",
        _matches(
            r"\bover (?:that|those) of\b"
            r"|\bover the (?:flooded|fully flooded|isothermal|smooth|Rq|composite|mean)\b"
        ),
    ),
    "C8": Rule(
        'a sentence that begins with "Where"',
        "a condition with if or when: If the surfaces touch, the film conducts",
        _matches(r"(?:^|[.:]\s)Where\b"),
    ),
    "C9": Rule(
        '"some" with a number',
        "about",
        _matches(r"\b[Ss]ome (?:\d|ten|three|two|thirty|seconds\b|per cent\b|K\b)"),
    ),
    "C10": Rule('"hardly"', "almost no, almost not, with the number", _matches(r"\b[Hh]ardly\b")),
    "C11": Rule('"alone"', "only, before the noun", _matches(r"(?<!stand )(?<!stands )(?<!let )\balone\b")),
    "C12": Rule(
        '"all but", "none but", "but one"',
        "except",
        _matches(
            r"\b(?:all|any|none|nothing|every|everything|each)(?: \w+){0,3} but\b|,? but for\b|\bbut one\b"
        ),
    ),
    "C13": Rule(
        '"null as X is", "as either is"',
        "a sentence of its own: Null if no dielectric strength is given",
        _matches(r"\bnull (?:as|likewise)\b|\bas (?:either|that|those|both) (?:is|are|does|do|has|have)\b"),
    ),
    "C14": Rule(
        "a word-for-word translation",
        "start of, conducts heat, repair, forever, without need, reversed, ignored, alternate, oscillate",
        _matches(
            r"\bbegin of\b|\bleads? heat\b|\bmend(?:s|ed)?\b|\bfor ever\b|\bin vain\b|\bother way round\b"
            r"|\bread over\b"
            r"|\b(?:its|their) course\b|\btake turns\b"
            r"|\bg(?:o|oes|one|oing) round\b|\bwent round\b"
            r"|until both stand|\bwithout a word\b|\bof before\b"
        ),
    ),
    "C15": Rule(
        "a verb before its subject",
        "subject, verb, object: The shoulders are neglected",
        _matches(
            r"(?:^|[.:]\s)(?:(?:Left out|Neglected|Given|Sought)(?:, too,)? (?:is|are)\b"
            r"|Of (?:\d|the \w+ \w+|these|those|them|all)\b"
            r"|(?:Below|Beside|Behind|Above|Under) (?:it|them) (?:stands?|is|are|lies?)"
            r"|So (?:is|are|has|have|does|do)\b)"
        ),
    ),
    "C16": Rule('"too" at the end of a clause', "also, before the verb", _matches(r",? too(?=[.;)])")),
    "C17": Rule(
        '"the same" without a noun',
        "repeat the noun: the same film",
        _matches(r"\b[Tt]he same(?=[.;,:)]|\s(?:with|of|by|at|for|over|from|after|beside)\b)"),
    ),
    "C18": Rule(
        'a document or table that "has"',
        "contains, shows, reports, lists",
        _matches(
            r"\b(?:summary\.json|[Tt]he (?:table|file|page|report|figure|row|column|section|library|verdict"
            r"|title|note|form|list|result|guide|summary)s?|[Tt]ables|[Ff]iles|[Rr]eports|[Ff]igures|[Pp]ages|[Rr]esults)"
            r" (?:then |also |now )?ha(?:s|ve) (?!been|to\b|not\b|no\b)"
        ),
    ),
    "C19": Rule(
        "a word that only developers of this package know",
        "film-thickness formula, estimated, mass-conserving cavitation, generated surface",
        _matches(
            r"\bby formula\b|\bquick (?:contacts?|films?|answers?|margins?|cases?|points?)\b"
            r"|\b(?:carry|carries|keeps?) (?:its|their) oil\b|\bwhat is uncertain\b|\bmade surfaces?\b"
        ),
    ),
    "S1": Rule(
        "a warning without an action",
        'an action as an imperative, or "No action is needed"',
        warnings_without_an_action,
    ),
    "S2": Rule(
        f"a warning with more than {MOST_WORDS_OF_A_WARNING} words",
        "the problem with its value and limit, the consequence, the action",
        long_warnings,
    ),
    "S3": Rule(
        "the meaning of an input that does not begin with its quantity",
        "the quantity first: number of pole pairs of the machine",
        meanings_without_the_quantity,
    ),
    "S4": Rule(
        f"the meaning of a result with more than {MOST_WORDS_OF_A_MEANING} words",
        "quantity, definition, and when it is null; the method belongs into a page",
        long_meanings,
    ),
    "S5": Rule(
        f"a sentence with more than {MOST_WORDS_OF_A_SENTENCE} words",
        "one claim in a sentence; more than three numbers in a table",
        long_sentences,
    ),
    "S6": Rule(
        f'a sentence with "of" more than {MOST_OF} times',
        "a clause with a verb instead of nouns",
        rows_of_of,
    ),
    # S7, kinds and lengths of entries of the changelog, is a rule of tools/lint_house.py.
    "S8": Rule(
        f"a page with more than {MOST_WORDS_OF_A_PAGE} words",
        "a page of one kind: tutorial, how-to, reference or explanation",
        long_pages,
    ),
    "S9": Rule(
        "a row of a page that describes a warning",
        "its entry of the data files in quantities; pages show the entry",
        warnings_described_by_hand,
    ),
    "S10": Rule(
        "a number of a tutorial that its commands do not print",
        "the number of the output on the page; python -m docs.renew writes it",
        numbers_without_an_output,
    ),
    "S11": Rule(
        "a term of the glossary without a link where a page uses it first",
        "{term}`lambda ratio` or {term}`margins <margin>`, or a link to the page that explains it",
        terms_without_a_link,
    ),
}

Counts = dict[str, dict[str, int]]


def places_by_rule(texts: Texts) -> dict[str, list[Place]]:
    """Return the places of each rule."""
    return {name: [*rule.places(texts)] for name, rule in RULES.items()}


def allowed(root: Path) -> Counts:
    """Return the allowed counts, by rule and group of texts."""
    file = root / COUNTS
    return tomllib.loads(file.read_text(encoding="utf-8")) if file.exists() else {}


def faults(root: Path, places: dict[str, list[Place]]) -> list[str]:
    """Return a message for each count that is higher than allowed."""
    limits = allowed(root)
    messages = []
    for name, rule in RULES.items():
        for group, count in Counter(place.texts for place in places[name]).items():
            most = limits.get(name, {}).get(group, 0)
            if count > most:
                where = [place for place in places[name] if place.texts == group]
                changed = changed_lines(root)
                new = [place for place in where if place.line in changed.get(place.file, ())]
                message = f"{name} in {group}: {count} places, and at most {most} may be: {rule.what}."
                message += f" Write instead: {rule.write}."
                if not new:
                    message += (
                        f" No changed line contains one; python -m tools.lint_prose {name} lists all places."
                    )
                messages.append("\n".join([message, *map(_shown, new)]))
    return messages


def _shown(place: Place) -> str:
    return f"  {place.file}:{place.line}: {place.words}"


def changed_lines(root: Path) -> dict[str, set[int]]:
    """Return the lines by file that differ from the branch main, or on main the lines of the last commit."""

    def git(*arguments: str) -> str:
        command = ["git", "-C", str(root), *arguments]
        return subprocess.run(command, capture_output=True, text=True, check=False, encoding="utf-8").stdout

    base, head = git("merge-base", "HEAD", "main").strip(), git("rev-parse", "HEAD").strip()
    lines: dict[str, set[int]] = {}
    name = ""
    options = ("diff", "--unified=0", "--no-color")
    changes = git(*options, base if base != head else "HEAD~1") or git(*options, "HEAD")
    for line in changes.splitlines():
        if line.startswith("+++ "):
            name = line[6:]
        elif part := re.match(r"@@ -\S+ \+(\d+)(?:,(\d+))? @@", line):
            first = int(part[1])
            lines.setdefault(name, set()).update(range(first, first + int(part[2] or 1)))
    return lines


HEADER = """\
# Allowed counts of constructions that make texts hard to read, by rule of tools/lint_prose.py and group of
# texts. A count may fall and must not rise: `python -m tools.lint_prose --renew` lowers it. A group without a
# number may contain none.
"""


def renew(root: Path, places: dict[str, list[Place]]) -> None:
    """Lower the allowed counts to the counts of the texts; a rule without an entry gets one."""
    limits = allowed(root)
    text = HEADER
    for name in RULES:
        counts = Counter(place.texts for place in places[name])
        old = limits.get(name, counts)
        numbers = {group: min(number, counts[group]) for group, number in old.items()}
        text += f"\n[{name}]\n" + "".join(f"{group} = {n}\n" for group, n in sorted(numbers.items()) if n)
    (root / COUNTS).write_text(text, encoding="utf-8", newline="\n")


def table(texts: Texts, places: dict[str, list[Place]]) -> str:
    """Return the counts of all rules, and the lengths of pages and sentences, as a table."""
    groups = list(texts.groups)
    words = [
        sum(len(re.findall(r"[A-Za-z][A-Za-z'-]*", line.text)) for line in texts.groups[group])
        for group in groups
    ]
    rows = [["", *groups, "total"], ["words", *map(str, words), str(sum(words))]]
    for name in RULES:
        counts = Counter(place.texts for place in places[name])
        rows.append([name, *(str(counts[group]) for group in groups), str(counts.total())])
    lines = ["  ".join([f"{row[0]:<6}", *(f"{cell:>12}" for cell in row[1:])]) for row in rows]
    lines += ["", *_lengths_of_pages(texts)]
    count = sum(place.texts == "docs" for place in places["S5"])
    lines.append(f"sentences above {MOST_WORDS_OF_A_SENTENCE} words in docs: {count}")
    patterns = [place for name in RULES if name.startswith("C") for place in places[name]]
    in_code = sum(place.texts in ("docstrings", "comments") for place in patterns)
    lines.append(f"places of C1 to C19 in texts of users: {len(patterns) - in_code}")
    lines.append(f"places of C1 to C19 in docstrings and comments: {in_code}")
    return "\n".join(lines)


def _lengths_of_pages(texts: Texts) -> Iterator[str]:
    """Yield lines with the words of pages, in all and by folder, and the long pages."""
    pages = {file.relative_to(texts.root / "docs").as_posix(): words_of_page(file) for file in texts.pages}
    folders: Counter[str] = Counter()
    for name, count in pages.items():
        folders[name.rpartition("/")[0] or "."] += count
    for_users = folders.total() - folders["validation"] - folders["project"]
    yield f"words of pages for users: {for_users}"
    yield from (f"  docs/{folder}: {count}" for folder, count in sorted(folders.items()) if count)
    long = {name: count for name, count in pages.items() if count > MOST_WORDS_OF_A_PAGE}
    yield f"pages above {MOST_WORDS_OF_A_PAGE} words: {len(long)}"
    yield from (f"  docs/{name}: {count}" for name, count in long.items())


def main() -> int:
    """Print what was asked for, and return the exit status."""
    parser = argparse.ArgumentParser(description="Count constructions that make texts hard to read.")
    parser.add_argument(
        "rule", nargs="?", choices=RULES, metavar="RULE", help="list the places of this rule, such as C5"
    )
    parser.add_argument(
        "--renew", action="store_true", help=f"lower the allowed counts in {COUNTS.as_posix()}"
    )
    parser.add_argument("--table", action="store_true", help="print all counts and the lengths of pages")
    options = parser.parse_args()
    texts = Texts(ROOT)
    if options.rule:
        rule = RULES[options.rule]
        print(f"{options.rule}: {rule.what}. Write instead: {rule.write}.")
        print("\n".join(map(_shown, rule.places(texts))))
        return 0
    places = places_by_rule(texts)
    if options.table:
        print(table(texts, places))
        return 0
    if options.renew:
        renew(ROOT, places)
    broken = faults(ROOT, places)
    for message in broken:
        print(message)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
