# One environment (.venv), made on first use and again when pyproject.toml changes.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.made

.PHONY: demo test lint types contract unit wheel foreign mutants bench motion-campaign driver-day driver-days runtime-mutants clean

demo: $(STAMP)
	$(BIN)/rapidgen demo

test: lint types contract wheel driver-day unit

$(STAMP): pyproject.toml
	test -x $(BIN)/python || $(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --upgrade "pip>=25.1"
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --group dev --editable .
	touch $@

lint: $(STAMP)
	$(BIN)/ruff check
	$(BIN)/ruff format --check

types: $(STAMP)
	$(BIN)/mypy

contract: $(STAMP)
	$(BIN)/lint-imports

# The wheel, in an environment of its own, does the demo: templates/ and robots/ travel. What it
# depends on is kept from run to run; the wheel itself is always new.
WHEEL := build/wheel
wheel: $(STAMP) $(WHEEL)/env/.made
	rm -rf $(WHEEL)/dist $(WHEEL)/demo
	$(BIN)/python -m build --wheel --no-isolation --outdir $(WHEEL)/dist . >$(WHEEL)/build.log 2>&1 || (cat $(WHEEL)/build.log; false)
	$(WHEEL)/env/bin/python -m pip install --quiet --disable-pip-version-check --force-reinstall --no-deps $(WHEEL)/dist/*.whl
	cd $(WHEEL) && env/bin/rapidgen demo --output demo

$(WHEEL)/env/.made: pyproject.toml $(STAMP)
	rm -rf $(WHEEL)/env $(WHEEL)/dist && mkdir -p $(WHEEL)
	$(PYTHON) -m venv $(WHEEL)/env
	$(BIN)/python -m build --wheel --no-isolation --outdir $(WHEEL)/dist . >$(WHEEL)/build.log 2>&1 || (cat $(WHEEL)/build.log; false)
	$(WHEEL)/env/bin/python -m pip install --quiet --disable-pip-version-check $(WHEEL)/dist/*.whl
	touch $@

# Last, so that pytest's own summary closes the output.
unit: $(STAMP)
	$(BIN)/python -m pytest -n auto

# Trials of programs that are no part of this project: FOREIGN is the folder that holds them,
# PROGRAM the trial (abb_driver, ros_nodes, godel, irb140, keyence, motion_program_exec, open_abb, rfl, text_servers; default: any).
PROGRAM = trial
foreign: $(STAMP)
	$(BIN)/python -m tests.foreign.$(PROGRAM) $(FOREIGN)

# Has each conformance file of the language a defect that turns it red? Some minutes on one core.
mutants: $(STAMP)
	$(BIN)/python benchmarks/conformance_mutants.py

# Those that take minutes and need nothing; the others are campaigns, or need an argument.
BENCHES := startup parsing kernels backup motion state client deploy driver streaming
bench: $(STAMP)
	for name in $(BENCHES); do $(BIN)/python benchmarks/$$name.py || exit 1; done

# 10,000 random programs with random stops: some 5 minutes. The tests run a few of them.
motion-campaign: $(STAMP)
	$(BIN)/python -m tests.motion.campaign

# The generated driver for 24 simulated hours: a trajectory every ten minutes, a client that reads
# the state for a quarter of the time. A minute.
driver-day: $(STAMP)
	$(BIN)/python benchmarks/campaign.py days --hours 24 --watched 0.25

# 30 simulated days, the state read all the time: an hour and more.
driver-days: $(STAMP)
	$(BIN)/python benchmarks/campaign.py days --hours 720

# A mutant of the runtime for each of its conformance files: some 15 minutes. The tests run a sample.
runtime-mutants: $(STAMP)
	$(BIN)/python benchmarks/conformance_mutants_runtime.py

clean:
	rm -rf $(VENV) build dist .mypy_cache .ruff_cache .pytest_cache
