# Everything lives in .venv; needs python3 (3.11 or newer), g++ and make. Rebuilt only when its sources change.
PYTHON ?= python3
BIN := .venv/bin
SANITIZED := $(addprefix tests/,polygons scene forbidden collision/test_motion.py collision/test_slide.py collision/test_pose_checker.py formats/boundaries/test_boundary_file.py contact/test_surface.py free planning/test_plan.py)
CPP := $(wildcard cpp/*/*.?pp cpp/src/*/*.?pp cpp/include/cfree/*/*.hpp)
INSTALLED := .venv/installed
TESTED := .venv/tested
INSTALL := $(BIN)/pip install -q --disable-pip-version-check
# With tools of .venv and objects that stay: what is installed again later compiles only what has changed.
TOOLS := scikit-build-core nanobind boost-headers cmake ninja
DEV := .venv/rebuilt-at-import
NODE_MODULES := viewer/node_modules/.package-lock.json
HERE = --no-build-isolation --config-settings=build-dir=$(if $(wildcard $(DEV)),build/dev $(REBUILT),'build/{wheel_tag}' $(ONCE)) -e
ONCE := --config-settings=cmake.define.CFREE_UNITY=ON
REBUILT := --config-settings=editable.rebuild=true --config-settings=editable.verbose=false

unexport PYTHONDONTWRITEBYTECODE  # else each process compiles all it imports

PARKING = examples/scenes/benchmr_parking1.json
SWIM = examples/scenes/nest_swim.json

.PHONY: help build demo test check rest ctest sanitize notebooks wheels fuzz fuzz-answers fuzz-files fuzz-readers fuzz-drawings fuzz-round fuzz-arcs fuzz-rounded fuzz-facing fuzz-fits fuzz-nesting fuzz-cages fuzz-routes lint bench docs viewer viewer-test dev stub clean

help:  ## this list
	@sed -n 's/^\([a-z-]*\):.*## /\1\t/p' Makefile | expand -t 14

build: $(TESTED)  ## cfree and all that its tests need, into .venv

demo: $(INSTALLED)  ## a path into a car park, a proof that another robot cannot get out, both verified, into demo/
	mkdir -p demo
	$(BIN)/cfree plan $(PARKING) -o demo/parking.json --picture demo/parking.png
	$(BIN)/cfree verify $(PARKING) demo/parking.json
	$(BIN)/cfree plan $(SWIM) -o demo/swim.json --picture demo/swim.png || test $$? -eq 1  # proved impossible
	$(BIN)/cfree verify $(SWIM) demo/swim.json
	$(BIN)/cfree boundary $(PARKING) -o demo/parking.npz --mesh demo/parking.glb

test: $(TESTED)  ## the quick tests, in a few minutes
	$(BIN)/python -m pytest -n 2 --dist worksteal -m "not slow"

check: test  ## every test, those of the core under sanitizers, types and style
	$(MAKE) -j 2 --output-sync $(TESTED) ctest lint
	$(BIN)/python -m pytest -n 2 --dist worksteal -m slow  # files of tests stay together as long as there are enough

rest: $(INSTALLED)  ## what `make test` leaves out, but for the longest tests and most cases of tests that have many
	$(MAKE) -j 2 --output-sync $(TESTED) ctest lint
	$(BIN)/python -m pytest -n 2 --dist worksteal -m "slow and not long" --one-of 3

ctest: $(INSTALLED)  ## the core's own tests, without Python, under the address and undefined-behaviour sanitizers
	$(BIN)/cmake -S . -B build/ctest -DCFREE_SANITIZE=ON -DCFREE_UNITY=ON -DCMAKE_CXX_FLAGS_RELEASE=-O0 \
	  -DPython_EXECUTABLE=$(CURDIR)/$(BIN)/python > build/ctest.log  # not optimized: half of the compiler's time
	$(BIN)/cmake --build build/ctest -j 2 >> build/ctest.log
	$(BIN)/ctest --test-dir build/ctest -j 2 --output-on-failure

sanitize: $(TESTED) ctest  ## tests in Python under them, with an extension and an environment of their own
	$(PYTHON) -m venv build/sanitize
	$(BIN)/python -c "import sysconfig; print(sysconfig.get_path('purelib'))" \
	  > $$(build/sanitize/bin/python -c "import sysconfig; print(sysconfig.get_path('purelib'))")/installed.pth
	build/sanitize/bin/pip install -q --disable-pip-version-check --no-deps --force-reinstall \
	  --config-settings=build-dir=build/sanitize-core --config-settings=cmake.define.CFREE_SANITIZE=ON \
	  --config-settings=cmake.define.CMAKE_CXX_FLAGS_RELEASE="-O1 -g1" .
	LD_PRELOAD="$$($(CXX) -print-file-name=libasan.so) $$($(CXX) -print-file-name=libstdc++.so)" ASAN_OPTIONS=detect_leaks=0 \
	  build/sanitize/bin/python -m pytest -n 2 $(SANITIZED)

fuzz: $(TESTED)  ## random degenerate scenes against exact slices; SECONDS=600 SEED=0 unless given
	$(BIN)/python tests/support/fuzz.py --seconds $(or $(SECONDS),600) --seed $(or $(SEED),0)

fuzz-answers: $(TESTED)  ## questions whose answers are known, and hard ones, asked both ways and in other words
	$(BIN)/python tests/support/fuzz_answers.py --seconds $(or $(SECONDS),600) --seed $(or $(SEED),0)

fuzz-files: $(TESTED)  ## files of boundaries with flipped bits
	$(BIN)/python tests/support/fuzz_files.py --seconds $(or $(SECONDS),600) --seed $(or $(SEED),0)

fuzz-readers: $(TESTED)  ## damaged and hostile drawings, maps and footprints; bombs of a million parts
	$(BIN)/python tests/support/fuzz_readers.py --count $(or $(COUNT),100000) --seed $(or $(SEED),0)000000
	$(BIN)/python tests/support/fuzz_readers.py --count 50 --seed $(or $(SEED),0)000999 --step 1000 --most 1000000

fuzz-drawings: $(TESTED)  ## generated drawings against their known regions
	$(BIN)/python tests/support/fuzz_drawings.py --count $(or $(COUNT),10000) --seed $(or $(SEED),0)000000

fuzz-round: $(TESTED)  ## thin and flat round shapes against exact points of their rims
	$(BIN)/python tests/support/fuzz_thin.py --count $(or $(COUNT),100000) --seed $(or $(SEED),0)

fuzz-arcs: $(TESTED)  ## poses and motions among segments and arcs against fine polygons, exact numbers and themselves
	$(BIN)/python tests/support/fuzz_arcs.py --count $(or $(COUNT),2000) --seed $(or $(SEED),0)

fuzz-rounded: $(TESTED)  ## surfaces and cells of rounded shapes against distances, slices, and the same space in other forms
	$(BIN)/python tests/support/fuzz_rounded.py --count $(or $(COUNT),2000) --seed $(or $(SEED),0)

fuzz-facing: $(TESTED)  ## cells where concave arcs face convex ones against exact poses; COUNT=500 SEED=0
	$(BIN)/python tests/support/fuzz_facing.py --count $(or $(COUNT),500) --seed $(or $(SEED),0)

fuzz-fits: $(TESTED)  ## exact fits of rounded shapes, in concave arcs as well, against exact tests of poses
	$(BIN)/python tests/support/round_fits.py --count $(or $(COUNT),100) --seed $(or $(SEED),0)
	$(BIN)/python tests/support/hollow_fits.py --count $(or $(COUNT),100) --seed $(or $(SEED),0)

fuzz-nesting: $(TESTED)  ## no-fit polygons against exact slices, layouts against overlaps by the same slices
	$(BIN)/python tests/support/fuzz_nesting.py --count $(or $(COUNT),10000) --seed $(or $(SEED),0)

fuzz-cages: $(TESTED)  ## cages against flooding, discs and points against polygons; COUNT=2000 SEED=0
	$(BIN)/python tests/support/fuzz_cages.py --count $(or $(COUNT),2000) --seed $(or $(SEED),0)

fuzz-routes: $(TESTED)  ## routes from room to room in mazes, against plans of the whole scene; COUNT=200 SEED=0
	$(BIN)/python tests/support/fuzz_routes.py --count $(or $(COUNT),200) --seed $(or $(SEED),0)
	$(BIN)/python tests/support/fuzz_routes.py --count $(or $(COUNT),200) --seed $(or $(SEED),0) --round

lint: $(TESTED)  ## style and types
	$(BIN)/ruff check src tests benchmarks examples tools
	$(BIN)/mypy
	$(BIN)/mypy tools/check_answer.py
	test ! -e viewer/node_modules/.bin/prettier || npm --prefix viewer run --silent format:check

bench: $(TESTED)  ## figures against baselines measured in the same run
	$(BIN)/python benchmarks/run.py

docs: .venv/documented  ## the documentation as pages, into docs/_build/html
	$(BIN)/python -m sphinx -W --keep-going -q docs docs/_build/html

.venv/documented: $(INSTALLED)
	$(INSTALL) $(HERE) '.[test,docs]'
	touch $@

wheels:  ## the packages of this machine, tried in new environments, into dist; PYTHONS="python3.11 python3.12"
	$(PYTHON) tools/build_wheels.py $(or $(PYTHONS),python3.11 python3.12)

notebooks:  ## the tutorials as notebooks, into examples/notebooks
	$(PYTHON) tools/notebooks.py

viewer: $(INSTALLED) $(NODE_MODULES)  ## the page, src/cfree/viewer/page.html: needs node, npm and Debian's emscripten and node-acorn
	npm --prefix viewer run --silent format:check
	npm --prefix viewer run --silent check
	node viewer/build.mjs --boost "$$($(BIN)/python -c 'import boost_headers; print(boost_headers.get_include())')" \
	  --hash "$$($(BIN)/python tools/page_hash.py)"

viewer-test: $(NODE_MODULES)  ## unit tests of the page's modules that need no browser: needs node and npm
	npm --prefix viewer run --silent test

$(NODE_MODULES): viewer/package-lock.json
	npm --prefix viewer ci --silent --ignore-scripts --no-audit --no-fund
	touch $@

dev: .venv/bin/python  ## for work on the core: rebuilt at import whenever a C++ source has changed
	touch $(DEV)
	rm -f $(INSTALLED) $(TESTED)
	$(MAKE) $(TESTED)

stub: $(TESTED)  ## after a change of the binding
	$(BIN)/python -m nanobind.stubgen -q -m cfree._core -o src/cfree/_core.pyi

clean:  ## away with .venv, build and demo
	rm -rf .venv build demo

.venv/bin/python:
	$(PYTHON) -m venv .venv

$(INSTALLED): pyproject.toml CMakeLists.txt $(CPP) | .venv/bin/python
	$(INSTALL) --no-compile $(TOOLS)  # Python compiles what it imports: pip would compile all
	$(INSTALL) --no-compile $(HERE) .
	touch $@

$(TESTED): $(INSTALLED)
	$(INSTALL) --no-compile $(HERE) '.[test]'
	touch $@
