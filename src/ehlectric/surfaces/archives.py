"""Members of a ZIP archive, read without trust in the sizes that the archive states.

Python's own reader decompresses some kinds of members as a whole, whatever size the archive states for them.
"""

from __future__ import annotations

import bz2
import io
import lzma
import struct
import zipfile
import zlib
from collections.abc import Callable, Mapping
from types import MappingProxyType

from ehlectric.errors import InputError
from ehlectric.runtime.memory import in_bytes

# Exceptions of Python's ZIP reader and of its decompressors for invalid content.
BROKEN = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    struct.error,
    RuntimeError,
    NotImplementedError,  # compression that Python does not know
    LookupError,
    ValueError,
    OSError,
    EOFError,
    OverflowError,
)

# Largest number of members of an archive. A surface has fewer than ten.
MOST_MEMBERS = 10_000

# Largest ratio of the size of a member to its compressed size, beyond a size that does no harm [bytes].
# Measured heights become at most some ten times smaller.
MOST_RATIO = 100
HARMLESS = 16_000_000

# Largest dictionary of LZMA [bytes]; its decompressor takes as much memory.
_MOST_DICTIONARY = 64_000_000

# Size of the header before each member, and its bytes with the lengths of the name and of the extra field.
_HEADER, _LENGTHS = 30, slice(26, 30)
_ENTRY = b"PK\x01\x02"
_ENCRYPTED = 1


def opened(content: bytes) -> zipfile.ZipFile:
    """Archive with a content.

    Raises
    ------
    zipfile.BadZipFile
        Where the content is no archive, or lists more than ``MOST_MEMBERS`` members.
    """
    if content.count(_ENTRY) > MOST_MEMBERS:
        raise zipfile.BadZipFile("too many members")
    return zipfile.ZipFile(io.BytesIO(content))


def member(archive: zipfile.ZipFile, content: bytes, name: str, most: int) -> bytes:
    """Content of a member of an archive; decompression ends at its bound.

    Parameters
    ----------
    archive : zipfile.ZipFile
        Archive, from ``opened``.
    content : bytes
        Its content.
    name : str
        Name of the member.
    most : int
        Largest size of the member [bytes].

    Returns
    -------
    bytes
        Content of the member.

    Raises
    ------
    InputError
        Where the member states more than ``MOST_RATIO`` times its compressed size. The error has no key.
    BROKEN
        Where the archive has no such member, or it is broken, encrypted, or larger than ``most``.

    Examples
    --------
    >>> target = io.BytesIO()
    >>> with zipfile.ZipFile(target, "w") as new:
    ...     new.writestr("main.xml", b"<a/>")
    >>> content = target.getvalue()
    >>> member(opened(content), content, "main.xml", 100)
    b'<a/>'
    """
    info = archive.getinfo(name)
    if info.flag_bits & _ENCRYPTED or info.file_size > most:
        raise ValueError(name)
    allowed = HARMLESS + MOST_RATIO * info.compress_size
    if info.file_size > allowed:
        raise InputError.worded(
            None,
            f"holds {in_bytes(info.file_size)} in {in_bytes(info.compress_size)}; "
            f"expected at most {in_bytes(allowed)}, as measured heights hardly compress",
        )
    decompress = _DECOMPRESS.get(info.compress_type)
    if decompress is None:
        raise NotImplementedError(info.compress_type)
    start = info.header_offset + _HEADER
    start += sum(struct.unpack("<HH", content[info.header_offset :][:_HEADER][_LENGTHS]))
    data = decompress(content[start : start + info.compress_size], info.file_size + 1)
    if len(data) != info.file_size or zlib.crc32(data) != info.CRC:
        raise zipfile.BadZipFile(name)
    return data


def _inflate(data: bytes, most: int) -> bytes:
    return zlib.decompressobj(-zlib.MAX_WBITS).decompress(data, most)


def _bunzip(data: bytes, most: int) -> bytes:
    return bz2.BZ2Decompressor().decompress(data, most)


def _unlzma(data: bytes, most: int) -> bytes:
    """Member compressed by LZMA: two bytes of version, the length of the properties, and five of them."""
    length, properties, dictionary = struct.unpack("<xxHBI", data[:9])
    rest, lc = divmod(properties, 9)
    pb, lp = divmod(rest, 5)
    if length != 5 or dictionary > _MOST_DICTIONARY:
        raise ValueError("unknown properties of LZMA")
    kind = {"id": lzma.FILTER_LZMA1, "dict_size": dictionary, "lc": lc, "lp": lp, "pb": pb}
    return lzma.LZMADecompressor(lzma.FORMAT_RAW, filters=[kind]).decompress(data[9:], most)


# Functions that decompress at most so many bytes, by the kind of compression.
_DECOMPRESS: Mapping[int, Callable[[bytes, int], bytes]] = MappingProxyType(
    {
        zipfile.ZIP_STORED: lambda data, most: data[:most],
        zipfile.ZIP_DEFLATED: _inflate,
        zipfile.ZIP_BZIP2: _bunzip,
        zipfile.ZIP_LZMA: _unlzma,
    }
)
