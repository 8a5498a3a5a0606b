# A thin front for CMake and scripts/. `make help` lists the targets.
PYTHON  ?= /usr/bin/python3
BLENDER ?= blender
BPY     ?= 5.0
ALL_BPY ?= 4.5 5.0
SURFACES ?= 100
SECONDS ?= 600

TOOLS := pybind11>=2.13
# What `make lint` checks with, pinned: another version finds other things.
LINTERS := ruff==0.8.4 mypy==2.4.1 numpy==2.4.6 fake-bpy-module-4.2==20260730
# Whose meshes `koebe.uniformize` takes, what its pictures are drawn with, what spreads `koebe.batch`, and what runs the
# notebook; beside scikit-learn and SciPy the wheel is tried. nilearn brings a cortex, pygeodesic its exact distances,
# numpydoc its validator of docstrings.
LABS := pytest==9.2.0 numpy==2.4.6 scikit-learn==1.9.1 scipy==1.17.1 trimesh==5.2.0 meshio==5.3.5 pyvista==0.49.1 matplotlib==3.11.2 \
        scikit-bio==0.7.4 statsmodels==0.15.0 pandas==3.1.1 \
        distributed==2026.8.0 nibabel==5.4.2 nbclient==0.11.0 ipykernel==7.4.0 \
        nilearn==0.14.1 pygeodesic==0.1.11 numpydoc==1.11.0 pyshtools==4.14.1 xarray==2026.9.0
# What the site is built with.
SITE := sphinx==9.0.4 furo==2025.12.19 myst-nb==1.4.0 breathe==5.1.0 sphinx-copybutton==0.5.2 sphinx-mathjax-offline==0.0.2 numpy==2.4.6
# What ours is compared with, and what draws it.
COMPARED := bpy==5.0.1 xatlas==0.0.11 matplotlib==3.11.2
# Tools live in a virtual environment per Python: build/venv, build/venv-python3.13 ...
VENV  := build/venv$(if $(filter-out /usr/bin/python3,$(PYTHON)),-$(notdir $(PYTHON)))
DONE  := build/.done
WHEEL := $(DONE)/wheel-$(notdir $(VENV))

NATIVE_SOURCES := CMakeLists.txt pyproject.toml $(shell find native -type f -not -path '*/__pycache__/*' -not -path 'native/apps/web/*')
ADDON_SOURCES  := $(shell find addon -type f -not -path '*/__pycache__/*')

# ccache, if present, spares the wheel what the command has compiled already. It learns of headers from the compiler, so
# that nothing is preprocessed once more.
export CCACHE_DIR := $(CURDIR)/build/ccache
export CCACHE_SLOPPINESS := pch_defines,time_macros
export CCACHE_DEPEND := 1
# Scripts leave no compiled files beside themselves.
export PYTHONDONTWRITEBYTECODE := 1
ccache = CMAKE_CXX_COMPILER_LAUNCHER=$$(command -v ccache)

.DELETE_ON_ERROR:
# Targets one after the other, but for the tests that SIDE_BY_SIDE starts: a variable, as make would hold to .NOTPARALLEL
# in the makes that it starts too.
ifndef AT_ONCE
.NOTPARALLEL:
endif
SIDE_BY_SIDE = $(MAKE) --no-print-directory --keep-going --jobs=3 --output-sync=target AT_ONCE=yes
.SECONDARY:
.PHONY: help build native programs benchmarks core wheel package dist matrix docs paper listing web lint lint-python lint-native lint-workflows check check-native check-form \
        test test-tools test-all test-native test-python test-long test-bench test-labs test-blender test-gui test-web test-site test-farms test-asan test-tsan test-fuzz fuzz build-fuzz demo bench compare reproduce bench-addon bench-many figures guide-pictures reliability samples clean distclean

# Two hashes: in the list; one: its name below the list.
help:
	@sed -n 's/^\([a-z-]*\):[^#]*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 14
	@echo also: $$(sed -n 's/^\([a-z-]*\):[^#]*# .*/\1/p' $(MAKEFILE_LIST)) | fold -s -w 79

# ---------------------------------------------------------------- build

build: native package ## build/koebe, build/python/koebe/, dist/koebe_uv-*.zip

native: build/build.ninja ## the command and the Python package
	$(ccache) cmake --build build --target koebe _koebe

programs: native # these and the native tests
	$(ccache) cmake --build build

benchmarks: native # the programs of bench/
	$(ccache) cmake --build build --target benchmarks

# Reports, the command and the Python module are read by the compiler without the extras, whose headers are not seen then.
# The layers below them are the same as in `make native`.
core: $(VENV)/.done # the core without its extras making and labs: configured, and what stands on it checked
	$(configure) -B build/core -DKOEBE_MAKING=OFF -DKOEBE_LABS=OFF -DCMAKE_CXX_FLAGS_RELEASE=-fsyntax-only >build/core.log
	ninja -C build/core $$(ninja -C build/core -t inputs koebe _koebe | grep -E '(koebe_apps[.]dir|cli|python)/.*[.]o$$')

wheel: $(WHEEL) # dist/koebe-*.whl, for PYTHON=... (default: Debian's); `make package` takes all there are

package: $(DONE)/package ## dist/koebe_uv-*.zip

configure = cmake --preset release -DPython_EXECUTABLE=$(CURDIR)/$(VENV)/bin/python \
	    -Dpybind11_DIR=$$($(VENV)/bin/python -m pybind11 --cmakedir)

build/build.ninja: CMakePresets.json $(VENV)/.done
	$(ccache) $(configure)

$(DONE)/wheel-%: $(NATIVE_SOURCES) scripts/wheel.sh scripts/pack_wheel.py build/%/.done | native
	$(ccache) scripts/wheel.sh build/$* dist
	@mkdir -p $(@D) && touch $@

# Wheels that were made for other Pythons go into the zip too, and are made again when the sources change.
$(DONE)/package: $(WHEEL) $(wildcard $(DONE)/wheel-*) $(ADDON_SOURCES) $(wildcard native/options/*) docs/guide.md docs/troubleshooting.md $(wildcard docs/data/*.csv) scripts/package_extension.py scripts/guide_html.py
	/usr/bin/python3 scripts/package_extension.py
	@touch $@

# One wheel a platform, for every Python, and its zip: from pinned sources, cross compiling (docs/developers/releases.md).
# An hour of two cores for the first of all five, a quarter of that for one.
PLATFORMS ?= linux-x64 linux-arm64 windows-x64 macos-arm64 macos-x64
PYTHONS ?= 3.10 3.11 3.12 3.13 3.14

# The source package is made of a copy of what git knows: its maker would walk through all of build/, other Debians too.
dist: build/venv-dist/.done $(DONE)/install-dist ## wheels and zips of PLATFORMS for PYTHONS, and the sources
	PYTHONS="$(PYTHONS)" scripts/dist.sh build/venv-dist $(PLATFORMS)
	/usr/bin/python3 scripts/package_extension.py --release
	rm -rf build/source && mkdir -p build/source && git ls-files -z | xargs -0 cp --parents -t build/source
	build/venv-dist/bin/python -m build --quiet --sdist --no-isolation --outdir dist build/source
	$(PYTHON) scripts/check_dist.py dist $(PYTHONS)
	scripts/audit_wheels.sh build/venv-dist dist

# As root: other Debians in folders, wine and qemu. Two hours and 10 GB the first time; NAMES="debian12 windows" takes some.
matrix: dist ## the zips of `make dist` in every Blender that can be had here
	$(PYTHON) scripts/matrix.py $(NAMES)

build/venv-dist/.done: Makefile native/bundle/requirements.txt | $(DONE)/install-build
	$(PYTHON) -m venv --clear $(@D)
	$(@D)/bin/pip install --quiet --no-deps --require-hashes -r native/bundle/requirements.txt
	$(@D)/bin/pip install --quiet build 'scikit-build-core>=0.10' 'auditwheel>=6.1' 'delvewheel>=1.10'
	@touch $@

# Sphinx reads again what has changed. Undocumented names, warnings and dead links end it.
docs: native build/docs/operators.json build/venv-docs/.done $(DONE)/install-docs ## the site: build/docs/html/
	PYTHONPATH=build/python build/venv-docs/bin/python scripts/site/build.py build/docs

build/docs/operators.json: scripts/site/blender_names.py $(ADDON_SOURCES) native/options/options.json | $(DONE)/install-blender
	@mkdir -p $(@D)
	scripts/in_own_home.sh $(BLENDER) scripts/site/blender_names.py $@ >$(@D)/blender.log || { cat $(@D)/blender.log; exit 1; }

listing: package $(DONE)/install-blender $(DONE)/install-gui $(DONE)/install-paper # text and pictures for extensions.blender.org: dist/listing/
	PATH=/usr/bin:$$PATH xvfb-run -a -s '-screen 0 1920x1080x24' $(PYTHON) scripts/listing/pictures.py dist/listing
	cp scripts/listing/listing.md dist/listing

# As the Journal of Open Source Software asks for it; its own typesetting differs.
paper: $(DONE)/install-paper # the paper on the project: build/paper/paper.pdf
	@mkdir -p build/paper
	$(PYTHON) paper/figures.py
	cd paper && pandoc paper.md --from markdown --citeproc --lua-filter authors.lua --pdf-engine xelatex --variable colorlinks \
	    --variable geometry:margin=25mm --output ../build/paper/paper.pdf

# Ten minutes of two cores the first time.
web: $(DONE)/install-web build/web/page/installed ## the page for browsers: dist/web/
	$(ccache) CMAKE_C_COMPILER_LAUNCHER=$$(command -v ccache) scripts/web.sh dist/web

# Packages of the page, and the tools that test it and the site.
build/web/page/installed: native/apps/web/page/package-lock.json | $(DONE)/npm
	@mkdir -p $(@D)
	cp native/apps/web/page/package.json $< $(@D)
	npm ci --prefix $(@D) --ignore-scripts --no-audit --no-fund --loglevel=error
	@touch $@

$(DONE)/npm $(DONE)/go: $(DONE)/%:
	command -v $* >/dev/null || scripts/install.sh $*
	@mkdir -p $(@D) && touch $@

# ---------------------------------------------------------------- tests

# Three runners at once: each uses half of a core, as it waits for processes that it starts. Each runs, whatever became of
# the others, and is printed when it has ended. The longest begin, in halves by the first letter of the files, so that all
# end at one time. What they need is made before, by one process: two would wait for apt's lock, and fail. What no version
# of Blender changes is tested in one of them.
test: build test-tools ## what a user could hit, in Debian's Blender and in bpy too
	@$(SIDE_BY_SIDE) $(BPY:%=test-differing-%) test-blender-a-m test-blender-n-z test-python-a-m test-python-n-z \
	    test-native test-labs

test-tools: programs $(DONE)/install-blender build/venv-labs/.done $(BPY:%=build/venv-bpy-%/.done)

test-all: lint test test-long test-bench test-fuzz test-web test-site $(ALL_BPY:%=test-bpy-%) ## before a release: lint, test, long searches, fuzzing, the site

# Slow native tests have names that begin with slow_, slow Python tests have the mark slow.
check: programs build/venv-lint/.done $(DONE)/install-lint ## the fast tests and the form of what changed: two minutes
	@begin=$$(date +%s); $(SIDE_BY_SIDE) check-native check-python-a-m check-python-n-z check-form; \
	    result=$$?; echo "make check: $$(($$(date +%s) - begin)) s"; exit $$result

native_tests = for program in native/koebe_tests native/koebe_thread_tests native/koebe_kernel_tests fuzz/koebe_corpus_tests; do \
	    build/tests/$$program --gtest_brief=1 --gtest_filter='$(1)' || result=1; done

check-native:
	@result=0; $(call native_tests,-*.slow_*); exit $$result

# By the first letter of the files: two halves of the time.
python_tests = tests/python/test_[$*]*.py $(if $(filter a-m,$*),scripts/tests)
check-python-%:
	@PYTHONPATH=build/python $(PYTHON) -m pytest -q -p no:cacheprovider -m 'not slow' $(python_tests)

check-form: lint-python
	git diff --name-only --diff-filter=d HEAD -- '*.h' '*.cpp' | xargs --no-run-if-empty clang-format --dry-run -Werror

# Each program once: ctest would start it once a test.
test-native: programs ## the native tests
	@result=0; $(call native_tests,*); ctest --preset release -R '^package' || result=1; exit $$result

test-python: programs ## pytest tests/python and scripts/tests
	PYTHONPATH=build/python $(PYTHON) -m pytest -p no:cacheprovider -m 'not long' tests/python scripts/tests

test-python-%: programs
	PYTHONPATH=build/python $(PYTHON) -m pytest -p no:cacheprovider --durations=12 -m 'not long' $(python_tests)

test-long: programs # the Python tests that are marked long
	PYTHONPATH=build/python $(PYTHON) -m pytest -p no:cacheprovider -m long tests/python

# Not in `make test`: no user runs bench/.
test-bench: benchmarks build/venv-labs/.done ## pytest bench/tests: figures of docs/, the paper's tables
	PYTHONPATH=build/python MPLBACKEND=agg build/venv-labs/bin/python -m pytest -p no:cacheprovider --durations=12 bench/tests

test-labs: $(WHEEL) build/venv-labs/.done ## pytest tests/labs, beside other packages' meshes
	PYTHONPATH=build/python MPLBACKEND=agg build/venv-labs/bin/python -m pytest -p no:cacheprovider tests/labs

test-blender: package $(DONE)/install-blender ## tests/blender in $(BLENDER)
	scripts/blender_tests.sh $(BLENDER)

test-blender-%: package $(DONE)/install-blender
	scripts/blender_tests.sh $(BLENDER) --durations=12 --ignore-glob='tests/blender/test_[!$*]*'

test-bpy-%: package build/venv-bpy-%/.done
	scripts/blender_tests.sh build/venv-bpy-$*/bin/python

test-differing-%: package build/venv-bpy-%/.done
	scripts/blender_tests.sh build/venv-bpy-$*/bin/python --durations=12 -m 'not alike'

# Not in `make test`: it wants a machine that does nothing else, and knows where the sidebars of 3.4 and 4.3 have their tabs.
test-gui: package $(DONE)/install-blender $(DONE)/install-gui # clicks and keys in Blender's window: out/gui/
	PATH=/usr/bin:$$PATH xvfb-run -a -s '-screen 0 1280x800x24' \
	    $(PYTHON) -m pytest -p no:cacheprovider -rA tests/gui

test-web: native web $(DONE)/install-browser # the page in Chromium, and its command without a browser: out/web/
	node --test tests/web/*.test.mjs

# The contrast of letters, names for readers of screens, and the width of a phone: axe-core in Chromium.
test-site: docs build/web/page/installed $(DONE)/install-browser # the site: accessible, and as wide as a phone
	node --test tests/web/site.test.mjs

# A Slurm of two nodes on this machine: it wants root, and minutes.
test-farms: native $(DONE)/install-farms # koebe batch as a Slurm job array and as a Flamenco job, a node lost half way
	$(PYTHON) -m pytest -p no:cacheprovider -rA tests/farms

# A quarter of an hour: not in `make test` either.
soak: package $(DONE)/install-blender # 2,000 maps in one Blender, the memory measured
	scripts/in_own_home.sh $(BLENDER) bench/soak.py $$PWD/dist/koebe_uv-$$(scripts/version.sh).zip

test-asan: $(VENV)/.done # the native tests under the address and undefined behaviour sanitizers
	$(ccache) cmake --preset asan
	cmake --build --preset asan
	ctest --preset asan

test-tsan: $(VENV)/.done # calls at once, progress and cancel under the thread sanitizer
	$(ccache) cmake --preset tsan
	cmake --build --preset tsan --target koebe_thread_tests
	TSAN_OPTIONS="suppressions=$(CURDIR)/tests/native/tsan.supp:second_deadlock_stack=1" \
	    build-tsan/tests/native/koebe_thread_tests

# The same inputs in the same order each time, as far as a minute goes; `make fuzz` takes others each time.
test-fuzz: build-fuzz # the fuzz targets for a minute
	scripts/fuzz.sh build-fuzz 60 1

fuzz: build-fuzz # all fuzz targets, $(SECONDS) seconds in all; findings go to build-fuzz/findings
	scripts/fuzz.sh build-fuzz $(SECONDS)

build-fuzz: $(VENV)/.done $(DONE)/install-fuzz
	$(ccache) cmake --preset fuzz
	cmake --build --preset fuzz

# ---------------------------------------------------------------- form and types

lint: lint-python lint-workflows lint-native ## form and types: what is wrong is said, nothing is changed

lint-python: build/venv-lint/.done
	build/venv-lint/bin/ruff check addon bench blend_samples native paper scripts tests
	rm -rf build/types && mkdir -p build/types && cp -rp native/python/koebe build/types
	$(PYTHON) native/options/generate.py build/types/koebe
	build/venv-lint/bin/mypy

# The last version that Debian 12's Go compiles. It has shellcheck look at the workflows' commands, too.
lint-workflows: build/actionlint/actionlint $(DONE)/install-shellcheck
	$<
	shellcheck --severity=warning .ci/run scripts/*.sh scripts/farms/*.sh

build/actionlint/actionlint: | $(DONE)/go
	GOBIN=$(CURDIR)/$(@D) go install github.com/rhysd/actionlint/cmd/actionlint@v1.7.7

# Six minutes of two cores: clang-tidy reads each source with all of Eigen. FILES="native/... ..." looks at those alone,
# SHARE=0/7 at every seventh.
lint-native: $(VENV)/.done $(DONE)/install-lint
	$(configure) -B build/lint -DKOEBE_UNITY=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON >build/lint.log
	find native tests bench \( -name '*.h' -o -name '*.cpp' \) -print0 | xargs -0 clang-format --dry-run -Werror
	SHARE=$(SHARE) scripts/clang_tidy.sh build/lint $(FILES)

# ---------------------------------------------------------------- demo, bench, samples

demo: build $(DONE)/install-blender ## uniformize and render the samples: out/
	@$(PYTHON) scripts/demo.py

bench: build $(DONE)/install-blender $(DONE)/install-bench ## time and accuracy: out/bench/
	$(configure)
	$(ccache) cmake --build build --target benchmarks
	$(PYTHON) bench/run.py

# It goes on where it ended. AGAIN=1: anew; MODELS=FOLDER: more models; OPTCUTS=PROGRAM: that too.
compare: native build/venv-compare/.done ## Blender's unwraps, xatlas and ours: docs/comparison.md
	build/venv-compare/bin/python bench/compare.py --write $(if $(AGAIN),--again)

reproduce: benchmarks # the paper's tables, rates and figures: out/reproduce/
	$(PYTHON) bench/reproduce.py

bench-addon: native $(DONE)/install-blender # what the add-on costs beside the native call
	$(BLENDER) --background --factory-startup --python-exit-code 1 --python bench/addon_overhead.py

bench-many: native build/venv-labs/.done # COUNT=10000 small surfaces at once: surfaces a second a core, what processes and Dask cost
	PYTHONPATH=build/python build/venv-labs/bin/python bench/many_surfaces.py $(COUNT)

figures: benchmarks $(DONE)/install-blender build/venv-labs/.done ## measure the figures of README.md and docs/, and draw pictures
	$(PYTHON) bench/doc_figures.py
	scripts/guide_pictures.sh drawn
	scripts/guide_pictures.sh plotted

guide-pictures: test-gui # the guide's pictures of the window
	scripts/guide_pictures.sh window

reliability: native # random surfaces, SURFACES=100 of each kind, every answer checked: docs/reliability.md
	$(PYTHON) bench/reliability.py --surfaces $(SURFACES) --write

samples: $(DONE)/install-blender # make blend_samples/*.blend again
	$(BLENDER) --background --factory-startup --python-exit-code 1 --python blend_samples/make_samples.py

# ---------------------------------------------------------------- what all of this needs

$(DONE)/install-%: scripts/install.sh
	scripts/install.sh $*
	@mkdir -p $(@D) && touch $@

$(VENV)/.done: | $(DONE)/install-build
	$(PYTHON) -m venv $(VENV)
	$(VENV)/bin/pip install --quiet $(TOOLS:%='%')
	@touch $@

build/venv-lint/.done: Makefile | $(DONE)/install-build
	$(PYTHON) -m venv --clear $(@D)
	$(@D)/bin/pip install --quiet $(LINTERS)
	@touch $@

build/venv-labs/.done: Makefile | $(DONE)/install-build
	/usr/bin/python3 -m venv --clear $(@D)
	$(@D)/bin/pip install --quiet --no-compile $(LABS)
	@touch $@

build/venv-docs/.done: Makefile | $(DONE)/install-build
	/usr/bin/python3 -m venv --clear $(@D)
	$(@D)/bin/pip install --quiet $(SITE)
	@touch $@

build/venv-compare/.done: Makefile | $(DONE)/install-build $(DONE)/install-blender
	/usr/bin/python3 -m venv --clear $(@D)
	$(@D)/bin/pip install --quiet $(COMPARED)
	@touch $@

build/venv-bpy-%/.done: | $(DONE)/install-build $(DONE)/install-blender
	@echo "Installing bpy $* (about 350 MB) into $(@D)"
	/usr/bin/python3 -m venv --clear $(@D)
	$(@D)/bin/pip install --quiet --no-compile 'bpy==$*.*' pytest
	@touch $@

clean: ## remove what was built, keep the virtual environments
	rm -rf build-* dist out $(filter-out $(wildcard build/venv*),$(wildcard build/* build/.done build/.ninja*))

distclean: # remove everything that is not in the repository
	rm -rf build build-* dist out
