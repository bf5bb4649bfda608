#!/usr/bin/env bash
# What a user does with the wheel of a folder, in an empty folder and a new environment: try.sh DIST [PYTHON]
set -euo pipefail
dist=$(cd "$1" && pwd)
python=${2:-python3}
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
"$python" -m venv "$place/environment"
# The newest versions that the dependencies allow, not those of the lock.
unset PIP_CONSTRAINT
"$place/environment/bin/python" -m pip install --quiet "$(ls "$dist"/*.whl)[app,excel]"
PATH="$place/environment/bin:$PATH"
unset PYTHONPATH
mkdir "$place/folder"
cd "$place/folder"
ehlectric --version
python -c 'import ehlectric, pathlib; print(pathlib.Path(ehlectric.__file__).parent)'
ehlectric examples -o . --quiet
ehlectric run line_contact.toml -o line --quiet
ehlectric run rough_contact.toml -o rough --quiet --no-plots
ehlectric bearing bearing_6208.toml --contacts atlas -o bearing --quiet
ehlectric drive drive.toml -o drive --quiet
ehlectric report bearing --quiet
ehlectric spice drive.toml -o bearings.lib --bench bench.cir --quiet
for kind in mat xlsx vtkhdf; do ehlectric export line -o "line.$kind"; done
ehlectric init mine.toml --kind bearing --quiet
ehlectric check mine.toml > /dev/null
# The app answers on a free port, and ends.
python - <<'CHECK'
import re
import signal
import subprocess
import urllib.request

app = subprocess.Popen(["ehlectric", "app", "--no-browser", "--port", "0"], stdout=subprocess.PIPE, text=True)
line = app.stdout.readline()
address = re.search(r"http://\S+", line)[0]
page = urllib.request.urlopen(address, timeout=60).read().decode()
assert "ehlectric" in page, page[:200]
app.send_signal(signal.SIGINT)
app.wait(60)
print("app:", address, f"{len(page)} characters")
CHECK
ls
