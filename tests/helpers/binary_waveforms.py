"""Writers of binary waveforms by the published formats, independent of the libraries that read them."""

import struct

import numpy as np


def mat(variables):
    """MAT-file of version 5 (MathWorks, "MAT-File Format"): a double array for each name, uncompressed."""
    content = b"MATLAB 5.0 MAT-file".ljust(124) + struct.pack("<H2s", 0x0100, b"IM")
    for name, array in variables.items():
        array = np.atleast_2d(np.asarray(array))
        kind, code, form = (9, 6, "<f8") if array.dtype.kind == "f" else (3, 10, "<i2")
        parts = [
            (6, struct.pack("<II", code, 0)),
            (5, struct.pack("<ii", *array.shape)),
            (1, name.encode()),
            (kind, array.astype(form).tobytes(order="F")),
        ]
        inside = b"".join(
            struct.pack("<II", key, len(data)) + data + b"\0" * (-len(data) % 8) for key, data in parts
        )
        content += struct.pack("<II", 14, len(inside)) + inside
    return content


def tdms(channels, group="scope"):
    """TDMS file of one segment (NI, "TDMS File Format Internal Structure").

    ``channels`` are numbers and properties by the name of the channel.
    """

    def text(string):
        return struct.pack("<I", len(string.encode())) + string.encode()

    def properties(values):
        packed = [struct.pack("<I", len(values))]
        for key, value in values.items():
            form = (
                struct.pack("<I", 0x20) + text(value)
                if isinstance(value, str)
                else struct.pack("<Id", 10, value)
            )
            packed.append(text(key) + form)
        return b"".join(packed)

    objects = [text("/") + struct.pack("<I", 0xFFFFFFFF) + properties({})]
    objects.append(text(f"/'{group}'") + struct.pack("<I", 0xFFFFFFFF) + properties({}))
    data = b""
    for name, (numbers, known) in channels.items():
        numbers = np.asarray(numbers)
        code = 10 if numbers.dtype.kind == "f" else 2  # double, or 16 bits
        index = struct.pack("<IIIQ", 20, code, 1, numbers.size)
        objects.append(text(f"/'{group}'/'{name}'") + index + properties(known))
        data += numbers.astype("<f8" if code == 10 else "<i2").tobytes()
    meta = struct.pack("<I", len(objects)) + b"".join(objects)
    return b"TDSm" + struct.pack("<IIQQ", 0b1110, 4713, len(meta) + len(data), len(meta)) + meta + data


def trc(counts, *, gain, offset, interval, start, unit="V", segments=1, kind=0, order="<"):
    """Waveform of LeCroy after the template LECROY_2_3, with a prefix as a transfer adds it."""
    data = np.asarray(counts).astype(f"{order}i2").tobytes()
    header = bytearray(346)
    fields = {
        (0, "16s"): b"WAVEDESC", (16, "16s"): b"LECROY_2_3", (32, "H"): 1, (34, "H"): int(order == "<"),
        (36, "i"): 346, (60, "i"): len(data), (76, "16s"): b"LECROYTEST", (116, "i"): len(counts),
        (144, "i"): segments, (156, "f"): gain, (160, "f"): offset, (164, "f"): 32767, (168, "f"): -32768,
        (172, "h"): 16, (176, "f"): interval, (180, "d"): start, (196, "48s"): unit.encode(),
        (244, "48s"): b"S", (316, "H"): kind, (328, "f"): 1.0,
    }  # fmt: skip
    for (place, form), value in fields.items():
        struct.pack_into(order + form, header, place, value)
    return b"#9%09d" % (len(header) + len(data)) + bytes(header) + data


def isf(counts, *, interval, start, factor, offset=0.0, zero=0.0, unit="V", form="Y", sign="RI"):
    """Waveform of Tektronix: preamble and curve of the programmer manual of TDS3000."""
    data = np.asarray(counts).astype(">i2").tobytes()
    preamble = (
        f':WFMP:BYT_N 2;BIT_N 16;ENC BIN;BN_F {sign};BYT_O MSB;NR_P {len(counts)};WFI "Ch1, DC coupling";'
        f'PT_F {form};XIN {interval:.4E};PT_O 0;XZE {start:.4E};XUN "s";YMU {factor:.4E};YZE {zero:.4E};'
        f'YOF {offset:.4E};YUN "{unit}";:CURV #{len(str(len(data)))}{len(data)}'
    )
    return preamble.encode() + data + b"\n"
