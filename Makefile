# Python 3.11 or newer, make and a package index are all that is needed; `.venv` is made here and kept.
#
#   make check        check the missions of models/auv/inl, say where the report is; exits 1 with findings
#   make test         all that must hold: style, types, and the tests with the engine compiled and interpreted
#
#   make setup        install everything into .venv
#   make build        bring the compiled engine up to date with its sources
#   make lint types   ruff; mypy
#   make compiled     the tests with the engine compiled; `make interpreted` those it matters for, uncompiled
#   make format       let ruff format and mend what it can
#   make plan-proof   MODELS (20000) random whole models beside judges that know only the models
#   make fuzz         the property tests with many more examples, and MUTATIONS (1000000) mutations of texts
#   make sampling-study  BATCHES (10000) simulated batches per sampler: how often each interval covers the true rate
#   make alarm-study  FLIGHTS (11000) right missions and plans of every kind, judged: the judge objects to none
#   make judge-study  FAULTS (1000) faults of fixed schemes, and as many in the source of the engine, flown, and put to the
#                     judge and to an oracle
#   make conflict-study  FAILURES (1000) failing missions of mutants of all models: z3 confirms each conflict, and needs each part
#   make controllability-proof  NETWORKS (10000) small networks beside the game against the vehicle, played to its end
#   make study        CELL (200) missions of each cell of the founding paper's study, what they show, adaptive sampling of B2,
#                     and the three mistakes found at sea in one batch; hours, kept in build/study.sqlite and gone on with
#   make truths       conditions of models whose truth is known, each on FRESH (2000) fresh missions
#   make fault-conditions  conditions that are printed of the faults made by hand, each on FRESH (2000) fresh missions; hours
#   make kills        KILLS (20) batches killed by SIGKILL and as many by SIGTERM, resumed, beside undisturbed ones
#   make agents       AGENTS (500) random missions of random reactors, flown in every way and put to an oracle of their traces
#   make second       AGENTS (500) random missions beside a second agent, written from the specification alone, trace by trace
#   make cases        every small mission several times in one process, whatever the one before has left behind
#   make variants     the eight mistakes of models/auv/bugs, each explained
#   make mutants      MUTANTS (2000) faulty missions, flown compiled, interpreted and by the general engine, and judged
#   make renames      rename every name of every model, and compare what the models mean
#   make editor-proof EXAMPLES (100000) scripts of keystrokes beside a cold start, as many edits and hostile messages,
#                     as many random texts; every model by the server and by `nddlc lint`
#   make vsix         the extension for Visual Studio Code (npm fetches its tools; what it makes loads nothing)
#   make conformance  the conformance suite of NDDL
#   make corpus       the public models, where CORPUS=directory holds checkouts of nasa/europa and fredpy/trex2-agent
#   make trex-one     the small agents of T-REX 1 beside the traces that it left, where TREX1=directory holds a checkout of
#                     trex-autonomy/trex
#   make rules        the pages of docs/rules, from the tables beside the passes
#   make docs         the site of docs/, in build/site; works offline
#   make bench        missions per second, compiled and interpreted
#   make clean        remove what was made, .venv included
#
# MISSION=file checks another mission; PYTHON=python3.13 sets up with that one.

MUTATIONS ?= 1000000
MUTANTS ?= 2000
AGENTS ?= 500
MISSION ?= models/auv/inl/mission.toml
PYTHON := python3.11 python3.12 python3.13 python3.14 python3 python
BIN := .venv/bin
# Many tests wait for other processes, so there is one worker more than cores.
WORKERS := $(shell expr $$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1) + 1)
PYTEST := $(BIN)/python -m pytest --numprocesses $(WORKERS) --dist worksteal
FINDINGS := build/findings
TICKING := $(BIN)/python build_backend/ticking.py
PIP := $(BIN)/python -m pip install --quiet --disable-pip-version-check

.DEFAULT_GOAL := help
.PHONY: help check missions test setup build engine lint types compiled interpreted format fuzz engine-proof plan-proof sampling-study alarm-study judge-study conflict-study controllability-proof study truths fault-conditions kills cases variants mutants agents second renames editor-proof vsix conformance corpus trex-one rules docs bench clean

help:
	@sed -n 's/^#   //p' Makefile

# make ends with 2 whatever goes wrong, except that a question (-q) which finds something to do ends with 1. So `check`
# is a question: lines with a `+` run all the same, and the last line, without one, stands for the findings.
ifeq ($(MAKECMDGOALS)$(filter 3.%,$(MAKE_VERSION)),check)
MAKEFLAGS += -q
endif

check: missions
	$(if $(shell test -e $(FINDINGS) && echo yes),@exit 1)

missions:
	+@rm -f $(FINDINGS)
	+@MAKEFLAGS= $(MAKE) --no-print-directory -j2 build
	+@$(BIN)/nddlc check $(MISSION) || { status=$$?; [ $$status -eq 1 ] && touch $(FINDINGS) || exit $$status; }

# What compiles the engine is there long before all the rest has been fetched.
test:
	+@$(MAKE) --no-print-directory -j2 build
	+@$(MAKE) --no-print-directory lint compiled interpreted build/builds-tested

setup: .venv/ready

# An environment is tied to its place: one that came along with a copy of the checkout is made anew.
SET_UP_IN := $(shell cat .venv/ready 2>/dev/null)
ifneq ($(SET_UP_IN),$(CURDIR))
.PHONY: .venv/compiler .venv/ready
endif

.venv/compiler: pyproject.toml setup.py build_backend/nddlc_build.py
	@[ -z "$(SET_UP_IN)" ] || [ "$(SET_UP_IN)" = "$(CURDIR)" ] || rm -rf .venv
	@for python in $(PYTHON); do \
	  $$python -c 'import ensurepip, sys, venv; sys.exit(sys.version_info < (3, 11))' 2>/dev/null && break; python=; done; \
	[ "$$python" ] || { echo 'Python 3.11 or newer, with its venv, is not on the path; try PYTHON=...' >&2; exit 1; }; \
	$(BIN)/python -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null || \
	{ echo "making .venv with $$($$python --version)" && \
	$$python build_backend/ticking.py 'making .venv' $$python -m venv --clear .venv; }
	@$(TICKING) 'installing what compiles' $(PIP) 'setuptools>=77' && \
	$(TICKING) 'installing what compiles' $(PIP) $$($(BIN)/python build_backend/nddlc_build.py)
	@touch $@

.venv/ready: .venv/compiler
	@echo 'installing into .venv (once; a minute or two)'
	@NDDLC_NO_COMPILE=1 $(TICKING) 'installing into .venv' $(PIP) --editable '.[dev]'
	@echo "$(CURDIR)" > $@

build: setup engine

engine: .venv/compiler
	@$(BIN)/python build_backend/build_in_place.py
	@$(TICKING) 'making bytecode' $(BIN)/python -m compileall -q nddl_lang compiler runtime checker lsp nddlc

lint: setup
	$(BIN)/ruff check
	$(BIN)/ruff format --check

types: setup
	$(TICKING) mypy $(BIN)/mypy

compiled: build
	$(PYTEST) -m 'not builds'

# The form of the engine cannot matter to the front end, to commands and to pages; the build has tests of its own.
APART := $(addprefix tests/,build cli docs format lint lsp semantics syntax text)

interpreted: setup
	NDDLC_INTERPRETED=1 $(PYTEST) -m 'not once' $(filter-out $(APART) %.py tests/__pycache__,$(wildcard tests/*))

# Wheels and rebuilds take a minute, so they are made again only when what decides about them has changed.
build/builds-tested: setup.py pyproject.toml $(wildcard build_backend/*.py tests/build/*.py) runtime/build_form.py | build
	$(PYTEST) -m builds tests/build
	@touch $@

format: setup
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

fuzz: build
	NDDLC_FUZZ=$(MUTATIONS) $(PYTEST) --hypothesis-profile=fuzz -m 'not slow'

EXAMPLES := 100000

engine-proof: build
	$(BIN)/python -m tests.constraints.proof $(EXAMPLES)

MODELS := 20000

plan-proof: build
	$(BIN)/python -m tests.solver.whole.proof $(MODELS)

BATCHES := 10000

sampling-study: build
	$(BIN)/python -m tests.checker.sampling_study $(BATCHES)

FLIGHTS := 11000

alarm-study: build
	$(BIN)/python -m tests.checker.judge.alarm_study $(FLIGHTS)

FAULTS := 1000

judge-study: setup
	NDDLC_INTERPRETED=1 $(BIN)/python -m tests.checker.judge.placed_study $(FAULTS)
	NDDLC_INTERPRETED=1 $(BIN)/python -m tests.checker.judge.judge_study $(FAULTS)

FAILURES := 1000

conflict-study: build
	$(BIN)/python -m tests.checker.conflict_study $(FAILURES)

NETWORKS := 10000

controllability-proof: build
	NDDLC_PROOFS=$(NETWORKS) $(PYTEST) tests/checker/test_controllability.py

CELL := 200

study: build
	$(BIN)/python -m tests.checker.paper_study $(CELL)

FRESH := 2000

truths: build
	$(BIN)/python -m tests.checker.conditions.truth_study $(FRESH)

UNSEEN := $(patsubst %/hand.toml,%,$(wildcard tests/checker/unseen/*/hand.toml))

fault-conditions: build
	$(BIN)/python -m tests.checker.conditions.fault_conditions --fresh $(FRESH) $(UNSEEN)

KILLS := 20

kills: build
	NDDLC_KILLS=$(KILLS) $(BIN)/python -m pytest -q -rP tests/checker/test_interrupt.py -k killed

cases: build
	NDDLC_CASES=all $(PYTEST) tests/executive/test_cases.py tests/executive/test_variations.py

variants: build
	NDDLC_VARIANTS=1 $(BIN)/python -m pytest -q tests/models/test_variants_explained.py tests/checker/test_yardstick.py

mutants: build
	$(BIN)/python -m tests.executive.mutants.campaign $(MUTANTS) --whole 60 --general 3

agents: build
	$(BIN)/python -m tests.executive.generated.campaign $(AGENTS)
	$(BIN)/python -m tests.executive.generated.campaign $(AGENTS) --wide
	$(BIN)/python -m tests.executive.generated.campaign $(AGENTS) --wide --rich
	$(BIN)/python -m tests.executive.generated.campaign $(AGENTS) --wide --rich --deep
	$(BIN)/python -m tests.executive.generated.campaign $(AGENTS) --wide --rich --deep --ranks --batches 50
	$(BIN)/python -m tests.executive.generated.redrawn $(AGENTS)
	$(BIN)/python -m tests.executive.generated.choiceless $(AGENTS)

second: build
	$(BIN)/python -m tests.executive.second.campaign $(AGENTS)
	$(BIN)/python -m tests.executive.second.campaign $(AGENTS) --turns
	$(BIN)/python -m tests.executive.second.campaign $(AGENTS) --windows
	$(BIN)/python -m tests.executive.second.campaign $(AGENTS) --priorities
	$(BIN)/python -m tests.executive.second.campaign $(AGENTS) --stores
	NDDLC_CASES=all $(PYTEST) tests/executive/test_second.py

renames: build
	NDDLC_RENAMES=all $(PYTEST) tests/lsp/test_rename_everything.py

editor-proof: build
	$(BIN)/python -m tests.lsp.keystroke_proof $(EXAMPLES)
	$(BIN)/python -m tests.lsp.hostile_proof $(EXAMPLES)
	$(BIN)/python -m tests.lsp.random_texts $(EXAMPLES)
	NDDLC_EDITOR=all $(PYTEST) tests/lsp/test_scheduling.py tests/lsp/test_one_engine.py

vsix:
	cd editors/vscode && npm ci --no-audit --no-fund && npm run -s types && npm run -s bundle && npm test -s && npm run -s package

conformance: build
	$(PYTEST) tests/conformance

corpus: build
	$(BIN)/python -m tests.corpus '$(CORPUS)'

trex-one: build
	$(BIN)/python -m tests.trex_one '$(TREX1)'

docs: setup
	$(BIN)/python -m pip install --quiet --disable-pip-version-check 'mkdocs-material>=9.5'
	NO_MKDOCS_2_WARNING=1 $(BIN)/mkdocs build --quiet
	@echo "the site is build/site/index.html"

rules: setup
	$(BIN)/python -m checker.rulebook docs/rules

bench: build
	@for script in bench/*.py; do $(BIN)/python $$script || exit; done

clean:
	rm -rf .venv build dist *.egg-info .mypy_cache .pytest_cache .ruff_cache .hypothesis
	find nddl_lang compiler runtime checker lsp nddlc tests bench build_backend \
	  \( -name '*.so' -o -name __pycache__ \) -prune -exec rm -rf {} +
