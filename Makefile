# Londra. `make run` and `make test` set up what a fresh Debian or Ubuntu machine with Rust lacks; everything else is cargo.

CARGO ?= cargo
TEST = $(CARGO) test --locked

.PHONY: run test test-all setup bake heads gallery atlas fmt-check lint doc help

help: ## this list
	@grep -E '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/^([a-z-]+):.*## /make \1\t/'

run: setup ## build and open the viewer; without a display, draw the contact sheet
	@scripts/run.sh

test: setup ## every test, with a sample of the large sweeps
	$(TEST) --features ui-tests
	@echo "The engine alone, without the dog and without graphics:"
	$(TEST) --no-default-features
	@echo "The bits of a frame do not depend on optimisation:"
	$(TEST) --profile unoptimised --no-default-features --features head --test frame_hash --test motion_hash --test engine_hash
	$(TEST) --release --no-default-features --features head --test frame_hash --test motion_hash --test engine_hash

test-all: export LONDRA_SWEEP = all
test-all: test ## every test, with the large sweeps in full

setup: ## install what is missing (Debian, Ubuntu)
	@scripts/setup.sh

bake: ## rebuild the baked assets
	$(CARGO) run --release --locked -- bake

heads: ## redraw docs/heads.png: every breed in four views, at one scale
	$(CARGO) run --release --locked -- sheet --breeds all --level 3 --columns 3 --hair off --size 960x1920 -o docs/heads.png

gallery: ## redraw docs/gallery.png: every breed as clay, as skin and in its coat
	$(CARGO) run --release --locked -- sheet --breeds all --views portrait --dress clay,skin,coat --fit --columns 4 --size 1320x1860 -o docs/gallery.png

atlas: ## redraw docs/atlas_*.png: every measure low, middle and high
	$(CARGO) run --release --locked -- atlas --split -o docs/atlas.png

fmt-check: ## is everything formatted?
	$(CARGO) fmt --check

lint: ## clippy, warnings denied
	$(CARGO) clippy --locked --all-targets --features ui-tests -- -D warnings

doc: ## the documentation, private items included, warnings denied
	RUSTDOCFLAGS=-Dwarnings $(CARGO) doc --locked --no-deps --document-private-items
