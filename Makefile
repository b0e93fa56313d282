# Everyday commands; `make help` lists them. The build itself is CMake's (CMakeLists.txt, CMakePresets.json).
.DEFAULT_GOAL := build
.DELETE_ON_ERROR:
.NOTPARALLEL:
.SUFFIXES:

PROGRAM := build/spectrad
CORES := $(shell nproc)
CODE := $(shell find src tests bench \( -name '*.cpp' -o -name '*.h' \))

##build           the program: build/spectrad
.PHONY: build
build: $(PROGRAM)

##demo            install what is missing, build, render the showcase scenes into out/
.PHONY: demo
PICTURES := colorchecker colorchecker-FL11 still-life pavilion chess figure5 display coloured-shadows gloss-ladder metal-ladder fluorescence textured relief
demo: packages $(PICTURES:%=out/%.exr) $(PICTURES:%=out/%.png)
	@echo "Spectral images (W.m^-2.sr^-1.nm^-1): $(PICTURES:%=out/%.exr)"
	@echo "Pictures of them for the screen:      $(PICTURES:%=out/%.png)"

##test            install what is missing, build everything, run the whole suite
.PHONY: test
test: packages packages-test build/build.ninja
	cmake --build build
	ctest --test-dir build --output-on-failure --parallel $(CORES)

##test-sanitized  the unit tests under AddressSanitizer and UndefinedBehaviorSanitizer, in build-debug/
.PHONY: test-sanitized
UNITS := base spectrum colour camera metamer scene image render study fuzz
test-sanitized: packages debug-configured
	cmake --build build-debug --target $(UNITS:%=test_%)
	ctest --test-dir build-debug --output-on-failure --parallel $(CORES) -R '^($(subst $() $(),|,$(UNITS)))$$'

##extremes        numbers, faults and hostile input at their limits; a report in out/extremes.md (FUZZ_SECONDS=3600 HEAVY=1: hours)
.PHONY: extremes
FUZZ_SECONDS := 120
FUZZERS := scene table words exr envi png jpeg
extremes: packages packages-test build/build.ninja | out
	cmake --build build --target spectrad
	if command -v clang++ > /dev/null; then cmake --preset fuzz && cmake --build build-fuzz --target $(FUZZERS:%=fuzz_%); fi
	python3 tests/extremes/report.py $(PROGRAM) out/extremes.md --fuzz-folder build-fuzz --seconds $(FUZZ_SECONDS) $(if $(HEAVY),--heavy)

##accuracy        docs/accuracy-study.md and its plots: every scene under six lamps, measured anew (half an hour)
.PHONY: accuracy
accuracy: $(PROGRAM)
	python3 docs/accuracy_study.py $(PROGRAM) out/accuracy

##figures         the paper's figures 2 to 5 and a table of what was measured in them, in out/figures/
.PHONY: figures
figures: $(PROGRAM)
	python3 scenes/paper/figures.py $(PROGRAM) out/figures
	@cat out/figures/differences.md

##debug           the program with those sanitizers: build-debug/spectrad (run it with ASAN_OPTIONS=detect_leaks=0)
.PHONY: debug debug-configured
debug: debug-configured
	cmake --build build-debug --target spectrad
debug-configured:
	cmake --preset debug

##bench           build and run the benchmarks
.PHONY: bench
bench: packages build/build.ninja
	cmake --build build
	@for program in build/bench_*; do [ ! -x "$$program" ] || "$$program" || exit 1; done

##format          clang-format everything in C++
.PHONY: format
format: packages-test
	clang-format -i $(CODE)

##tidy            clang-tidy on what the build compiles
.PHONY: tidy
tidy: packages-develop build/build.ninja
	cmake --build build
	run-clang-tidy -quiet -p build -extra-arg=-Wno-unknown-warning-option '/(src|tests|bench)/'

##packages        install the Debian packages that the build needs (cmake/packages.txt)
.PHONY: packages packages-test packages-develop
packages:
	@cmake/packages.sh install build
packages-test packages-develop: packages-%:
	@cmake/packages.sh install $*

##clean           remove build/, build-debug/ and out/
.PHONY: clean
clean:
	rm -rf build build-debug build-fuzz out

##help            this list
.PHONY: help
help:
	@sed -n 's/^##/make /p' Makefile

build/build.ninja:
	@cmake/packages.sh check build
	cmake --preset release

# Ninja knows what is out of date; what it leaves alone makes no picture out of date.
.PHONY: always
$(PROGRAM): build/build.ninja always
	cmake --build build --target spectrad

# A picture is rendered anew when its scene, a model, a spectrum or the program has changed.
SPECTRA := $(shell find spectra -name '*.csv')
FL11 := --set lamp.spectrum=illuminants/FL11
EXPOSURE_chess := -0.4
EXPOSURE_gloss-ladder := -1
EXPOSURE_fluorescence := -0.2
EXPOSURE_colorchecker := -0.13
EXPOSURE_colorchecker-FL11 := -0.13
define RENDER
$(PROGRAM) render $< -o out/$(1).exr $(2)
$(PROGRAM) observe out/$(1).exr -o out/$(1).png --exposure $(or $(EXPOSURE_$(1)),0) --quiet
endef

out/%.exr out/%.png: scenes/%.xml $(PROGRAM) $(SPECTRA) | out
	$(call RENDER,$*)
out/%.exr out/%.png: scenes/paper/%.xml $(PROGRAM) $(SPECTRA) | out
	$(call RENDER,$*)
out/%.exr out/%.png: scenes/passes/%.xml $(PROGRAM) $(SPECTRA) | out
	$(call RENDER,$*)
out/%.exr out/%.png: scenes/models/%.dae $(PROGRAM) $(SPECTRA) | out
	$(call RENDER,$*)
out/%-FL11.exr out/%-FL11.png: scenes/%.xml $(PROGRAM) $(SPECTRA) | out
	$(call RENDER,$*-FL11,$(FL11))
out/relief.exr out/relief.png: $(wildcard scenes/reliefs/*.png)
out/pavilion.exr out/pavilion.png: scenes/models/pavilion.gltf
out:
	mkdir out
