# Verbs over the presets: `make <verb>`.
.PHONY: build test bench format check docs site demo

build: ## the program: build/release/tilth
	cmake --preset release && cmake --build build/release

test: ## everything that scripts/test does
	scripts/test

bench: build ## time and accuracy, as the README's table has them
	scripts/bench --tilth build/release/tilth

format: ## every C++ file
	scripts/format

check: ## what CI refuses without running a test: format and warnings
	scripts/format --check && cmake --preset ci && cmake --build build/ci

docs: build ## docs/options.md, from the program itself, and docs/architecture.md, from the #include lines
	scripts/docs && scripts/architecture

site: ## the documents as a site: build/site
	scripts/site

demo: ## from nothing to a map
	scripts/demo
