"""Damage to files: bytes that change, and values that somebody edits."""

import json
import random
import string

import numpy as np

from ehlectric.runtime.hdf5_guard import seal_of

BAD_NUMBERS = (0.0, -1.0, 1e300, -1e300, 1e-300, 5e-324, np.nan, np.inf, -np.inf)
BAD_JSON = (None, 0, -1, 1e300, float("nan"), 10**400, "x", "", [], {}, [[]], [{}], True)


def seal(path):
    """Append a seal to a file without one, as that of a file that a test has changed."""
    content = path.read_bytes()
    path.write_bytes(content + seal_of([content]))


def with_damaged_bytes(content, seed):
    """Bytes of a file with some that are flipped, set to zero, or cut off at the end; never as they were."""
    draw, data = random.Random(seed), bytearray(content)
    start = draw.randrange(len(data))
    match draw.choice(["bit", "byte", "bytes", "zeros", "cut"]):
        case "bit":
            data[start] ^= 1 << draw.randrange(8)
        case "byte":
            data[start] ^= draw.randrange(1, 256)
        case "bytes":
            for _ in range(8):
                data[draw.randrange(len(data))] = draw.randrange(256)
        case "zeros":
            length = draw.choice([4, 64, 512])
            data[start : start + length] = bytes(len(data[start : start + length]))
        case _:
            del data[start:]
    return bytes(data) if data != content else content[:-1]


def with_edited_values(dataset, seed):
    """Dataset with a variable, a dimension or an attribute that was edited, and what was edited."""
    draw = random.Random(seed)
    name = draw.choice(list(dataset.variables))
    what = draw.choice(["value", "all", "reversed", "scaled", "type", "dropped", "cut", "text", "json"])
    if what in ("text", "json"):
        attribute = draw.choice(list(dataset.attrs))
        edited = dataset.copy()
        edited.attrs[attribute] = _edited_text(dataset.attrs[attribute], draw, as_json=what == "json")
        return edited, (what, attribute, str(edited.attrs[attribute])[:60])
    if what == "dropped":
        return dataset.drop_vars(name), (what, name)
    if what == "cut":
        dimension = draw.choice(list(dataset.sizes))
        return dataset.isel({dimension: slice(0, draw.randrange(4))}), (what, dimension)
    with np.errstate(all="ignore"):
        values = _edited_array(np.array(dataset[name].values), what, draw)
    return dataset.assign({name: (dataset[name].dims, values, dataset[name].attrs)}), (what, name)


def _edited_array(values, what, draw):
    if values.dtype.kind not in "fiub" or what == "type":
        return values.astype("U8")
    if what == "reversed":
        return values[..., ::-1]
    if what == "scaled":
        return (values * draw.choice([-1.0, 0.0, 1e-20, 1e20, 2.0])).astype(values.dtype)
    bad = np.asarray(draw.choice(BAD_NUMBERS[:2] if values.dtype.kind != "f" else BAD_NUMBERS))
    if what == "all":
        values[...] = bad.astype(values.dtype)
    elif values.size:
        values.flat[draw.randrange(values.size)] = bad.astype(values.dtype)
    return values


def _edited_text(value, draw, *, as_json):
    if as_json and isinstance(value, str):
        try:
            return edited_json(value, draw)
        except ValueError:
            pass
    if not isinstance(value, str) or not value or draw.random() < 0.3:
        return draw.choice(["", "null", "[]", "{}", "[" * 5000, 3, -1.0, np.array([1.0, 2.0]), "\x1b[31m"])
    return scrambled(value, draw)


def scrambled(text, draw):
    """Text with one to four of its characters replaced."""
    letters = list(text)
    for _ in range(draw.randrange(1, 5)):
        letters[draw.randrange(len(letters))] = draw.choice(string.printable)
    return "".join(letters)


def edited_json(text, draw):
    """JSON text with one of its values, at any level, replaced by another one."""
    root = inner = json.loads(text)
    if not isinstance(root, dict | list) or not root:
        return json.dumps(draw.choice(BAD_JSON))
    while True:
        key = draw.choice(list(inner)) if isinstance(inner, dict) else draw.randrange(len(inner))
        if isinstance(inner[key], dict | list) and inner[key] and draw.random() < 0.7:
            inner = inner[key]
            continue
        inner[key] = draw.choice(BAD_JSON)
        return json.dumps(root)
