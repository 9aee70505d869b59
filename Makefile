# Everything lives in .venv; needs python3 (3.11 or newer), g++ and make. Rebuilt only when its sources change.
PYTHON ?= python3
BIN := .venv/bin
CPP := $(wildcard cpp/*/*.cpp cpp/include/cfree/*.hpp)
INSTALLED := .venv/installed

.PHONY: demo test ctest lint bench dev stub clean

demo: $(INSTALLED)  ## the boundary of the forbidden space of a car park, into demo/
	$(BIN)/cfree boundary examples/scenes/benchmr_parking1.json \
	  -o demo/parking.npz --picture demo/parking.png --mesh demo/parking.glb

test: $(INSTALLED) ctest lint  ## every test
	$(BIN)/python -m pytest -n 2

ctest: $(INSTALLED)  ## the core's own tests, without Python
	$(BIN)/cmake -S . -B build/ctest -DPython_EXECUTABLE=$(CURDIR)/$(BIN)/python > build/ctest.log
	$(BIN)/cmake --build build/ctest -j 2 >> build/ctest.log
	$(BIN)/ctest --test-dir build/ctest --output-on-failure

lint: $(INSTALLED)
	$(BIN)/ruff check src tests benchmarks examples
	$(BIN)/mypy

bench: $(INSTALLED)  ## figures against baselines measured in the same run
	$(BIN)/python benchmarks/run.py

dev: .venv/bin/python  ## for work on the core: rebuilt at import whenever a C++ source has changed
	$(BIN)/pip install -q scikit-build-core nanobind boost-headers cmake ninja
	$(BIN)/pip install -q --no-build-isolation -C editable.rebuild=true -C editable.verbose=false -C build-dir=build/dev -e '.[test]'
	touch $(INSTALLED)

stub: $(INSTALLED)  ## after a change of the binding
	$(BIN)/python -m nanobind.stubgen -q -m cfree._core -o src/cfree/_core.pyi

clean:
	rm -rf .venv build demo

.venv/bin/python:
	$(PYTHON) -m venv .venv

$(INSTALLED): pyproject.toml CMakeLists.txt $(CPP) | .venv/bin/python
	$(BIN)/pip install -q --disable-pip-version-check -e '.[test]'
	mkdir -p build
	touch $@
