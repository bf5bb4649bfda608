"""Check rules of this repository that ruff, mypy and import-linter do not know.

`make lint` runs `python tools/lint_house.py`. Each broken rule is a line "file:line: what is wrong". If
there is one, the exit status is 1. A rule is a function of the root of the repository, listed in `RULES`.

`python tools/lint_house.py --renew` lowers the numbers in tools/words_in_names.toml to those of the source.
It raises no number.
"""

import argparse
import ast
import re
import string
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).parents[1]
PACKAGE = Path("src/ehlectric")
WORDS_IN_NAMES = Path("tools/words_in_names.toml")

MOST_WORDS = 30  # of one entry of the changelog

# Codes of warnings that only files of later versions give.
FOREIGN_CODES = {"not-usable", "unclassified"}
# Statements of verdicts that only examples in docstrings make.
EXAMPLE_STATEMENTS = {"outer", "first", "margin-at-least"}

# Expressions in properties of elements of the app: names of the program, numbers, or one of a few words.
NAMES_OF_THE_PROGRAM = {
    "name",
    "name.replace('.', '-')",
    "test",
    "testid",
    "test_id",
    "label",
    "keys",
    "unit",
    "ends[0]",
    "look",
    "ends[1]",
    "prefix",
    "shown.name",
    "level",
    "verdict.level",
    "answer.contacts",
    "str(answer.whole).lower()",
    "str(answer.solved).lower()",
    "str(name == chosen).lower()",
    "number.key",
    "str(dimmed).lower()",
    "'true' if wrong else 'false'",
    "len(answer.times) - 1",
    "job.done / job.of",
}

# Names that Windows lacks, by module; ``getattr`` and ``hasattr`` take them as texts.
MISSING_IN_WINDOWS = {
    "signal": {"SIGHUP", "SIGKILL", "SIGALRM", "SIGUSR1", "SIGCHLD", "SIGQUIT", "setitimer", "alarm"},
    "os": {
        *("fork", "killpg", "setsid", "nice", "getuid", "geteuid"),
        *("mkfifo", "sched_getaffinity", "statvfs", "sysconf", "uname"),
    },
}
MODULES_MISSING_IN_WINDOWS = {"fcntl", "resource", "termios", "pwd", "grp", "pty", "tty"}
# Within a try that takes an AttributeError.
GUARDED = {("memory.py", "sysconf"), ("processes.py", "killpg"), ("processes.py", "SIGKILL")}


class Fault(NamedTuple):
    """A place, relative to the root of the repository, and what is wrong there."""

    file: Path
    line: int
    message: str

    def __str__(self) -> str:
        return f"{self.file.as_posix()}:{self.line}: {self.message}"


class Module(NamedTuple):
    """A module of the package: file relative to the root, text, and all nodes of its syntax tree."""

    file: Path
    text: str
    nodes: list[ast.AST]

    def calls(self, *functions: str) -> Iterator[ast.Call]:
        """Yield the calls of functions by their names as they are written."""
        for node in self.nodes:
            if isinstance(node, ast.Call) and _written(node.func) in functions:
                yield node


@cache
def modules(root: Path) -> list[Module]:
    """Return all modules of the package."""
    files = sorted((root / PACKAGE).rglob("*.py"))
    texts = [(file.relative_to(root), file.read_text(encoding="utf-8")) for file in files]
    return [Module(file, text, [*ast.walk(ast.parse(text))]) for file, text in texts]


def data(root: Path, name: str) -> dict[str, Any]:
    """Return the tables of a data file of the package."""
    return tomllib.loads((root / PACKAGE / name).read_text(encoding="utf-8"))


def _written(node: ast.expr) -> str | None:
    """Name or dotted name of a function, as it is written."""
    if isinstance(node, ast.Attribute):
        owner = _written(node.value)
        return None if owner is None else f"{owner}.{node.attr}"
    return node.id if isinstance(node, ast.Name) else None


def _line_of(root: Path, name: Path, text: str) -> int:
    """Line of a file that contains a text, or 1."""
    lines = (root / name).read_text(encoding="utf-8").splitlines()
    return next((number for number, line in enumerate(lines, 1) if text in line), 1)


def fragments_of_the_changelog(root: Path) -> Iterator[Fault]:
    """Yield fragments in changes/ whose name, kind, length or form is wrong."""
    config = tomllib.loads((root / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["towncrier"]
    kinds = [kind["directory"] for kind in config["type"]]
    name = re.compile(rf"\+[a-z0-9-]+\.({'|'.join(kinds)})\.md")
    for file in sorted((root / "changes").iterdir()):
        place = file.relative_to(root)
        if not name.fullmatch(file.name):
            expected = f"+name.KIND.md, with small letters, digits and hyphens; KIND is {', '.join(kinds)}"
            yield Fault(place, 1, f"the name of a fragment is {expected}")
            continue
        text = file.read_text(encoding="utf-8")
        count = len(text.split())
        if count > MOST_WORDS:
            yield Fault(place, 1, f"{count} words; an entry has at most {MOST_WORDS}")
        if text.count("\n") != 1 or not text.endswith(".\n"):
            yield Fault(place, 1, "an entry is one line that ends with a full stop")
        if text.startswith(("- ", "* ")):
            yield Fault(place, 1, "an entry begins without a bullet; towncrier writes it")


def entries_of_the_changelog(root: Path) -> Iterator[Fault]:
    """Yield released entries that are too long."""
    lines = (root / "CHANGELOG.md").read_text(encoding="utf-8").splitlines()
    for number, line in enumerate(lines, 1):
        count = len(line.removeprefix("- ").split())
        if line.startswith("- ") and count > MOST_WORDS:
            yield Fault(Path("CHANGELOG.md"), number, f"{count} words; an entry has at most {MOST_WORDS}")


def actions_of_the_workflows(root: Path) -> Iterator[Fault]:
    """Yield actions that are not pinned by the hash of a commit, with the version as a comment."""
    pinned = re.compile(r"uses: [\w./-]+@[0-9a-f]{40} # v\d+\.\d+\.\d+")
    for file in sorted((root / ".github/workflows").glob("*.yml")):
        for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
            if "uses: " in line and not pinned.search(line):
                message = "pin the action by the hash of its commit, and add the version: @HASH # v1.2.3"
                yield Fault(file.relative_to(root), number, message)


def _warning_modules(root: Path) -> list[Module]:
    """Return the modules that give warnings: all but the module that defines them."""
    return [module for module in modules(root) if module.file.name != "result_warnings.py"]


def codes_of_warnings(root: Path) -> Iterator[Fault]:
    """Yield warnings whose code is unknown or computed, and codes that no module uses."""
    topics = data(root, "quantities/warning_codes.toml")["codes"].values()
    codes = {code for topic in topics for code in topic}
    used: set[object] = set()
    for module in _warning_modules(root):
        used |= {node.value for node in module.nodes if isinstance(node, ast.Constant)}
        for call in module.calls("ResultWarning", "ResultWarning.of"):
            code = call.args[0]
            if isinstance(code, ast.Constant) and code.value not in codes:
                yield Fault(
                    module.file, call.lineno, f"{code.value!r} is not in quantities/warning_codes.toml"
                )
            # A warning and its severe form, and warnings that are handed on.
            elif not isinstance(code, ast.Constant) and ast.unparse(code) not in ("code", "warning.code"):
                yield Fault(module.file, call.lineno, "write the code of a warning as a literal")
    file = PACKAGE / "quantities/warning_codes.toml"
    for code in codes - used - FOREIGN_CODES:
        yield Fault(file, _line_of(root, file, code), f"no module gives the code {code!r}; delete it")


def _texts_of_warnings(root: Path) -> dict[tuple[str, str], set[str]]:
    """Return the names of the values in each text, by code and situation."""
    named = {}
    for code, entry in data(root, "quantities/warning_texts.toml").items():
        for situation in entry.keys() - {"explanation"}:
            fields = string.Formatter().parse(entry[situation])
            named[code, situation] = {name for _, name, _, _ in fields if name}
    return named


def _warnings_given(root: Path) -> Iterator[tuple[Module, ast.Call, tuple[Any, Any]]]:
    """Yield calls that give a warning, with code and situation, None where they are computed."""
    for module in _warning_modules(root):
        calls = [(call, call.args) for call in module.calls("ResultWarning.of")]
        # The first argument of a condition of a warning says where it holds.
        calls += [(call, call.args[1:]) for call in module.calls("WarningCondition.of")]
        for call, arguments in calls:
            keys = [each.value if isinstance(each, ast.Constant) else None for each in arguments]
            code, situation = (*keys, "text")[:2]
            yield module, call, (code, situation)


def texts_of_warnings(root: Path) -> Iterator[Fault]:
    """Yield warnings that lack a value of their text or give another one, and texts that are not used."""
    texts, used = _texts_of_warnings(root), set()
    for module, call, key in _warnings_given(root):
        names = {each.arg for each in call.keywords}
        if None in names:
            yield Fault(module.file, call.lineno, "name the values of a warning; a dict cannot be checked")
            continue
        fitting = {
            text
            for text in texts
            if all(given in (None, part) for given, part in zip(key, text, strict=True))
            and texts[text] <= names
        }
        used |= fitting
        if not fitting:
            message = "no text of quantities/warning_texts.toml has this code, situation and values"
            yield Fault(module.file, call.lineno, message)
        elif surplus := names - set().union(*(texts[text] for text in fitting)):
            yield Fault(
                module.file, call.lineno, f"no text uses the values {', '.join(sorted(map(str, surplus)))}"
            )
    file = PACKAGE / "quantities/warning_texts.toml"
    for code, situation in texts.keys() - used:
        name = code if situation == "text" else f"{code}.{situation}"
        yield Fault(file, _line_of(root, file, f"[{code}]"), f"no warning has the text {name}; delete it")


def warnings_with_written_texts(root: Path) -> Iterator[Fault]:
    """Yield warnings with a text of their own; only a warning that exists is made again, with its place."""
    for module in _warning_modules(root):
        for call in module.calls("ResultWarning"):
            if ast.unparse(call.args[0]) != "warning.code":
                message = "use ResultWarning.of; texts are in quantities/warning_texts.toml"
                yield Fault(module.file, call.lineno, message)


def keys_in_texts_of_errors(root: Path) -> Iterator[Fault]:
    """Yield errors whose only text contains the key, so that the error does not know its key."""
    for module in modules(root):
        for call in module.calls("InputError", "MemoryLimitError", "ValueError"):
            if len(call.args) != 1 or call.keywords:
                continue
            text = call.args[0]
            parts = text.values if isinstance(text, ast.JoinedStr) else [text]
            line = "".join(str(part.value) if isinstance(part, ast.Constant) else "x" for part in parts)
            if re.match(r"got |[\w.-]+(, [\w.-]+)*: ", line):
                message = "give the key, got=... and takes=... instead of one text"
                yield Fault(module.file, call.lineno, message)


def signs_of_bounds(root: Path) -> Iterator[Fault]:
    """Yield signs of bounds outside `quantities` and `tables`: bounds that the book does not know."""
    for module in modules(root):
        if module.file.relative_to(PACKAGE).parts[0] in ("quantities", "tables"):
            continue
        for number, line in enumerate(module.text.splitlines(), 1):
            if re.search(r'bound="[≤≥]"', line):
                message = "take the bound of a result from quantities/result_bounds.py"
                yield Fault(module.file, number, message)


def properties_of_the_app(root: Path) -> Iterator[Fault]:
    """Yield values in texts of properties of elements that may be a text of a user.

    The framework splits such a text into properties, and the browser runs those whose names begin with a
    colon. Any other text is set as an item of ``props``.
    """
    for module in modules(root):
        if module.file.is_relative_to(PACKAGE / "app/pages"):
            for line, written in _in_properties(module):
                if written not in NAMES_OF_THE_PROGRAM:
                    message = f"set {written} as an item of props, or list it in NAMES_OF_THE_PROGRAM"
                    yield Fault(module.file, line, message)


def _in_properties(module: Module) -> Iterator[tuple[int, str]]:
    """Yield lines and expressions in arguments of ``props``."""
    for call in module.nodes:
        if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Attribute)):
            continue
        if call.func.attr != "props":
            continue
        for argument in [*call.args, *(keyword.value for keyword in call.keywords)]:
            for part in ast.walk(argument):
                if isinstance(part, ast.FormattedValue):
                    yield call.lineno, ast.unparse(part.value)
                elif isinstance(part, ast.BinOp | ast.Name) and part is argument:
                    yield call.lineno, ast.unparse(part)


def texts_of_verdicts(root: Path) -> Iterator[Fault]:
    """Yield statements of verdicts without a text, and texts of codes that no module names."""
    texts = data(root, "quantities/verdict_texts.toml")
    known = texts["statements"].keys() | EXAMPLE_STATEMENTS
    literals: set[object] = set()
    patterns: list[re.Pattern[str]] = []
    for module in modules(root):
        literals |= {node.value for node in module.nodes if isinstance(node, ast.Constant)}
        patterns += _patterns(module)
        for call in module.calls("Statement.of"):
            code = call.args[0]
            if isinstance(code, ast.Constant) and code.value not in known:
                message = f"the statement {code.value!r} has no text in quantities/verdict_texts.toml"
                yield Fault(module.file, call.lineno, message)
    file = PACKAGE / "quantities/verdict_texts.toml"
    for code in [*texts["statements"], *texts["leads"]]:
        if code not in literals and not any(pattern.fullmatch(code) for pattern in patterns):
            yield Fault(file, _line_of(root, file, code), f"no module names the code {code!r}; delete it")


def _patterns(module: Module) -> Iterator[re.Pattern[str]]:
    """Yield patterns of strings with values in them, such as f"margin-{side}"."""
    for node in module.nodes:
        if isinstance(node, ast.JoinedStr):
            parts = [str(part.value) if isinstance(part, ast.Constant) else "" for part in node.values]
            # A pattern without five letters of its own would match any code.
            if len("".join(parts)) > 4:
                yield re.compile("".join(re.escape(part) if part else "[a-z]+" for part in parts))


def names_that_windows_lacks(root: Path) -> Iterator[Fault]:
    """Yield names and modules of POSIX that are used without a guard."""
    for module in modules(root):
        for node in module.nodes:
            if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
                missing = node.attr in MISSING_IN_WINDOWS.get(node.value.id, ())
                if missing and (module.file.name, node.attr) not in GUARDED:
                    yield Fault(
                        module.file, node.lineno, f"Windows lacks {node.value.id}.{node.attr}; use getattr"
                    )
            if isinstance(node, ast.Import | ast.ImportFrom):
                names = {alias.name for alias in node.names} | {getattr(node, "module", None)}
                for name in names & MODULES_MISSING_IN_WINDOWS:
                    yield Fault(module.file, node.lineno, f"Windows lacks the module {name}")


def publications_of_reports(root: Path) -> Iterator[Fault]:
    """Yield publications of reports that no docstring cites: no equation uses them."""
    texts = data(root, "report/report_texts.toml")
    source = "".join(module.text for module in modules(root))
    file = PACKAGE / "report/report_texts.toml"
    for reference in (*texts["references"], *texts["drive_references"]):
        citation = reference["citation"]
        # A standard or a book has no DOI: its first words are in the source.
        sign = reference.get("doi") or re.split("[ ,]", citation, maxsplit=1)[0]
        if sign not in source:
            yield Fault(file, _line_of(root, file, citation), f"no docstring cites {sign}")


def _names(node: ast.AST) -> Iterator[str]:
    """Yield the names that a node writes: of variables, attributes, keywords, functions and modules."""
    if not isinstance(node, ast.Constant):
        for _, field in ast.iter_fields(node):
            yield from (part for part in (field if isinstance(field, list) else [field]) if type(part) is str)


def _places_of_words(root: Path) -> Iterator[tuple[str, str]]:
    """Yield each word of each name of the package, and its place: file:line and name."""
    for module in modules(root):
        # A node without a line, such as the arguments of a function, writes no name.
        for node in sorted(module.nodes, key=lambda node: getattr(node, "lineno", 0)):
            for name in _names(node):
                place = f"{module.file.as_posix()}:{getattr(node, 'lineno', 1)} {name}"
                yield from ((word, place) for word in re.split("[._]+", name.lower()))


def words_in_names(root: Path) -> Iterator[Fault]:
    """Yield words that say too little and are in more names than tools/words_in_names.toml allows."""
    words = tomllib.loads((root / WORDS_IN_NAMES).read_text(encoding="utf-8"))
    places: dict[str, list[str]] = {word: [] for word in words}
    for word, place in _places_of_words(root):
        if word in words:
            places[word].append(place)
    for word, entry in words.items():
        if len(places[word]) > entry["number"]:
            message = (
                f"{len(places[word])} names contain the word {word!r}, and at most {entry['number']} may; "
                f"use a noun of the field in a new name, such as {entry['nouns']}. The names:"
            )
            line = _line_of(root, WORDS_IN_NAMES, f"[{word}]")
            yield Fault(WORDS_IN_NAMES, line, "\n  ".join([message, *places[word]]))


def names_of_faces(root: Path) -> Iterator[Fault]:
    """Yield names that a package offers to others in its ``__init__.pyi`` and that none of them imports.

    The ``__init__.pyi`` with the public names imports from the packages too.
    """
    public = root / PACKAGE / "__init__.pyi"
    used = {(f"ehlectric.{node.module}", name.name) for node in _imports(public) for name in node.names}
    for node in (node for module in modules(root) for node in module.nodes):
        if isinstance(node, ast.ImportFrom) and node.module:
            used |= {(node.module, name.name) for name in node.names}
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            used.add((f"ehlectric.{node.value.id}", node.attr))
    for face in sorted((root / PACKAGE).glob("*/__init__.pyi")):
        package = f"ehlectric.{face.parent.name}"
        for name in (name for node in _imports(face) for name in node.names):
            if (package, name.name) not in used:
                yield Fault(face.relative_to(root), name.lineno, f"no other package imports {name.name}")


def _imports(face: Path) -> Iterator[ast.ImportFrom]:
    """Yield the imports of an ``__init__.pyi``."""
    nodes = ast.parse(face.read_text(encoding="utf-8")).body
    return (node for node in nodes if isinstance(node, ast.ImportFrom))


def renew(root: Path = ROOT) -> list[Fault]:
    """Lower the numbers of words in names to those of the source. Returns faults if a number is too low."""
    if broken := list(words_in_names(root)):
        return broken
    file = root / WORDS_IN_NAMES
    counts = Counter(word for word, _ in _places_of_words(root))
    text = re.sub(
        r"(?m)^\[(\w+)\]\nnumber = \d+$",
        lambda entry: f"[{entry[1]}]\nnumber = {counts[entry[1]]}",
        file.read_text(encoding="utf-8"),
    )
    file.write_text(text, encoding="utf-8", newline="\n")
    return []


RULES = (
    fragments_of_the_changelog,
    entries_of_the_changelog,
    actions_of_the_workflows,
    codes_of_warnings,
    texts_of_warnings,
    warnings_with_written_texts,
    keys_in_texts_of_errors,
    signs_of_bounds,
    properties_of_the_app,
    texts_of_verdicts,
    names_that_windows_lacks,
    publications_of_reports,
    words_in_names,
    names_of_faces,
)


def faults(root: Path = ROOT) -> list[Fault]:
    """Return what breaks a rule, in the order of the rules."""
    return [fault for rule in RULES for fault in rule(root)]


def main() -> int:
    """Print the faults, and return the exit status."""
    parser = argparse.ArgumentParser(description="Check the rules of this repository.")
    text = f"lower the numbers in {WORDS_IN_NAMES.as_posix()} to those of the source"
    parser.add_argument("--renew", action="store_true", help=text)
    broken = renew() if parser.parse_args().renew else faults()
    for fault in broken:
        print(fault)
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
