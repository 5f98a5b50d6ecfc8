# make setup   .venv with everything in it
# make demo    the main job, start to end
# make demo-robots  the same on simulated arms, in scenes never seen, with videos
# make setup-sim  the models of the simulated arms, into your cache
# make docs    the site of the documentation, in build/site
# make test    the one check: lint, types, tests
PYTHON ?= python3
BIN := .venv/bin
DEMO_DIR ?= runs/demo
DEMO_SEED ?= 0
ROBOTS_DIR ?= runs/robots
ROBOTS_SEED ?= 1

.PHONY: setup setup-sim demo demo-robots docs test lint types tests benchmark clean

setup: .venv/.installed

.venv/.installed: pyproject.toml constraints.txt
	@bash .ci/system-packages
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "skillwrapper needs Python 3.11 or newer; set PYTHON=")'
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev,docs,gymnasium,lerobot,minari,ros,sim]'
	@$(BIN)/skillwrapper setup-sim || echo 'tests of the simulated arms will be skipped'
	@touch $@

setup-sim: setup
	$(BIN)/skillwrapper setup-sim

demo: setup
	$(BIN)/skillwrapper learn burger --out $(DEMO_DIR) --seed $(DEMO_SEED) --iterations 10
	$(BIN)/skillwrapper verify $(DEMO_DIR) --curve
	$(BIN)/skillwrapper render burger --state examples/burger/finished.yaml --seed 7 --out $(DEMO_DIR)/goal.png
	$(BIN)/skillwrapper solve $(DEMO_DIR) --init-seed 77 --goal $(DEMO_DIR)/goal.png
	$(BIN)/skillwrapper report $(DEMO_DIR)
	@echo
	@echo "what was learned:  $(BIN)/skillwrapper show $(DEMO_DIR)"
	@echo "PDDL domain:       $(DEMO_DIR)/model/domain.pddl"
	@echo "the burger:        $(DEMO_DIR)/solve.gif"
	@echo "report:            $(DEMO_DIR)/report.html"

demo-robots: setup setup-sim
	$(BIN)/skillwrapper learn panda --out $(ROBOTS_DIR)/panda --seed $(ROBOTS_SEED) --iterations 9 --budget 15 --threshold 0.5 --set 'scenes=[pouring,wiping,stacking]'
	$(BIN)/skillwrapper verify $(ROBOTS_DIR)/panda
	$(BIN)/skillwrapper render panda --state examples/panda/finished.yaml --seed 7 --out $(ROBOTS_DIR)/panda/goal.png
	$(BIN)/skillwrapper solve $(ROBOTS_DIR)/panda --init-seed 77 --goal $(ROBOTS_DIR)/panda/goal.png --video $(ROBOTS_DIR)/panda/solve.webp
	$(BIN)/skillwrapper learn kuka --out $(ROBOTS_DIR)/kuka --seed $(ROBOTS_SEED) --iterations 15 --budget 5 --threshold 0.5
	$(BIN)/skillwrapper verify $(ROBOTS_DIR)/kuka
	$(BIN)/skillwrapper render kuka --state examples/kuka/finished.yaml --seed 7 --out $(ROBOTS_DIR)/kuka/goal.png
	$(BIN)/skillwrapper solve $(ROBOTS_DIR)/kuka --init-seed 77 --goal $(ROBOTS_DIR)/kuka/goal.png --video $(ROBOTS_DIR)/kuka/solve.webp

docs: setup
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet --strict
	@echo 'read it: build/site/index.html'

test: lint types tests

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports

types: setup
	$(BIN)/mypy

# Tests start many processes: what one of them has compiled, the others load, whatever the environment.
tests: setup
	PYTHONDONTWRITEBYTECODE= PYTHONPYCACHEPREFIX=$(CURDIR)/build/bytecode $(BIN)/pytest -n 2 --dist loadfile

benchmark: setup
	$(BIN)/python -m benchmarks

clean:
	rm -rf .venv .mypy_cache .pytest_cache .ruff_cache
