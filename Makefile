# SPDX-License-Identifier: BSD-3-Clause
# The words this project is worked with; `make help` lists them. CMake does the building, tools/ holds what is longer
# than a line. Words that need packages install them where they are missing (tools/bootstrap).
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 60
BENCH ?=
ROUNDS ?= 5
export FUZZ_SECONDS

.PHONY: help setup build demo test bench bases palettes pictures accuracy format lint asan tsan fuzz peers big emulate install clean

help: ## this list
	@sed -nE 's/^([a-z]+):.*## /  make \1\t/p' Makefile | expand -t 18

setup: ## install what building and testing need (Debian)
	@tools/bootstrap

build: ## build/release/metamer
	@tools/bootstrap --quiet build && tools/build release

demo: ## render the engine once, light it three times, into demo/
	@tools/demo

test: ## everything before a commit: all tests, lint, all tests again under ASan and UBSan
	@tools/bootstrap --quiet
	@tools/check release && tools/lint && tools/check asan
	@echo "make test: all passed"

bench: ## how long the steps of pictures take (BENCH="--suite frames --runs 20")
	@tools/bootstrap --quiet build && tools/build release
	@build/release/metamer bench $(BENCH)

bases: ## fit the tables of data/bases again, in place
	@tools/bootstrap --quiet build && tools/build release
	@build/release/accuracy/fit . data/bases

palettes: ## design the palettes of examples/ again, in place
	@tools/bootstrap --quiet build && tools/build release metamer
	@for goals in examples/*/*.goals.json; do build/release/metamer design $$goals -o $${goals%goals.json}palette.json || exit; done

pictures: ## render the pictures of README.md and docs/design.md again
	@tools/bootstrap --quiet build && tools/build release metamer
	@tools/pictures

accuracy: ## measure the bases again into docs/accuracy.md (MORE=folder)
	@tools/bootstrap --quiet build && tools/build release
	@build/release/accuracy/report $(if $(MORE),--more '$(MORE)') . docs

format: ## format all C sources in place
	@tools/bootstrap --quiet && tools/list_files '*.c' '*.h' | xargs clang-format -i

lint: ## layers, text rules, format, clang-tidy, shell scripts
	@tools/bootstrap --quiet && tools/lint

asan: ## build and test with AddressSanitizer and UndefinedBehaviorSanitizer
	@tools/bootstrap --quiet && tools/check asan

tsan: ## build and test with ThreadSanitizer
	@tools/bootstrap --quiet && tools/check tsan

fuzz: ## FUZZ_SECONDS (default 60) of libFuzzer for every reader
	@tools/bootstrap --quiet && tools/fuzz

peers: ## speed against VTK, VolPack and libvips on this machine, asked and measured (METAMER_DATA, ROUNDS=…)
	@tools/bootstrap --quiet peers && tools/build release metamer peers
	@tools/peers $(ROUNDS)

big: ## how much memory a volume of 1024³ voxels takes, and what its picture loses (1 GiB in build/big)
	@tools/bootstrap --quiet build && tools/build release
	@tools/big

emulate: ## on a processor without AVX and on arm64, under QEMU: tests, and pictures against this machine's
	@tools/bootstrap --quiet emulate
	@tools/build --tests release && tools/build --tests arm64
	@tools/emulate

install: ## install to PREFIX (default /usr/local), below DESTDIR
	@tools/bootstrap --quiet build && tools/build release
	@DESTDIR='$(DESTDIR)' cmake --install build/release --prefix '$(PREFIX)'

clean: ## remove everything that was built
	@rm -rf build demo
