"""mypy finds swapped arguments in the calls of the package, with the settings of the package."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]

# Module, part of a call in it, and this part with two arguments swapped.
SWAPS = {
    "formulas/hertz.py": (
        "line_half_width(load_per_length=load_per_length, radius=radius, modulus=modulus)",
        "line_half_width(radius, load_per_length, modulus)",
    ),
    "formulas/film_line.py": ("below_both(rp, ep, 7 / 2)", "below_both(7 / 2, ep, rp)"),
    "contact/conditions.py": (
        "reduced_radius=self.reduced_radius,\n            reduced_modulus=self.reduced_modulus,",
        "self.reduced_modulus,\n            self.reduced_radius,",
    ),
    "bearing/loads/ball_loads.py": (
        "Batch.of(bearing, operation, modulus, density, able)",
        "Batch.of(bearing, operation, modulus, able, density)",
    ),
    "bearing/loads/thrust_balls.py": (
        "mass=of_batch.element_mass(batch.density),\n        pitch_diameter=of_batch.pitch_diameter,",
        "of_batch.pitch_diameter,\n        of_batch.element_mass(batch.density),",
    ),
}


def errors_of(folder, shadows):
    """Errors of mypy by module, with other texts of some modules."""
    # The cache takes a module of equal size for the one that it has: each run has a cache of its own.
    cache = folder / f"cache-{len(shadows)}"
    modules = [f"src/ehlectric/{name}" for name in SWAPS]
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--follow-imports",
        "silent",
        "--cache-dir",
        str(cache),
    ]
    for path, text in shadows.items():
        other = folder / path.replace("/", "_")
        other.write_text(text, encoding="utf-8")
        command += ["--shadow-file", f"src/ehlectric/{path}", str(other)]
    done = subprocess.run([*command, *modules], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    lines = re.findall(r"^src/ehlectric/(\S+?):\d+: error: (.*)$", done.stdout, re.MULTILINE)
    return {name: [text for path, text in lines if path == name] for name in SWAPS}


@pytest.mark.slow
def test_a_swapped_argument_is_an_error(tmp_path):
    texts = {path: (ROOT / "src/ehlectric" / path).read_text(encoding="utf-8") for path in SWAPS}
    for path, (call, _) in SWAPS.items():
        assert texts[path].count(call) == 1, path
    assert not any(errors_of(tmp_path, {}).values())
    swapped = {path: text.replace(*SWAPS[path]) for path, text in texts.items()}
    errors = errors_of(tmp_path, swapped)
    assert all(errors.values()), errors
