"""Writes the files of this folder: python tests/data/waveforms/written.py"""

import math
from pathlib import Path

STEP, START = 4e-9, -80e-9
VOLTS = [round(4.0 * math.sin(2.0 * math.pi * k / 16.0) + k / 100.0, 3) for k in range(48)]
TIMES = [START + k * STEP for k in range(48)]
ROWS = list(zip(TIMES, VOLTS, strict=True))

KEYS = [
    ("Record Length", "4.800000e+01"),
    ("Sample Interval", "4.000000e-09"),
    ("Trigger Point", "2.000000000000e+01"),
    ("", ""),
    ("", ""),
    ("", ""),
    ("Source", "CH1"),
    ("Vertical Units", "V"),
    ("Vertical Scale", "2.000000e+00"),
    ("Vertical Offset", "0.000000e+00"),
    ("Horizontal Units", "s"),
    ("Horizontal Scale", "1.000000e-08"),
    ("Pt Fmt", "Y"),
    ("Yzero", "0.000000e+00"),
    ("Probe Atten", "1.000000e+01"),
    ("Model Number", "TDS2014"),
    ("Serial Number", "C000000"),
    ("Firmware Version", "FV:v0.00"),
]
PADDED = KEYS + [("", "")] * (48 - len(KEYS))

FILES = {
    "tektronix_tds2000.csv": [
        f"{key},{value},,{t:017.12f},{v:10.5f}," for (key, value), (t, v) in zip(PADDED, ROWS, strict=True)
    ],
    "tektronix_mso4000.csv": [
        "Model,DPO4054",
        "Firmware Version,2.00",
        "",
        "Waveform Type,ANALOG,",
        "Point Format,Y,",
        "Horizontal Units,S,",
        "Horizontal Scale,4e-08,",
        "Horizontal Delay,0,",
        "Sample Interval,4e-09,",
        "Record Length,48,",
        "Gating,0.0% to 100.0%,",
        "Probe Attenuation,10,",
        "Vertical Units,V,",
        "Vertical Offset,0,",
        "Vertical Scale,2,",
        "Label,,",
        "TIME,CH1,CH1 Peak Detect",
        *(f"{t:.7e},{v:g}," for t, v in ROWS),
    ],
    "keysight_infiniivision.csv": [
        "x-axis,1,2",
        "second,Volt,Volt",
        *(f"{t * 1e9:+.2f}E-09,{v:+.4E},{2 * v:+.4E}" for t, v in ROWS),
    ],
    "rigol_ds1000z.csv": [
        "X,CH1,Start,Increment,",
        f"Sequence,Volt,{START:.6e},{STEP:.6e}",
        *(f"{k},{v:.2e}," if v == round(v, 2) else f"{k},{v:.3e}," for k, v in enumerate(VOLTS)),
    ],
    "lecroy_spreadsheet.csv": [
        "LECROY9354,93540000",
        "Segments,1,SegmentSize,48",
        "Segment,TrigTime,TimeSinceSegment1",
        "#1,21-Mar-2026 09:37:08,0",
        "Time,Ampl",
        *(f"{t:.5e},{v:g}" for t, v in ROWS),
    ],
    "picoscope.csv": [
        "Time,Channel A,Channel B",
        "(us),(V),(mV)",
        "",
        *(f"{t * 1e6:.8f},{v:.8f},{2000 * v:.8f}" for t, v in ROWS),
    ],
    "picoscope_german.csv": [
        "Zeit;Kanal A",
        "(ns);(mV)",
        "",
        *(f"{t * 1e9:.8f};{1000 * v:.8f}".replace(".", ",") for t, v in ROWS),
    ],
    "siglent_sds1000.csv": [
        "Record Length,Analog:48",
        "Sample Rate,250000000.0",
        "Vertical Scale,CH1: 2.00",
        "Vertical Offset,CH1:0.00000",
        "Horizontal Scale, 0.000000020",
        "Second,Value",
        *(f"{t:.11f},{v:.5f}" for t, v in ROWS),
    ],
    "rohde_schwarz_rtm.csv": ["in s,C1 in V", *(f"{t:.6E},{v:.5E}" for t, v in ROWS)],
}

if __name__ == "__main__":
    for name, lines in FILES.items():
        (Path(__file__).parent / name).write_text("\r\n".join(lines) + "\r\n", encoding="utf-8", newline="")
