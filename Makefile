# SPDX-License-Identifier: BSD-3-Clause
# The words this project is worked with; `make help` lists them. CMake does the building.
.PHONY: help setup build test asan tsan format lint clean

help: ## this list
	@grep -hE '^[a-z]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z]+):.*## /  make \1\t/' | expand -t 18

setup: ## install what building and testing need (Debian)
	@tools/bootstrap

build: ## build/release/metamer
	@cmake --preset release >build.log 2>&1 || { cat build.log; rm -f build.log; exit 1; }; rm -f build.log
	@cmake --build --preset release

format: ## format all C sources in place
	@clang-format -i $$(git ls-files '*.c' '*.h')

clean: ## remove everything that was built
	@rm -rf build demo
