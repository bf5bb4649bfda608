# Everything runs in .venv, with the versions of requirements.lock.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
RESULTS := results/line_contact
POINT_RESULTS := results/ball_contact
BEARING_RESULTS := results/bearing_6208
BROWSERS := chromium chromium-browser google-chrome google-chrome-stable chrome

export PIP_CONSTRAINT := $(CURDIR)/requirements.lock
export PIP_DISABLE_PIP_VERSION_CHECK := 1

.DEFAULT_GOAL := help
.PHONY: help install run app browser test slow thorough lint check coverage mutants format docs pages figures screenshots bench bench-release bench-compare bench-public lock packages wheel changes paper clean

help:
	@echo "make run     install and solve a contact and a bearing, with figures"
	@echo "make app     install and open the web app; options with: make app OPTIONS='--port 8100'"
	@echo "make browser install what the tests of the web app, reports, netlists and exports need: Chromium, pdftotext, ngspice, Octave"
	@echo "make test    install and run the tests"
	@echo "make slow    run the long tests; one of three parts of them with: make slow PART=2/3"
	@echo "make thorough  run them with all of their random examples, and others each time; takes hours"
	@echo "make check   format, lint, types, import contract and tests"
	@echo "make lint    the same without the tests"
	@echo "make coverage  run the tests and print the lines that none of them runs"
	@echo "make mutants  change operators and numbers of the source one at a time, and list the changes that no test notices; takes hours"
	@echo "make format  format the code"
	@echo "make docs    build the documentation, run its gallery; warnings are errors"
	@echo "make pages   build the documentation without its gallery and the figures of solved cases"
	@echo "make figures draw the figures of the README again"
	@echo "make screenshots  take the pictures of the web app for the documentation again"
	@echo "make bench   run the benchmarks and print their tables"
	@echo "make bench-release  record the times of this release in benchmarks/releases; compare them by make bench-compare"
	@echo "make packages  build wheel and source distribution, and try them in a new environment"
	@echo "make wheel   build the wheel alone, and try it"
	@echo "make changes print the changelog of the next release from its fragments"
	@echo "make paper   build the PDF of the paper on the software; takes pandoc from the registry"
	@echo "make bench-public  solve a point contact with public packages too; takes them from the registry"

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "ehlectric takes Python 3.11 or later; name one with: make PYTHON=python3.12 ..."; exit 1; }
	$(PYTHON) -m venv $(VENV)

$(VENV)/.run: $(BIN)/python pyproject.toml requirements.lock
	$(BIN)/python -m pip install --quiet --editable .
	@touch $@

$(VENV)/.app: $(BIN)/python pyproject.toml requirements.lock
	$(BIN)/python -m pip install --quiet --editable ".[app]"
	@touch $@

$(VENV)/.test: $(BIN)/python pyproject.toml requirements.lock
	$(BIN)/python -m pip install --quiet --editable ".[test]"
	@touch $@

$(VENV)/.dev: $(BIN)/python pyproject.toml requirements.lock
	$(BIN)/python -m pip install --quiet --editable ".[dev]"
	@touch $@

$(VENV)/.docs: $(BIN)/python pyproject.toml requirements.lock
	$(BIN)/python -m pip install --quiet --editable ".[docs,app,parquet,excel,calibration,scopes,cluster]"
	@touch $@

# All extras in one step, in place of one step for each command below. Python compiles what is used at its first use.
install: $(BIN)/python pyproject.toml requirements.lock
	$(BIN)/python -m pip install --quiet --no-compile --editable ".[dev,docs]"
	@touch $(VENV)/.run $(VENV)/.app $(VENV)/.test $(VENV)/.dev $(VENV)/.docs

run: $(VENV)/.run
	$(BIN)/ehlectric run examples/line_contact.toml -o $(RESULTS)
	$(BIN)/ehlectric bearing examples/bearing_6208.toml --contacts atlas -o $(BEARING_RESULTS)
	@echo "The figures are in $(CURDIR)/results:" && ls $(RESULTS)/*.png $(BEARING_RESULTS)/*.png

app: $(VENV)/.app
	$(BIN)/ehlectric app $(OPTIONS)

# Tests in a browser are skipped without one, unless EHLECTRIC_BROWSER is "required"; tests that read a PDF are
# skipped without pdftotext. Tests of netlists need ngspice, and those of exports Octave, as those in a browser need one.
browser:
	@missing=" chromium fonts-dejavu-core"; \
	for name in $(BROWSERS); do if command -v $$name; then missing=; break; fi; done; \
	command -v pdftotext || missing="$$missing poppler-utils"; \
	command -v ngspice || missing="$$missing ngspice"; \
	command -v octave-cli || missing="$$missing octave"; \
	if [ -z "$$missing" ]; then exit; fi; \
	if [ "$$(id -u)" = 0 ] && command -v apt-get > /dev/null; then \
	  apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -qq --no-install-recommends $$missing; \
	else \
	  echo "missing on this machine:$$missing; install them, as with: sudo apt-get install$$missing"; exit 1; \
	fi

test: $(VENV)/.test
	$(BIN)/python -m pytest

# All long tests, or one of three parts; tests/schedule.py says which tests a part has.
slow: $(VENV)/.test
	$(BIN)/python -m tests.schedule $(if $(PART),part,slow) --minutes 600

thorough: $(VENV)/.test
	EHLECTRIC_THOROUGH=1 $(BIN)/python -m pytest -m "not browser"

lint: $(VENV)/.dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python tools/lint_house.py
	$(BIN)/python -m tools.lint_prose

check: lint test

coverage: $(VENV)/.test
	$(BIN)/python -m pytest --cov --cov-report=term

# Where a stopped run left off; options with: make mutants OPTIONS='--rooms gear --number 100'
mutants: $(VENV)/.test
	nice $(BIN)/python -m tools.mutants $(OPTIONS)

format: $(VENV)/.dev
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

docs: $(VENV)/.docs
	$(BIN)/python -m sphinx -W --keep-going -n -q -b html docs docs/_build/html
	@echo "The documentation is in $(CURDIR)/docs/_build/html/index.html"

# The same without what takes minutes: the scripts of the gallery, and figures and tables of solved cases.
pages: $(VENV)/.docs
	EHLECTRIC_PAGES=only $(BIN)/python -m sphinx -W --keep-going -n -q -b html docs docs/_build/pages

figures: $(VENV)/.test
	$(BIN)/ehlectric run examples/line_contact.toml -o $(RESULTS) --quiet
	cp $(RESULTS)/film.png $(RESULTS)/field_strength.png docs/figures
	$(BIN)/ehlectric run examples/ball_contact.toml -o $(POINT_RESULTS) --quiet
	cp $(POINT_RESULTS)/field_map.png docs/figures
	$(BIN)/ehlectric run examples/mixed_contact.toml -o results/mixed_contact --quiet
	cp results/mixed_contact/spots.png docs/figures/mixed_spots.png
	$(BIN)/ehlectric sweep examples/sweep.toml -o results/sweep --quiet
	$(BIN)/ehlectric map results/sweep --x contact.entrainment_speed --y contact.load_per_length --quiet
	cp results/sweep/map_discharge.breakdown_voltage.png docs/figures/breakdown_map.png
	$(BIN)/ehlectric bearing examples/bearing_6208.toml --contacts atlas -o $(BEARING_RESULTS) --quiet
	cp $(BEARING_RESULTS)/breakdown_over_speed.png docs/figures
	$(BIN)/ehlectric sweep examples/bearing_regime_map.toml -o results/regimes --quiet
	$(BIN)/ehlectric map results/regimes --x bearing.inner_speed --y bearing.temperature --value bearing.contact_time_share --quiet
	cp results/regimes/map_bearing.contact_time_share.png docs/figures/bearing_regimes.png
	$(BIN)/ehlectric sweep examples/drive_map.toml -o results/drive_map --quiet
	$(BIN)/ehlectric map results/drive_map --x drive.speed --y drive.temperature --quiet
	cp results/drive_map/map_drive.events_per_second.png docs/figures/drive_map.png
	$(BIN)/ehlectric export $(POINT_RESULTS) -o results/ball.vtkhdf --quiet
	$(BIN)/python docs/_ext/vtk_picture.py results/ball.vtkhdf docs/figures/paraview.png

screenshots: $(VENV)/.test
	EHLECTRIC_SCREENSHOTS=$(CURDIR)/docs/figures/app EHLECTRIC_BROWSER=required \
	  $(BIN)/python -m pytest -q -n 0 -m slow tests/app/test_screenshots.py

bench: $(VENV)/.dev
	$(BIN)/python benchmarks/table.py

# Run on a machine that does nothing else; times of two machines compare by their ratios to the reference.
bench-release: $(VENV)/.dev
	mkdir -p benchmarks/releases
	$(BIN)/python -m pytest benchmarks/test_release.py -n 0 -q -W ignore --benchmark-columns=min,median,rounds \
	  --benchmark-json=benchmarks/releases/$$($(BIN)/ehlectric --version | cut -d ' ' -f 2).json

bench-compare: $(VENV)/.dev
	$(BIN)/pytest-benchmark compare benchmarks/releases/*.json --group-by=name --columns=min,median,rounds

bench-public: $(VENV)/.dev
	$(BIN)/python benchmarks/public_solvers.py

lock:
	uv pip compile pyproject.toml --extra dev --extra docs --extra instruments --extra parquet --extra cluster --extra calibration --extra scopes --extra app --universal --python-version 3.11 --no-header --quiet --output-file requirements.lock
	uv pip compile pyproject.toml packaging/build.in --extra app --extra excel --extra parquet --extra cluster --extra calibration --extra scopes --universal --python-version 3.11 --no-header --quiet --constraint requirements.lock --generate-hashes --output-file requirements.hashes

# PDF of the paper on the software, by pandoc and typst from the registry.
paper: $(VENV)/.dev
	$(BIN)/python -m pip install --quiet pypandoc_binary typst
	$(BIN)/python paper/build.py

# Both packages from the source, and what users do with them in an empty folder and a new environment: with the
# hashed versions of requirements.hashes, or with VERSIONS=newest.
packages: $(VENV)/.dev
	rm -rf dist
	$(BIN)/python -m hatchling build --directory dist
	packaging/try.sh dist $(PYTHON)

# The wheel alone, tried in the same way.
wheel: $(VENV)/.dev
	rm -rf dist
	$(BIN)/python -m hatchling build --target wheel --directory dist
	packaging/try.sh dist $(PYTHON)

# The section of the next release as towncrier will write it; it writes no file.
changes: $(VENV)/.dev
	$(BIN)/towncrier build --draft --version unreleased

clean:
	rm -rf $(VENV) build dist results docs/_build docs/_generated docs/auto_gallery docs/api/generated .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .coverage
