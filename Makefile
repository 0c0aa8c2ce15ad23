# Two commands for a fresh Debian or Ubuntu with Python 3.11 to 3.14: `make demo` and `make test`.
.PHONY: demo test

demo:
	@./environment.sh demo
	@.venv/bin/garage2usd build samples/irregular.toml --output out/garage.usdz
	@echo "Open out/garage.usdz in Blender (File > Import > Universal Scene Description); out/garage_plan.png is its plan."

# where Python is told to keep no compiled files, each command that a test starts would compile all it imports
test: export PYTHONDONTWRITEBYTECODE =
test:
	@./environment.sh test
	@.venv/bin/ruff check --quiet .
	@.venv/bin/ruff format --quiet --check .
	@.venv/bin/mypy
	@.venv/bin/lint-imports
	@.venv/bin/python -m pytest -n auto --dist worksteal
