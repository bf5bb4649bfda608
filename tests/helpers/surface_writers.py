"""Writers of X3P and AL3D files for tests, valid or with any value wrong."""

import struct
import zipfile

import numpy as np

MAP = 1e-8 * np.random.default_rng(0).standard_normal((20, 31))
KINDS = {"D": "<f8", "F": "<f4", "L": "<i4", "I": "<i2"}


def description(heights, *, valid=False, encoding="UTF-8", **changes):
    """XML description of an X3P file with changed values; None removes a value."""
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
        f"{tags('SizeX', 'SizeY', 'SizeZ')}</MatrixDimension><DataLink>"
        f"{tags('PointDataLink', 'ValidPointsLink')}</DataLink></Record3></p:ISO5436_2>"
    )


def x3p(path, heights, *, mask=None, pack=zipfile.ZIP_STORED, data=None, **changes):
    kind = KINDS.get(changes.get("CZ_DataType", "D"), "<f8")
    with zipfile.ZipFile(path, "w", pack) as archive:
        archive.writestr("main.xml", description(heights, valid=mask is not None, **changes))
        archive.writestr("bindata/data.bin", heights.astype(kind).tobytes() if data is None else data)
        if mask is not None:
            archive.writestr("bindata/valid.bin", mask)
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
