# make setup   .venv with everything in it
# make demo    the main job, start to end
# make test    the one check: lint, types, tests
PYTHON ?= python3
BIN := .venv/bin
DEMO_DIR ?= runs/demo

.PHONY: setup demo test lint types tests benchmark clean

setup: .venv/.installed

.venv/.installed: pyproject.toml constraints.txt
	@bash .ci/system-packages
	$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11) and "skillwrapper needs Python 3.11 or newer; set PYTHON=")'
	$(PYTHON) -m venv .venv
	$(BIN)/pip install --quiet --disable-pip-version-check -c constraints.txt -e '.[dev]'
	@touch $@

demo: setup
	$(BIN)/python -m skillwrapper.cli.demo $(DEMO_DIR)

test: lint types tests

lint: setup
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .

types: setup
	$(BIN)/mypy

tests: setup
	$(BIN)/pytest -n 2

benchmark: setup
	$(BIN)/python -m benchmarks

clean:
	rm -rf .venv .mypy_cache .pytest_cache .ruff_cache
