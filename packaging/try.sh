#!/usr/bin/env bash
# What a user does with the packages of a folder, in an empty folder and a new environment: try.sh DIST [PYTHON]
# The versions are those of requirements.hashes, each file checked by its hash; the newest that the dependencies
# allow with VERSIONS=newest.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
dist=$(cd "$1" && pwd)
python=${2:-python3}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
unset PYTHONPATH PIP_CONSTRAINT
"$python" -m venv "$place/environment"
PATH="$place/environment/bin:$PATH"
wheel=$(ls "$dist"/*.whl)
if [ "${VERSIONS:-}" = newest ]; then
  pip install --quiet "${wheel}[app,excel]"
else
  # What is used is compiled at its first use.
  pip install --quiet --no-compile --require-hashes --requirement "$root/requirements.hashes"
  pip install --quiet --no-deps "$wheel"
fi
pip check
mkdir "$place/folder"
cd "$place/folder"

ehlectric --version
python -c 'import ehlectric; print(ehlectric.__file__)' | grep --fixed-strings "$place"
ehlectric examples -o . --quiet
ehlectric run line_contact.toml -o line --quiet
ehlectric run rough_contact.toml -o rough --quiet --no-plots
ehlectric bearing bearing_6208.toml --contacts atlas -o bearing --quiet
ehlectric drive drive.toml -o drive --quiet
ehlectric sweep sweep.toml -o sweep --quiet
ehlectric map sweep --x contact.entrainment_speed --y contact.load_per_length --quiet
ehlectric surface surfaces/dektak-1.csv > /dev/null
ehlectric report bearing --quiet
ehlectric spice drive.toml -o bearings.lib --bench bench.cir --quiet
for kind in mat xlsx vtkhdf; do ehlectric export line -o "line.$kind"; done
ehlectric init mine.toml --kind bearing --quiet
ehlectric check mine.toml > /dev/null
python - <<'PYTHON'
import ehlectric

result = ehlectric.solve("ball_contact.toml")
assert 1e-7 < result.film.minimum_thickness < 1e-5, result
result.plot()
print(result)
PYTHON

# The app answers on a free port, and ends.
python - <<'PYTHON'
import re
import signal
import subprocess
import threading
import urllib.request

words = ["ehlectric", "app", "--no-browser", "--port", "0"]
with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as app:
    end = threading.Timer(120, app.kill)
    end.start()
    try:
        address = re.search(r"http://\S+", app.stdout.readline())[0]
        page = urllib.request.urlopen(address, timeout=60).read().decode()
        assert "ehlectric" in page, page[:200]
        app.send_signal(signal.SIGINT)
        app.wait(60)
    finally:
        app.kill()
        end.cancel()
print("app:", address, f"{len(page)} characters")
PYTHON
ls

ls "$dist"/*.tar.gz > /dev/null 2>&1 || exit 0

# The same from the source distribution, where there is one, as recipes of other packagers build it.
if [ "${VERSIONS:-}" = newest ]; then
  pip install --quiet hatchling
fi
pip install --quiet --no-deps --no-build-isolation --force-reinstall "$dist"/*.tar.gz
ehlectric --version
ehlectric check bearing_6208.toml | tail -n 3
