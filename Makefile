# Every target works in a fresh clone: it makes .venv from the system's python3 and installs what it
# needs. A stamp file remembers the installation; it is redone when pyproject.toml changes.
#
#   make demo    steer the wire through the half-circle, and push it through without steering
#   make test    run the tests
#   make lint    format check, lint, types, layers
#   make docs    build the documentation into docs/_build/html
#   make bench   measure times, counts and ratios on this machine
#   make format  put the sources into the project's format
#   make clean   remove everything that was made, .venv included

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.PHONY: help demo test lint docs bench format clean

help:
	@sed -n 's/^#   make /  make /p' $(firstword $(MAKEFILE_LIST))

demo: $(VENV)/.run
	@$(BIN)/magwire run half-circle --compare none --out demo --force
	@echo "The figure is demo/figure.png (and .svg), the data are in demo/result.nc and result-none.nc."

test: $(VENV)/.dev
	@$(BIN)/python -m pytest -n 2 --dist loadfile --no-loadscope-reorder

lint: $(VENV)/.dev
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports

docs: $(VENV)/.docs
	$(BIN)/python -m sphinx -W --keep-going -b html docs docs/_build/html
	@echo "The documentation starts at docs/_build/html/index.html."

bench: $(VENV)/.dev
	@$(BIN)/magwire bench

format: $(VENV)/.dev
	$(BIN)/ruff format .
	$(BIN)/ruff check --fix .

clean:
	rm -rf $(VENV) demo docs/_build docs/api docs/gallery .mypy_cache .pytest_cache .ruff_cache \
		.import_linter_cache .hypothesis

$(BIN)/python:
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' \
		|| { echo "magwire needs Python 3.11 or later; name one with make PYTHON=..." >&2; exit 1; }
	@echo "Making $(VENV) ..."
	@$(PYTHON) -m venv $(VENV)

$(VENV)/.run: pyproject.toml | $(BIN)/python
	@echo "Installing magwire into $(VENV) ..."
	@$(PIP) install --editable .
	@touch $@

$(VENV)/.dev: pyproject.toml | $(BIN)/python
	@echo "Installing magwire and its development tools into $(VENV) ..."
	@$(PIP) install --editable '.[dev]'
	@touch $(VENV)/.run $@

$(VENV)/.docs: pyproject.toml | $(BIN)/python
	@echo "Installing magwire and the tools of its documentation into $(VENV) ..."
	@$(PIP) install --editable '.[docs]'
	@touch $(VENV)/.run $@
