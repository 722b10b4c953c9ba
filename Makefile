# Every target works as the first command in a fresh clone: what it needs is made first.
# The environment is made with the Python that PYTHON names, or else with one that works.
PYTHON ?=
VENV := .venv
BIN := $(VENV)/bin
READY := $(VENV)/ready
TESTS := $(VENV)/ready-for-tests

# Else each kernel of a page and each process of a test compiles all that it imports anew.
unexport PYTHONDONTWRITEBYTECODE

.DEFAULT_GOAL := help
.PHONY: help book book-version pdf test lint lab figures ledger accept data-package archive bench \
  bench-book sentences rig-test picture lock clean

help:  ## list the targets
	@grep -hE '^[a-z][a-z%-]*:.*## ' $(MAKEFILE_LIST) | sort \
	  | awk -F ':.*## ' '{ printf "  make %-12s %s\n", $$1, $$2 }'

$(READY): environment.lock pyproject.toml
	@found=$$(.ci/pythons $(PYTHON)) || exit 1; \
	set -- $$found; python=$$2; \
	echo "Making $(VENV) from environment.lock with Python $$1, $$python:" \
	     "a minute or two and 1.5 GB, once."; \
	.ci/environment $(VENV) "$$python" book
	@touch $@

$(TESTS): $(READY)
	@echo "Adding what only the tests need."
	@.ci/environment $(VENV) $(BIN)/python tests
	@touch $@

book: book-version  ## build the book: book/_build/html/index.html
	@$(BIN)/python -m book.build

book-version: $(READY)
	@$(BIN)/python -c 'from importlib.metadata import version; found = version("jupyter-book"); \
	  found.startswith("1.") or exit(f"The book needs jupyter-book 1.x, $(VENV) has {found}: rm -r $(VENV), make book")'

pdf: book $(TESTS)  ## print the built book as one PDF: book/_build/softgrip.pdf (needs Chromium)
	@$(BIN)/python -m book.build.pdf

test: $(TESTS)  ## run the tests; those of the pages build the book and open it in Chromium
	@$(BIN)/python -m pytest -n auto --dist loadfile --no-loadscope-reorder \
	  --durations=20 --durations-min=1

lint: $(TESTS)  ## check style, types and the direction of imports
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check .
	@$(BIN)/mypy
	@$(BIN)/lint-imports --no-cache

# Copies, in which what the built book knows is text: the pages themselves are not touched. Their
# links lead to the built book, which the same server has.
lab: book  ## open the pages as notebooks in JupyterLab, as copies in lab/
	@$(BIN)/python -m book.build.lab
	@SOFTGRIP_BOOK_ADDRESS=/static/ $(BIN)/jupyter lab --notebook-dir=lab \
	  --LabApp.default_url=/lab/tree/index.ipynb \
	  --ServerApp.extra_static_paths="['$(CURDIR)/book/_build/html']"

figures: $(READY)  ## write every figure and table to book/_build/figures
	@$(BIN)/python -m book.companion.figures

figure-%: $(READY)
	@$(BIN)/python -m book.companion.figures $@

table-%: $(READY)
	@$(BIN)/python -m book.companion.figures $@

ledger: $(READY)  ## judge every printed number: book/_build/ledger.json
	@$(BIN)/python -m book.companion.ledger

accept: $(READY)  ## make today's verdicts the expected ones (look at the diff)
	@$(BIN)/python -m book.companion.ledger --accept

data-package: $(READY)  ## describe data/ anew, from its files and book/build/data_package.toml
	@$(BIN)/python -m book.build.data_package

archive: book-version  ## write one file to keep, in dist/; WHEELS=1: with all packages, for this platform
	@$(BIN)/python -m book.build.archive $(if $(WHEELS),--wheels)

bench: $(TESTS)  ## measure the speed of simulation and control: book/_build/bench.json
	@$(BIN)/python -m tests.bench

bench-book: $(TESTS)  ## measure the build of the book and its pages against a former commit: hours
	@$(BIN)/python -m tests.bench.book

sentences: $(READY)  ## list the sentences of the pages that are hardest to read
	@$(BIN)/python -m book.build.sentences

rig-test: $(TESTS)  ## run the rig's tests on a board: make rig-test PORT=/dev/ttyACM0 (the motor turns)
	@test -n "$(PORT)" || { echo "make rig-test PORT=/dev/ttyACM0"; exit 2; }
	@SOFTGRIP_RIG_PORT=$(PORT) $(BIN)/python -m pytest tests/rig/test_conformance.py \
	  -k "not simulated and not replay and not stub and not emulated"

picture: book $(TESTS)  ## take the picture of the README from the built book (needs Chromium)
	@$(BIN)/python -m book.build.picture

lock: $(TESTS)  ## resolve the dependencies of pyproject.toml anew
	@.ci/lock $(BIN)/uv --upgrade

clean:  ## remove what was built; the environment stays
	@rm -rf book/_build book/_vendor .pytest_cache .mypy_cache .ruff_cache .hypothesis
