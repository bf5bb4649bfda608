"""Time of the answers of the app in a real browser, in this tree and in another one.

``python -m benchmarks.app_answers`` starts the command ``ehlectric app`` ``RUNS`` times, opens its first page
in a new profile of Chromium without a window, and moves the slider of the radial load; with the folder of
another tree as argument, whose environment is in its ``.venv``, alternately in both. It prints medians and
the lowest values, the sum of the layout shifts, the bytes that a step sends, and the load of the machine.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from statistics import median
from typing import Any

from benchmarks.measure import ROOT

# Starts of the command in each tree after a first one that is not counted, and steps of the slider in each.
RUNS, STEPS = 5, 6

# Rests of the page before a step [ms]: the whole answer is there by then.
_REST = 3500

_ADDRESS = re.compile(r"ehlectric is at (http://\S+)")

_FLAGS = ("--no-sandbox", "--disable-background-networking", "--disable-component-update", "--no-first-run")

# Notes the time of what is seen first [ms since 1970], and the layout shifts.
_WATCH = """
window.seen = {}; window.shifts = 0; window.shifted = [];
new PerformanceObserver(list => list.getEntries().forEach(entry => {
  if (entry.hadRecentInput) return;
  window.shifts += entry.value;
  window.shifted.push([entry.startTime, entry.value, ...entry.sources.map(({node}) =>
    node && (node.className || node.dataset?.testid || node.nodeName))]);
})).observe({type: 'layout-shift', buffered: true});
const text = selector => document.querySelector(selector)?.textContent ?? '';
const waited = {
  'page': () => document.querySelector('[data-testid=verdict]'),
  'verdict': () => document.querySelector('[data-testid=verdict][data-level]'),
  'verdict with probability': () => /%/.test(text('.facts')),
  'critical speed': () => /\\d/.test(text('[data-testid="number-margin.critical_speed"] .value')),
  'curves over the speed': () =>
    document.querySelector('[data-testid=figure-breakdown] .scatterlayer .trace'),
};
const look = () => {
  for (const [name, is] of Object.entries(waited))
    if (!(name in window.seen) && is()) window.seen[name] = performance.timeOrigin + performance.now();
  requestAnimationFrame(look);
};
requestAnimationFrame(look);
"""

# Moves a slider by a step; the time to new numbers, to a new figure around the shaft and to new curves over
# the speed [ms], each seen in the frame in which it is painted.
_STEP = """
step => new Promise(done => {
  const text = selector => document.querySelector(selector)?.textContent ?? '';
  const path = selector => [...document.querySelectorAll(selector)].map(one => one.getAttribute('d')).join();
  const looks = {
    numbers: () => text('.deciding .value') + text('[data-testid="number-bearing.capacitance"] .value'),
    figures: () => path('[data-testid=figure-load] :is(.scatterlayer, .barlayer) path'),
    curves: () => path('[data-testid=figure-breakdown] .scatterlayer path'),
    probability: () => text('.facts'),
  };
  const before = Object.fromEntries(Object.entries(looks).map(([name, look]) => [name, look()]));
  const times = {}, start = performance.now();
  const slider = document.querySelector('[data-testid=slider-bearing-radial_load]');
  slider.value = String(Number(slider.value) + step);
  slider.dispatchEvent(new Event('input', {bubbles: true}));
  const look = () => {
    const now = performance.now() - start;
    for (const [name, is] of Object.entries(looks)) {
      const seen = is();
      if (!(name in times) && seen !== before[name] && !seen.includes('…')) times[name] = now;
    }
    if (Object.keys(times).length === Object.keys(looks).length || now > 8000) done(times);
    else requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
})
"""


@contextmanager
def _served(tree: Path) -> Iterator[tuple[float, str]]:
    """Time at which the command is started in a tree [s since 1970], and the address that it prints."""
    with tempfile.TemporaryDirectory() as folder:
        program = [str(tree / ".venv" / "bin" / "ehlectric"), "app", "--no-browser", "--port", "0"]
        start = time.time()
        server = subprocess.Popen(program, cwd=folder, stdout=subprocess.PIPE, text=True)
        try:
            assert server.stdout is not None
            address = _ADDRESS.match(server.stdout.readline())
            assert address is not None
            yield start, address[1]
        finally:
            server.send_signal(signal.SIGINT)
            server.communicate()


def measured(chromium: Any, tree: Path, *, width: int = 1280, steps: int = STEPS) -> dict[str, float]:
    """Times of the answers of a tree [s], and other sizes by their names with units."""
    sizes: list[int] = []
    with _served(tree) as (start, address):
        ready = time.time() - start
        context = chromium.new_context(viewport={"width": width, "height": 900})
        page = context.new_page()
        page.add_init_script(_WATCH)
        page.on(
            "websocket", lambda socket: socket.on("framereceived", lambda frame: sizes.append(len(frame)))
        )
        page.goto(address, wait_until="commit")
        page.wait_for_function("() => Object.keys(window.seen).length === 5", timeout=60_000)
        page.wait_for_timeout(_REST)
        seen = page.evaluate("() => window.seen")
        found = {"server ready": ready} | {name: at / 1e3 - start for name, at in seen.items()}
        found["layout shift []"] = page.evaluate("() => window.shifts")
        if os.environ.get("SHIFTED"):
            print(width, page.evaluate("() => JSON.stringify(window.shifted)"))
        stepped = []
        # In one direction: answers to earlier inputs are kept.
        for _ in range(steps):
            before = sum(sizes)
            stepped.append(page.evaluate(_STEP, -1))
            page.wait_for_timeout(_REST)
            stepped[-1]["sent"] = sum(sizes) - before
        context.close()
    for name in ("numbers", "figures", "curves", "probability"):
        times = [step[name] for step in stepped if name in step]
        if times:
            found[f"step to {name}"] = median(times) / 1e3
    if stepped:
        found["step sends [kB]"] = median(step["sent"] for step in stepped) / 1e3
    return found


def main() -> None:
    """Print a table of all times."""
    from playwright.sync_api import sync_playwright

    if os.environ.get("PYTHONDONTWRITEBYTECODE"):
        sys.exit("unset PYTHONDONTWRITEBYTECODE: without it each run would compile the modules again")
    trees = [ROOT, *map(Path, sys.argv[1:])]
    program = shutil.which("chromium") or shutil.which("google-chrome")
    load = [os.getloadavg()[0]]
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=program, args=list(_FLAGS))
        for tree in trees:
            measured(chromium, tree, steps=0)
        rows = []
        for _ in range(RUNS):
            rows.append([measured(chromium, tree) for tree in trees])
            load.append(os.getloadavg()[0])
        narrow = [measured(chromium, tree, width=400, steps=0) for tree in trees]
        chromium.close()
    print(f"load of the machine {load[0]:.1f} before, {min(load[1:]):.1f} to {max(load[1:]):.1f} meanwhile")
    for name in rows[0][0]:
        texts = []
        for number, tree in enumerate(trees):
            values = [row[number][name] for row in rows if name in row[number]]
            texts.append(f"{tree.name} {median(values):7.3f} (lowest {min(values):.3f})")
        print(f"{name:26} {'   '.join(texts)}")
    shifts = "   ".join(
        f"{tree.name} {found['layout shift []']:7.3f}" for tree, found in zip(trees, narrow, strict=True)
    )
    print(f"{'layout shift, 400 px []':26} {shifts}")


if __name__ == "__main__":
    main()
