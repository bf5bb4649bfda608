"""Kinds of files that are no text, by their first bytes: what they are, and what to save instead."""

from __future__ import annotations

from dataclasses import dataclass

# Number of first bytes by which most kinds are recognised.
PEEKED = 4096

# Number of first bytes that are letters and zeros in UTF-16.
_LETTERS = 12
_PLAIN = frozenset((*b"\t\n\r", *range(32, 127)))

_CSV = "save it as CSV"
_SHEET = "save the sheet as CSV"
_EXPORT = "export it as CSV"


@dataclass(frozen=True)
class Kind:
    """Kind of a file: its name, what to do, and the bytes at its beginning and within its first ones."""

    what: str
    advice: str
    begins: bytes | tuple[bytes, ...] = b""
    contains: bytes = b""
    place: int = 0  # of the first bytes

    def matches(self, content: bytes) -> bool:
        """Whether the content of a file, or its beginning, is of this kind."""
        known = bool(self.begins or self.contains)
        return known and content.startswith(self.begins, self.place) and self.contains in content


_WORKBOOK = "a workbook of a spreadsheet program"
_ZIP, _OLE = b"PK\x03\x04", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"

# The first match counts.
KINDS = {
    "xlsx": Kind(_WORKBOOK, _SHEET, _ZIP, b"xl/workbook."),
    "ods": Kind(_WORKBOOK, _SHEET, _ZIP, b"opendocument.spreadsheet"),
    "docx": Kind("a document of a word processor", _CSV, _ZIP, b"word/document."),
    "npz": Kind("an archive of NumPy", _CSV, _ZIP, b".npy"),
    "x3p": Kind("a surface (x3p)", "give it as the file of a surface", _ZIP, b"main.xml"),
    "zip": Kind("an archive (zip)", "unpack it", _ZIP),
    "xls": Kind(_WORKBOOK, _SHEET, _OLE, "Workbook".encode("utf-16-le")),
    "ole": Kind("a document of Microsoft Office", _SHEET, _OLE),
    "mat": Kind("a file of MATLAB", _EXPORT, b"MATLAB 5.0 MAT-file"),
    "mat73": Kind("a file of MATLAB 7.3", "save it with the option -v7", b"MATLAB 7.3 MAT-file"),
    "hdf5": Kind("a file of HDF5", _EXPORT, b"\x89HDF\r\n\x1a\n"),
    "tdms": Kind("a TDMS file of LabVIEW", _EXPORT, b"TDSm"),
    "mdf": Kind("an MDF file of a data logger", _EXPORT, (b"MDF  ", b"UnFinMF")),
    "trc": Kind("a waveform of LeCroy (trc)", _EXPORT, contains=b"WAVEDESC\0"),
    "isf": Kind("a waveform of Tektronix (isf)", _EXPORT, (b":WFMP", b":CURV", b"WFMPRE:", b":WFMO")),
    "tektronix": Kind("a waveform of Tektronix (wfm)", _EXPORT, b":WFM#", place=2),
    "keysight": Kind("a waveform of Keysight (bin)", _EXPORT, (b"AG01", b"AG03", b"AG10")),
    "rigol": Kind("a waveform of Rigol", _EXPORT, (b"\xa5\xa5", b"\x01\xff\xff\xff", b"RG0")),
    "raw_16": Kind("a result of LTspice (raw)", "export it as text", "Title:".encode("utf-16-le")),
    "raw": Kind("a result of a circuit simulator (raw)", "export it as text", b"Title:", b"Plotname:"),
    "wav": Kind("a file of sound (wav)", _EXPORT, b"RIFF", b"WAVE"),
    "npy": Kind("an array of NumPy (npy)", "save it with numpy.savetxt", b"\x93NUMPY"),
    "parquet": Kind("a table (parquet)", _CSV, b"PAR1"),
    "sqlite": Kind("a database (SQLite)", _EXPORT, b"SQLite format 3\0"),
    "gzip": Kind("compressed (gzip)", "unpack it", b"\x1f\x8b"),
    "7z": Kind("an archive (7z)", "unpack it", b"7z\xbc\xaf\x27\x1c"),
    "pdf": Kind("a document (PDF)", _CSV, b"%PDF"),
    "png": Kind("a picture (PNG)", "save the numbers as CSV", b"\x89PNG"),
    "jpeg": Kind("a picture (JPEG)", "save the numbers as CSV", b"\xff\xd8\xff"),
    "utf16": Kind("text in UTF-16 without its mark", "save it as UTF-8"),
}


def kind_of(content: bytes) -> str | None:
    """Key in ``KINDS`` of the content of a file that is no text, or of its beginning; None for others.

    Examples
    --------
    >>> kind_of(b"MATLAB 5.0 MAT-file, Platform: GLNXA64"), kind_of(b"0,1")
    ('mat', None)
    """
    letters, zeros = content[:_LETTERS:2], content[1:_LETTERS:2]
    if len(zeros) == _LETTERS // 2 and not any(zeros) and all(byte in _PLAIN for byte in letters):
        return "raw_16" if KINDS["raw_16"].matches(content) else "utf16"
    return next((key for key, kind in KINDS.items() if kind.matches(content)), None)


def is_workbook(content: bytes) -> bool:
    """Whether the content of a file is a workbook of a spreadsheet program.

    Examples
    --------
    >>> is_workbook(b"0;1")
    False
    """
    key = kind_of(content)
    return key is not None and KINDS[key].what == _WORKBOOK


def not_text(content: bytes) -> str:
    """What a message says of a file that is no text.

    Examples
    --------
    >>> not_text(b"%PDF-1.7 ")
    'is not a text file, but a document (PDF); save it as CSV'
    """
    key = kind_of(content)
    if key is None:
        return "is not a text file; export its numbers as CSV"
    kind = KINDS[key]
    if kind.what == _WORKBOOK:
        return f"is {kind.what}; {kind.advice}"
    return f"is not a text file, but {kind.what}; {kind.advice}"
