"""Writers of X3P, AL3D, PLUX and WSxM files for tests, valid or with any value wrong."""

import struct
import zipfile

import numpy as np

MAP = 1e-8 * np.random.default_rng(0).standard_normal((20, 31))
KINDS = {"D": "<f8", "F": "<f4", "L": "<i4", "I": "<i2"}


def description(heights, *, valid=False, encoding="UTF-8", items=(), **changes):
    """XML description of an X3P file with changed values and a list of heights; None removes a value."""
    rows, columns = heights.shape
    values = {
        "FeatureType": "SUR", "CX/AxisType": "I", "CX/Increment": "1.5e-7", "CY/AxisType": "I",
        "CY/Increment": "3e-7", "CZ/AxisType": "A", "CZ/DataType": "D", "SizeX": columns, "SizeY": rows,
        "SizeZ": 1, "PointDataLink": "bindata/data.bin",
        "ValidPointsLink": "bindata/valid.bin" if valid else None,
    } | {key.replace("_", "/"): value for key, value in changes.items()}  # fmt: skip

    def tags(*names):
        texts = {name: values.get(name) for name in names}
        return "".join(
            f"<{name.split('/')[-1]}>{text}</{name.split('/')[-1]}>"
            for name, text in texts.items()
            if text is not None
        )

    keys = ("AxisType", "DataType", "Increment", "Offset")
    axes = "".join(
        f"<{axis}>{tags(*(f'{axis}/{key}' for key in keys))}</{axis}>" for axis in ("CX", "CY", "CZ")
    )
    return (
        f'<?xml version="1.0" encoding="{encoding}"?><p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">'
        f"<Record1>{tags('FeatureType')}<Axes>{axes}</Axes></Record1><Record3><MatrixDimension>"
        f"{tags('SizeX', 'SizeY', 'SizeZ')}</MatrixDimension>"
        + (
            "<DataList>" + "".join(f"<Datum>{item}</Datum>" for item in items) + "</DataList>"
            if items
            else ""
        )
        + f"<DataLink>{tags('PointDataLink', 'ValidPointsLink')}</DataLink></Record3></p:ISO5436_2>"
    )


def x3p(path, heights, *, mask=None, pack=zipfile.ZIP_STORED, data=None, folder="", **changes):
    kind = KINDS.get(changes.get("CZ_DataType", "D"), "<f8")
    with zipfile.ZipFile(path, "w", pack) as archive:
        archive.writestr(f"{folder}main.xml", description(heights, valid=mask is not None, **changes))
        archive.writestr(
            f"{folder}bindata/data.bin", heights.astype(kind).tobytes() if data is None else data
        )
        if mask is not None:
            archive.writestr(f"{folder}bindata/valid.bin", mask)
    return path


def al3d(path, heights=MAP, **changes):
    tags = {
        "Version": "1", "Cols": str(heights.shape[1]), "Rows": str(heights.shape[0]),
        "DepthImageOffset": "1000", "PixelSizeXMeter": "4.4e-7", "PixelSizeYMeter": "4.4e-7",
        "InvalidPixelValue": "1e30",
    } | changes  # fmt: skip
    head = b"AliconaImaging\0\r\n"
    for name, value in tags.items():
        head += struct.pack("20s30s2s", name.encode(), value.encode(), b"\r\n")
    padded = np.zeros((heights.shape[0], heights.shape[1] + heights.shape[1] % 2), "<f4")
    padded[:, : heights.shape[1]] = heights
    path.write_bytes(head.ljust(1000, b"\0") + padded.tobytes())
    return path


def plux(path, heights, spacing):
    """Sensofar PLUX: a ZIP archive with index.xml, and float32 heights in micrometres."""
    rows, columns = heights.shape
    size = f"<IMAGE_SIZE_X>{columns}</IMAGE_SIZE_X><IMAGE_SIZE_Y>{rows}</IMAGE_SIZE_Y>"
    step = f"<FOV_X>{spacing * 1e6}</FOV_X><FOV_Y>{spacing * 1e6}</FOV_Y>"
    index = (
        f"<xml><GENERAL><DATE>2001-01-01 10:00:00</DATE>{size}{step}</GENERAL><LAYER_0><FILENAME_Z>"
        "LAYER_0.raw</FILENAME_Z></LAYER_0><INFO><ITEM_0><NAME>Device</NAME><VALUE>S</VALUE></ITEM_0></INFO></xml>"
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("index.xml", index)
        archive.writestr("LAYER_0.raw", (heights * 1e6).astype("<f4").tobytes())
    return path


def wsxm(path, heights, spacing):
    """WSxM: a head of more than 4096 bytes of text, then float64 heights, which the head scales."""
    rows, columns = heights.shape
    high, low = float(1e9 * np.max(heights)), float(1e9 * np.min(heights))
    remarks = "".join(f"    Note {number}: none\r\n" for number in range(300))
    text = (
        f"[Remarks]\r\n{remarks}[Control]\r\n    X Amplitude: {1e6 * spacing * columns} um\r\n"
        f"    Y Amplitude: {1e6 * spacing * rows} um\r\n[General Info]\r\n    Image Data Type: double\r\n"
        f"    Number of columns: {columns}\r\n    Number of rows: {rows}\r\n"
        f"    Z Amplitude: {high - low!r} nm\r\n[Miscellaneous]\r\n    Maximum: {high!r}\r\n"
        f"    Minimum: {low!r}\r\n    Comments: x\r\n    Version: 1.0 (June 2001)\r\n[Header end]\r\n"
    )
    first = "WSxM file copyright UAM\r\nSxM Image file\r\nImage header size: "
    size = len(first) + len(text) + 6
    path.write_bytes(f"{first}{size}\r\n{text}".encode() + (1e9 * heights).astype("<f8").tobytes())
    return path
