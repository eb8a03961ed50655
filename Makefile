# Two commands matter: `make run` opens the viewer, `make test` checks everything. Both set up what is missing.
PY := .venv/bin/python

.PHONY: run test lint bench faces clean help

run: ## set up and open the viewer (pictures under out/ where there is no display)
	@tools/setup.sh run
	@$(PY) -m facemorph view --without-display out $(if $(FACE),"$(FACE)")

test: ## set up, then lint, types, layers and all tests
	@tools/setup.sh test
	@$(MAKE) --no-print-directory lint
	@$(PY) -m pytest -n auto --dist worksteal

lint:
	@$(PY) -m ruff check .
	@$(PY) -m ruff format --check .
	@$(PY) -m mypy

bench: ## measure beside peers (installs them); prints tables
	@tools/setup.sh test
	@$(PY) -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[bench]'
	@$(PY) -m benchmarks $(ONLY)

faces: ## bake assets/faces anew
	@tools/setup.sh test
	@$(PY) -m pip install --quiet --disable-pip-version-check --constraint constraints.txt --editable '.[bake]'
	@$(PY) tools/bake_faces.py

clean:
	rm -rf .venv out build dist .mypy_cache .ruff_cache .pytest_cache .hypothesis

help:
	@grep -E '^[a-z]+:.*##' Makefile | sed 's/:.*##/\t/'
