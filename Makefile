# Thin: every target is one or two commands that can be typed by hand. `make demo` needs only a Debian 12.
BUILD    ?= build
PREFIX   ?= /usr/local
JOBS     ?= $(shell nproc)
PYTHON   ?= /usr/bin/python3
SUDO     := $(if $(filter 0,$(shell id -u)),,sudo)
PROGRAM  := $(BUILD)/fissura

# A compiler cache is used where there is one and never asked for.
ifneq ($(shell command -v ccache),)
export CMAKE_CXX_COMPILER_LAUNCHER ?= ccache
endif

PROGRAM_PACKAGES := g++ cmake ninja-build pkg-config libtomlplusplus-dev libudunits2-dev libcli11-dev \
  libfmt-dev libspdlog-dev libgmsh-dev libpugixml-dev zlib1g-dev libxxhash-dev libeigen3-dev nlohmann-json3-dev \
  python3-numpy python3-matplotlib
# The report page is bundled with npm; a node that came from elsewhere is as good.
PAGE_PACKAGES    := $(if $(shell command -v npm),,nodejs npm)
FORMAT_PACKAGES  := clang-format
# chromium: the tests open the report page; skipped where there is none, as is the check of the format without clang-format.
TEST_PACKAGES    := $(PROGRAM_PACKAGES) $(PAGE_PACKAGES) libgtest-dev libbenchmark-dev pybind11-dev python3-dev mkdocs chromium \
  python3-vtk9 python3-meshio $(FORMAT_PACKAGES)
DOCS_PACKAGES    := mkdocs
PYTHON_PACKAGES  := $(PROGRAM_PACKAGES) pybind11-dev python3-dev python3-venv
FUZZ_PACKAGES    := $(TEST_PACKAGES) clang
COVERAGE_PACKAGES := $(TEST_PACKAGES) clang llvm
FUZZ_SECONDS     ?= 60

# $(call install_packages,LIST): asks apt only if something is missing.
define install_packages
@missing=""; for p in $(1); do \
  dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'install ok installed' || missing="$$missing $$p"; done; \
if [ -n "$$missing" ]; then echo "installing:$$missing"; $(SUDO) apt-get update -qq && \
  $(SUDO) env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $$missing >/dev/null; fi
endef

.PHONY: help setup setup-program setup-demo setup-tests setup-docs setup-python setup-format setup-fuzz setup-coverage build build-all \
  demo test verify properties validate figures numbers pictures bench docs python fuzz sanitize coverage format install clean

help:
	@echo "make demo      install what is missing, build, run a small beam to failure: report, curve, crack picture"
	@echo "make test      install what is missing, build all, run all tests"
	@echo "make build     build the program only: $(PROGRAM)"
	@echo "make verify    run the verification cases: $(BUILD)/verification.csv"
	@echo "make validate  run the long cases"
	@echo "make figures   draw the paper's figures from runs    make pictures  draw the crack pictures"
	@echo "make numbers   write the numbers that the pages tell of runs anew (LONG=--long: those of long runs too)"
	@echo "make python    build the Python module: $(BUILD)/python"
	@echo "make properties | fuzz | sanitize | coverage    the long checks, see docs/reference/promises.md"
	@echo "make bench | docs | format | install [PREFIX=...] | clean"

setup: setup-tests
setup-program:
	$(call install_packages,$(PROGRAM_PACKAGES))
setup-demo:
	$(call install_packages,$(PROGRAM_PACKAGES) $(PAGE_PACKAGES))
setup-tests:
	$(call install_packages,$(TEST_PACKAGES))
setup-docs:
	$(call install_packages,$(DOCS_PACKAGES))
setup-python:
	$(call install_packages,$(PYTHON_PACKAGES))
setup-format:
	$(call install_packages,$(FORMAT_PACKAGES))
setup-fuzz:
	$(call install_packages,$(FUZZ_PACKAGES))
setup-coverage:
	$(call install_packages,$(COVERAGE_PACKAGES))

build: setup-program
	cmake --preset release -B $(BUILD) -DFISSURA_TESTS=OFF
	cmake --build $(BUILD) -j $(JOBS) --target fissura

build-all: setup-tests
	cmake --preset release -B $(BUILD) -DFISSURA_TESTS=ON -DFISSURA_PYTHON=ON
	cmake --build $(BUILD) -j $(JOBS)

demo: setup-demo build
	$(PROGRAM) run examples/00_demo_beam/case.toml --out runs/demo --force
	$(PROGRAM) plot runs/demo --x deflection --y load --peak -o runs/demo/load_deflection.png
	$(PROGRAM) picture runs/demo -o runs/demo/crack.png
	@if [ -f runs/demo/report.html ]; then echo "open runs/demo/report.html in a browser; crack picture: runs/demo/crack.png"; \
	else echo "no report page (above: why); crack picture: runs/demo/crack.png, curve: runs/demo/load_deflection.png"; fi

test: build-all
	ctest --test-dir $(BUILD) --output-on-failure -j 2

verify: build
	$(PYTHON) tools/verify.py --program $(PROGRAM) --runs $(BUILD)/verify --out $(BUILD)/verification.csv --jobs $(JOBS)
	$(PYTHON) tools/check_numbers.py --program $(PROGRAM) --runs $(BUILD)/verify --jobs $(JOBS)

# The property tests with as many random cases, and the free vibration with as many steps, as was promised: a quarter
# of an hour of one core.
RANDOM_CASES ?= 100000
properties: setup-tests
	cmake --preset release -B $(BUILD) -DFISSURA_TESTS=ON
	cmake --build $(BUILD) -j $(JOBS) --target laws_laws unit_rebar verification_step verification_sim
	FISSURA_RANDOM=$(RANDOM_CASES) $(BUILD)/tests/laws_laws --gtest_filter='Random*'
	FISSURA_RANDOM=10000 $(BUILD)/tests/unit_rebar --gtest_filter='Random*'
	set -e; for set in scalar v2 v3; do echo "kernels $$set"; \
	  FISSURA_KERNELS=$$set FISSURA_RANDOM=2600 $(BUILD)/tests/verification_sim --gtest_filter='Random*'; done
	FISSURA_STEPS=1000000 $(BUILD)/tests/verification_step --gtest_filter='Long*'

# All cases, an hour or more; also draws all figures and writes the verification page.
validate: build python properties
	$(PYTHON) tools/figures.py --program $(PROGRAM) --runs $(BUILD)/verify --jobs $(JOBS) --long
	$(PYTHON) tools/verify.py --program $(PROGRAM) --runs $(BUILD)/verify --out $(BUILD)/validation.csv --jobs $(JOBS) --long \
	  --page docs/verification/index.md
	$(PYTHON) tools/check_numbers.py --program $(PROGRAM) --runs $(BUILD)/verify --jobs $(JOBS) --long
	PYTHONPATH=$(BUILD)/python $(PYTHON) tools/validate_python.py --program $(PROGRAM) --runs $(BUILD)/verify
	$(PYTHON) tools/check_commands.py $(PROGRAM) --decks

# The paper's figures: those of the short runs, and of long ones that are there already; and those of the material laws.
figures: build
	$(PYTHON) tools/figures.py --program $(PROGRAM) --runs $(BUILD)/verify --jobs $(JOBS)
	cmake --build $(BUILD) --target law_curves
	$(PYTHON) tools/law_figures.py $(BUILD)/law_curves

# The numbers that the pages tell of runs, written anew: those of the short runs, with LONG=--long of all.
numbers: build
	$(PYTHON) tools/check_numbers.py --program $(PROGRAM) --runs $(BUILD)/verify --jobs $(JOBS) --write $(LONG)

# Every run folder under runs/ that holds fields gets its crack picture.
pictures: build
	@set -e; for fields in $(wildcard runs/*/fields.pvd); do run=$$(dirname $$fields); \
	  $(PROGRAM) picture $$run -o $$run/crack.png; done

# Medians of five rounds, compared with the last on this machine: some minutes.
bench: build
	$(PYTHON) bench/bench.py --program $(PROGRAM)

docs: setup-docs
	$(PYTHON) tools/check_links.py
	$(PYTHON) tools/docs_site.py $(BUILD)

# The module for PYTHONPATH=$(BUILD)/python; `pip install .` builds its own.
python: setup-python
	cmake --preset release -B $(BUILD) -DFISSURA_PYTHON=ON -DFISSURA_TESTS=OFF
	cmake --build $(BUILD) -j $(JOBS) --target fissura_python
	@echo "PYTHONPATH=$(BUILD)/python /usr/bin/python3 -c 'import fissura'"

# One reader after the other, FUZZ_SECONDS each. Starts from the corpus and the examples' decks, keeps what it learns in
# build-fuzz/corpus.
FUZZ_READERS ?= deck mesh inp record checkpoint
fuzz: setup-fuzz
	cmake --preset fuzz
	cmake --build build-fuzz -j $(JOBS) --target $(addprefix fuzz_,$(FUZZ_READERS))
	mkdir -p $(addprefix build-fuzz/corpus/,$(FUZZ_READERS))
	for deck in examples/*/case.toml; do cp $$deck build-fuzz/corpus/deck/$$(basename $$(dirname $$deck)).toml; done
	set -e; for reader in $(FUZZ_READERS); do mkdir -p tests/fuzz/corpus/$$reader; \
	  build-fuzz/tests/fuzz/fuzz_$$reader -max_total_time=$(FUZZ_SECONDS) -timeout=20 -max_len=65536 -rss_limit_mb=4096 \
	  -print_final_stats=1 -artifact_prefix=build-fuzz/$$reader- build-fuzz/corpus/$$reader tests/fuzz/corpus/$$reader; done

# Address and undefined-behaviour sanitizers on the unit tests, the laws, faults and short runs, in the tree of `make fuzz`; then the
# thread sanitizer on the tests that use threads and the same runs with four. Ends at the first report; none is suppressed but
# leaks of udunits and gmsh (tools/leaks.supp).
THREADED_TESTS  := Chunks|Sums|Threads|any_number_of_threads|AnyNumberOfThreads|Collision|RigidContact
sanitize: setup-fuzz
	cmake --preset fuzz
	cmake --build build-fuzz -j $(JOBS) --target fissura tests_unit tests_laws tests_faults tests_regression
	find build-fuzz/tests -maxdepth 1 -type f -executable | grep -E '/(unit|laws|faults|regression)_[a-z]*$$' | \
	  LSAN_OPTIONS=suppressions=$(CURDIR)/tools/leaks.supp xargs -P $(JOBS) -n 1 sh -c '"$$0" --gtest_brief=1'
	LSAN_OPTIONS=suppressions=$(CURDIR)/tools/leaks.supp tools/sanitized_runs.sh build-fuzz/fissura 2
	cmake --preset tsan
	cmake --build build-tsan -j $(JOBS) --target fissura unit_parallel unit_contact unit_rebar regression_sim verification_sim
	ctest --test-dir build-tsan -R '$(THREADED_TESTS)' --output-on-failure
	tools/sanitized_runs.sh build-tsan/fissura 4

# Which lines the tests run, and which error messages none of them provokes: build-coverage/coverage.
coverage: setup-coverage
	cmake --preset coverage
	cmake --build build-coverage -j $(JOBS)
	$(PYTHON) tools/coverage.py build-coverage --run --jobs $(JOBS) --html

format: setup-format
	git ls-files '*.cpp' '*.hpp' | xargs clang-format -i

install: build
	cmake --install $(BUILD) --prefix $(PREFIX)

clean:
	rm -rf $(BUILD) build-fuzz build-asan build-tsan build-coverage runs
