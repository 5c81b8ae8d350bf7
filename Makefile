# One environment (.venv), made on first use and again when pyproject.toml changes.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.made
# `time` of bash says what each step costs.
SHELL := /bin/bash
export TIMEFORMAT = %U s of CPU, %R s
# Where it is set, each of the hundreds of processes of a test run compiles all modules that it imports.
unexport PYTHONDONTWRITEBYTECODE

.PHONY: ros-tests demo environment release lock test test-long lint types import-contract unit stall-test pause-test wheel page driver-soak site release-lint changelog check diagrams interop campaigns clean

# Needs rapidgen and its page only, which come with a line every few seconds; `make test` adds the rest. The robot moves
# in the page until Ctrl-C, or for 30 s where there is no terminal.
RUNS := $(VENV)/.runs
demo:
	@$(MAKE) --no-print-directory --jobs 2 page $(if $(wildcard $(STAMP)),$(STAMP),$(RUNS))
	@$(BIN)/rapidgen demo

$(RUNS): pyproject.toml
	@PYTHON="$(PYTHON)" .ci/environment $(VENV) --editable '.[web]'
	@touch $@

# What takes one core is done side by side, each with its output in one piece; then the tests, which take them all.
CHECKS := lint types import-contract wheel driver-soak site release-lint ros-tests
test:
	@$(MAKE) --no-print-directory --jobs $$(getconf _NPROCESSORS_ONLN) --output-sync=target $(CHECKS)
	@$(MAKE) --no-print-directory unit

# The page of rapidgen/viewer: TypeScript, checked and bundled; again when a source of it has changed.
PAGE := rapidgen/viewer/assets/index.html
page: $(PAGE)
$(PAGE): $(shell find rapidgen/viewer/page -path '*/node_modules' -prune -o -type f -print)
	@PYTHON="$(PYTHON)" .ci/page

# Exact versions of everything that develops and tests rapidgen; `make lock` updates them.
LOCK := .ci/requirements.txt
$(STAMP): pyproject.toml $(LOCK)
	@PYTHON="$(PYTHON)" .ci/environment $(VENV) --requirement $(LOCK) --editable .
	@test ! -e .git || $(BIN)/pre-commit install || echo "git rejected the pre-commit hook"
	@touch $@

environment: $(STAMP)

lock: $(STAMP)
	$(BIN)/uv pip compile --quiet --universal --python-version 3.10 --upgrade --no-annotate --no-header --no-emit-index-url \
		--group dev --extra all --output-file $(LOCK) pyproject.toml

lint: $(STAMP)
	time $(BIN)/ruff check
	$(BIN)/ruff format --check

types: $(STAMP)
	time $(BIN)/mypy

# The node on the real rclpy, which PyPI has for Python 3.11 only; elsewhere `unit` tests it on a stand-in.
ROS_TESTS := $(addprefix tests/ros/,test_node.py test_operator_node.py test_own_services.py test_process.py test_ros2_control.py test_standin.py test_standin_fields.py test_stream_node.py)
ros-tests:
	@PYTHON="$(PYTHON)" .ci/ros
	@test ! -e build/ros/.made || { time PYTHONPATH=$(CURDIR) build/ros/bin/python -m pytest -q -p no:cacheprovider \
		-W "ignore:module 'sre_:DeprecationWarning" $(ROS_TESTS); }

import-contract: $(STAMP)
	time $(BIN)/lint-imports

# Lint, types and tests of one package: `make check PACKAGE=axes`.
check: $(STAMP)
	@test -d rapidgen/$(PACKAGE) -a -n "$(PACKAGE)" || { echo "PACKAGE is one of:" $(notdir $(patsubst %/,%,$(wildcard rapidgen/*/))); false; }
	$(BIN)/ruff check rapidgen/$(PACKAGE) $(wildcard tests/$(PACKAGE))
	$(BIN)/ruff format --check rapidgen/$(PACKAGE) $(wildcard tests/$(PACKAGE))
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python -m pytest -n auto tests/$(PACKAGE)

# Install the wheel in an environment of its own and run the demo: the wheel must carry templates/ and robots/.
WHEEL := build/wheel
wheel: $(STAMP) $(PAGE)
	rm -rf $(WHEEL)
	mkdir -p $(WHEEL)
	$(BIN)/python -m build --wheel --no-isolation --outdir $(WHEEL)/dist . >$(WHEEL)/build.log 2>&1 || (cat $(WHEEL)/build.log; false)
	$(BIN)/uv venv --quiet --python $(BIN)/python $(WHEEL)/env
	$(BIN)/uv pip install --quiet --python $(WHEEL)/env/bin/python --constraint $(LOCK) $(WHEEL)/dist/*.whl
	cd $(WHEEL) && time env/bin/rapidgen demo --no-view --output demo
	cd $(WHEEL) && env/bin/python -c 'from rapidgen.viewer.plotting import ASSETS; assert (ASSETS / "page.js").is_file(), ASSETS'

# The generated driver for one simulated hour; `make driver-day` is the long form.
driver-soak: $(STAMP)
	time $(BIN)/python tools/driver_campaign.py days --hours 1 --watched 0.1

# The documentation as a site: build/site/index.html. A warning is an error, a link into nothing is one,
# and so is a question of docs/start/questions.md that the site's search does not find.
site: $(STAMP)
	time $(BIN)/python -m sphinx --fail-on-warning --quiet -d build/site-pages docs build/site
	$(BIN)/python -m tests.docs.findable build/site

# Workflows, image and changelog: what only a release uses.
release-lint: $(STAMP)
	.ci/release --lint

# All files of a release in dist/; VERSION=X.Y.Z writes the version and the date first.
release: $(STAMP) $(PAGE)
	.ci/release $(VERSION)

# The wheel in an empty environment of each Python, with the newest and the lowest versions of its dependencies.
PYTHONS ?= 3.10 3.11 3.12 3.13 3.14
smoke: wheel ## 5 min: the wheel on every Python that is installed, with lowest and newest dependencies
	for python in $(PYTHONS); do for versions in highest lowest-direct; do \
		.ci/smoke $(WHEEL)/dist/*.whl $$python $$versions || exit 1; done; done

changelog: $(STAMP)
	$(BIN)/towncrier build --yes --version $(VERSION)

# The npm packages of editors/vscode, and the extension for VS Code: build/vscode/rapidgen.vsix.
EDITORS := build/vscode/node_modules/.installed
$(EDITORS): $(STAMP) editors/vscode/package-lock.json
	time .ci/editors
	@touch $@

vsix: $(EDITORS)
	time .ci/editors vsix
.PHONY: vsix

# After all else, so that pytest's own summary closes the output. Many tests wait for a socket or a browser most of
# their time: three workers for two cores.
unit: export PYTEST_XDIST_AUTO_NUM_WORKERS ?= $(shell echo $$(( $$(getconf _NPROCESSORS_ONLN) * 3 / 2 )))
unit: $(STAMP) $(PAGE) $(EDITORS)
	$(BIN)/python -m pytest -n auto -m "not long"

# What a release runs: every test, and the driver for four simulated hours.
test-long: export PYTEST_XDIST_AUTO_NUM_WORKERS ?= $(shell echo $$(( $$(getconf _NPROCESSORS_ONLN) * 3 / 2 )))
test-long: $(STAMP) $(PAGE) vsix
	.ci/code_server
	.ci/pytest_lsp
	$(BIN)/python tools/driver_campaign.py days --hours 4 --watched 0.25
	$(BIN)/python -m pytest -n auto

# The tests of a package, or all, in processes that are delayed at HELD_UP of their calls: a failing test is flaky.
stall-test: export PYTHONPATH = $(CURDIR)/tools/stall
stall-test: export HELD_UP ?= 0.05
stall-test: export SEED ?= 1
stall-test: $(STAMP) $(PAGE)
	$(BIN)/python -m pytest -n 6 tests/$(PACKAGE)

# The same in processes that are stopped for moments, anywhere; another SEED, other moments.
pause-test: SEED ?= 1
pause-test: $(STAMP) $(PAGE)
	$(BIN)/python tools/stall/stopped.py --seed $(SEED) $(BIN)/python -m pytest -n 6 tests/$(PACKAGE)

# The pictures of docs/develop/architecture.md (packages, a trajectory's life) and docs/start/robots.md, drawn again from the code.
diagrams: $(STAMP)
	$(BIN)/python -m tests.docs.picture
	$(BIN)/python -m tests.docs.life
	$(BIN)/python -m tests.docs.robots_picture

# Trials of programs that are no part of this project: FOREIGN is the folder that holds them,
# PROGRAM the trial (abb_driver, abb_libegm, backups, deployed, descriptions, godel, irb140, keyence, mains, motion_program_exec, open_abb, rfl, ros2, ros_nodes, rws_suites, state_machine, text_pairs, text_servers; default: any).
PROGRAM = trial
interop: $(STAMP)
	$(BIN)/python -m tools.interop.$(PROGRAM) $(FOREIGN)

# What takes too long for `make test`, each with its time on two cores: `make campaigns` lists them.
campaigns:
	@sed -n 's/^\([a-z0-9-]*\):.*## \([^:]*\): \(.*\)/\1|\2|\3/p' Makefile | \
		while IFS='|' read -r name time what; do printf '%-22s%-14s%s\n' "$$name" "$$time" "$$what"; done

properties: $(STAMP) ## 15 min: every property test with examples of its own drawing, more of them
	RAPIDGEN_PROPERTIES=campaign $(BIN)/python -m pytest -n auto -m hypothesis --timeout 0

suite: $(STAMP) ## 8 min: every case of `rapidgen test`, any two assumptions about controllers together
	$(BIN)/rapidgen test irb120

triples: $(STAMP) ## 15 min: the same where any three assumptions about controllers meet
	$(BIN)/rapidgen test irb120 --strength 3 --seeds 0

full-suite: $(STAMP) ## 3 h: the same on every example, and on any two of profile, commissioning, main, control
	$(BIN)/python tools/signature.py

mutants: $(STAMP) ## 5 min: a defect of the front end that turns it red, for each conformance program
	$(BIN)/python tools/conformance_mutants.py

runtime-mutants: $(STAMP) ## 15 min: the same for the conformance programs of the runtime
	$(BIN)/python tools/conformance_mutants_runtime.py

source-mutants: $(STAMP) ## 30 min: which mutants of client, servers, ros, deploy and machine their tests detect
	$(BIN)/python tools/source_mutants.py --jobs 2 --output build/source-mutants.jsonl

driver-mutants: $(STAMP) ## 12 min: which mutants of the generated modules the suite notices
	$(BIN)/python tools/driver_mutants.py --jobs 2 --budget 4 --output build/mutation.jsonl irb120

# A Dask scheduler and WORKERS workers as processes of this machine, until Ctrl-C, for
# `rapidgen test ... --cluster tcp://127.0.0.1:8786`.
WORKERS ?= $(shell nproc)
cluster: $(STAMP)
	$(BIN)/dask scheduler --host 127.0.0.1 --port 8786 --no-dashboard & trap "kill $$!" EXIT; \
		$(BIN)/dask worker tcp://127.0.0.1:8786 --nworkers $(WORKERS) --nthreads 1 --no-dashboard
.PHONY: cluster

program-mutants: $(STAMP) ## 15 min: the same for the modules of motion programs, in a cell with signals, tools, routines and data
	$(BIN)/python tools/driver_mutants.py --jobs 2 --budget 8 --output build/program-mutation.jsonl --themes programs "own routines" "own data" speed --only ROS_programs ROS_execution -- tools/cell.yaml

program-campaign: $(STAMP) ## 5 min: random motion programs beside the same ones written in RAPID
	for robot in irb120 irb2400 irb460 irb910sc; do \
		$(BIN)/rapidgen test $$robot --case program-like-rapid --quick --seeds 0 --programs 20 || exit 1; done

export-trials: $(STAMP) ## 4 min: 500 random programs as RAPID modules beside the same ones over the driver
	$(BIN)/python -m tools.export_trials

newcomer-trial: $(STAMP) ## 1 min: wrong commands, configurations and calls, and which of them get no good answer
	$(BIN)/python -m tools.newcomer_trial

# CONFIG and options of `rapidgen export` in OPTIONS.
toolpaths: $(STAMP) ## 2 min: toolpaths and plans of the folder FOREIGN exported, and what became of each
	$(BIN)/python -m tools.toolpaths $(FOREIGN) --config $(CONFIG) $(OPTIONS)

export-bench: $(STAMP) ## 3 min: 100,000 points written, checked and run
	$(BIN)/python benchmarks/export.py

motion-campaign: $(STAMP) ## 10 min: 10,000 random programs with random stops
	$(BIN)/python -m tools.motion_campaign

seeded-faults: $(STAMP) ## 1 min: 100 faults in RAPID programs, and how many `check --strict` finds
	$(BIN)/python tools/seeded_faults.py

motion-logs: $(STAMP) ## 3 min: simulated motion against the logs of a robot in the folder LOGS
	$(BIN)/python benchmarks/motion_logs.py $(LOGS)

fit: $(STAMP) ## 5 min: speed and number of moves along the curves CURVES=files, beside points by hand
	$(BIN)/python benchmarks/fit.py $(CURVES)

configuration-pairs: $(STAMP) ## 1 min: confdata beside robtargets of the backups in the folders FOLDERS
	$(BIN)/python tools/configuration_pairs.py $(FOLDERS)

error-bands: $(STAMP) ## 10 min: error of durations with estimated accelerations, judged on logs; LOGS=folder
	$(BIN)/python benchmarks/error_bands.py $(LOGS)

picking-cycles: $(STAMP) ## 5 min: picking cycles of all models beside published ones
	$(BIN)/python benchmarks/picking_cycles.py

other-accelerations: $(STAMP) ## 20 min: the driver's cases on robots with half and twice its accelerations
	$(BIN)/python -m tools.other_accelerations

reach: $(STAMP) ## 3 min: 10,000 poses of every shipped model, by formula or search
	$(BIN)/python benchmarks/reach.py

worker-scaling: $(STAMP) ## 2 min: what a second worker of a campaign is worth, beside two processes of their own
	$(BIN)/python benchmarks/two_workers.py

exploration: $(STAMP) ## 1 min: schedules until known defects of drivers are found
	$(BIN)/python tools/exploration.py --jobs 2

# RESULTS keeps them: the next call goes on there.
RESULTS ?= build/schedules
EXPLORED := irb120 robots/examples/irb2400-rw5.yaml robots/examples/irb910sc-rw6.yaml \
	robots/examples/irb120_basic-rw6.yaml robots/examples/irb460-rw7.yaml
exploration-100k: $(STAMP) ## 2 h: 100,000 random schedules of the drivers of five robots, the curve of new pairs
	$(BIN)/python tools/exploration.py --of $(EXPLORED) --seeds 20000 --jobs 2 --results $(RESULTS)

tcp-speed-limit: $(STAMP) ## 2 min: how fast the TCP is in 1,000 random trajectories under a ceiling
	$(BIN)/python benchmarks/ceiling.py

exploration-stops: $(STAMP) ## 20 min: 20,000 emergency stops and power failures at 80 % of an axis' speed
	$(BIN)/python tools/fast_stops.py --jobs 2 --pairs irb120 irb6700

ros-goals: $(STAMP) ## 20 min: 10,000 goals of FollowJointTrajectory by lot, with faults at any moment
	$(BIN)/python tools/ros_goals.py

.PHONY: ros-dds-goals
ros-dds-goals: ## 3 min: 300 goals by lot over DDS, with PyPI's rclpy
	@PYTHON="$(PYTHON)" .ci/ros
	PYTHONPATH=$(CURDIR) build/ros/bin/python tools/ros_dds_goals.py

# In a shell that has sourced ROS 2, with its Python: make ros-node ROS_PYTHON=.../bin/python
ROS_PYTHON ?= python3
ros-node: ## 5 min: what the ROS 2 node adds to a bare client and publisher, with a real rclpy
	$(ROS_PYTHON) benchmarks/ros_node.py

ros-streaming: ## 3 min: delays of commands and goals of the ROS 2 node, with a real rclpy
	$(ROS_PYTHON) benchmarks/ros_streaming.py

driver-boundary: $(STAMP) ## 2 h: boundary values in every field of every message, in nine states, on all ports
	$(BIN)/python tools/boundary.py --jobs 2 --results build/boundary.jsonl

stop-trials: $(STAMP) ## 5 min: 2,000 random stops with up to three operator actions, and the way back from them
	$(BIN)/python tools/stop_trials.py --jobs 2

editor-bench: $(STAMP) ## 1 min: answers of the language server after an edit, its start and memory
	$(BIN)/python benchmarks/editor.py

lsp-clients: $(STAMP) ## 1 min: the language server with pytest-lsp as Neovim, VS Code and Emacs
	.ci/pytest_lsp

editor-trials: $(STAMP) ## 5 min: edits, renames and requests in public programs; PROGRAMS=folder
	$(BIN)/python tools/editor_trials.py $(PROGRAMS) --seconds 300

debug-bench: $(STAMP) ## 1 min: steps per second through the debug adapter
	$(BIN)/python benchmarks/debug_adapter.py

egm-bench: $(STAMP) ## 2 min: period of EGM frames, and the client's time to answer
	$(BIN)/python benchmarks/egm.py --seconds 60

egm-lag: $(STAMP) ## 2 min: lag that the EGM client measures against 200 unknown plants
	$(BIN)/python benchmarks/egm_lag.py

egm-campaign: $(STAMP) ## 45 min: 20,000 runs of a guided robot with faults of its partner and actions of an operator
	$(BIN)/python tools/egm_campaign.py --jobs 2 --results build/egm.jsonl

collision-trials: $(STAMP) ## 5 min: 10,000 moves of a needle past a thin plate, against 4,001 samples each
	$(BIN)/python tools/collision_trials.py

collision-programs: $(STAMP) ## 30 min: 500 random programs of three robots in random cells, against samples every millisecond
	$(BIN)/python tools/collision_programs.py

collision-detection: $(STAMP) ## 10 min: contacts that stop the virtual controller in 200 random programs, against samples every millisecond
	$(BIN)/python tools/collision_detection.py

driver-frames: $(STAMP) ## 1 h: 200,000 hostile openings on all ports, half of them with boundary values, a good client after each
	$(BIN)/python tools/driver_campaign.py frames --jobs 2 --results build/frames.jsonl

driver-day: $(STAMP) ## 1 min: 24 simulated hours, a trajectory every ten minutes, the state read
	$(BIN)/python tools/driver_campaign.py days --hours 24 --watched 0.25

driver-days: $(STAMP) ## 2 h: 30 simulated days, the state read all the time
	$(BIN)/python tools/driver_campaign.py days --hours 720

deploy-interruptions: $(STAMP) ## 10 min: every cut of every deployment, garbled answers of servers
	$(BIN)/python benchmarks/deploy.py --cuts

rws-answers: $(STAMP) ## 1 min: 10,000 flows of the web services' client with hostile answers
	$(BIN)/python -m tools.rws_campaign answers 10000

rws-requests: $(STAMP) ## 1 min: 100,000 hostile requests to the face, a good client after each thousand
	$(BIN)/python -m tools.rws_campaign requests 100000

rws-interruptions: $(STAMP) ## 1 h: deployments over the web services cut at every request, before and after it was done
	RAPIDGEN_LONG=1 $(BIN)/python -m pytest -n 2 -v --timeout 0 tests/deploy/rws/test_cuts.py

image: $(STAMP) ## 5 min: the container image, built and tried by docker or podman
	.ci/image

egm-stop: $(STAMP) ## 1 min: STOP of a guided robot to EGMStop, and the angle until it stands
	$(BIN)/python benchmarks/egm_stop.py

stop-under-load: $(STAMP) ## 2 min: STOP to StopMove, idle and with both other ports flooded
	$(BIN)/python benchmarks/stop_under_load.py

endurance: $(STAMP) ## 2 min: memory of an idle driver that is watched for ten simulated hours
	$(BIN)/python benchmarks/endurance.py

many-controllers: $(STAMP) ## 2 min: 50 controllers in real time, how late their states come
	$(BIN)/python benchmarks/many_controllers.py

BENCHES := startup start_of_run programs parsing kernels backup motion state client deploy driver streaming rws recording ready ros stop_start view collision
bench: $(STAMP) ## 10 min: the figures of docs/develop/performance.md that need no argument
	for name in $(BENCHES); do $(BIN)/python benchmarks/$$name.py || exit 1; done

# OLD and NEW are interpreters of environments that have two trees of this project in them. (Whether
# they behave the same: `python tools/unmoved.py`.)
compare: $(STAMP) ## 15 min: what has become slower between two trees; OLD=... NEW=...
	$(BIN)/python benchmarks/side_by_side.py $(OLD) $(NEW)

.PHONY: $(shell sed -n 's/^\([a-z0-9-]*\):.*\#\# .*/\1/p' Makefile)

clean:
	rm -rf $(VENV) build dist .mypy_cache .ruff_cache .pytest_cache
