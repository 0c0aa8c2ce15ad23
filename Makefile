# Two commands for a fresh Debian or Ubuntu with Python 3.11 to 3.14: `make demo` and `make test`. While one works, `make check`
# runs what a change can affect, `make check BASE=commit` what differs from a commit. `make soak` runs the wide tests, which
# take hours, and `make soak PART=3` an eighth of them.
.PHONY: demo test check soak digests pictures lint wheels

demo:
	@./environment.sh demo
	@.venv/bin/garage2usd build samples/irregular.toml --output out/garage.usdz
	@echo "Walk through it: .venv/bin/garage2usd view out/garage.usdz (its plan is out/garage_plan.png), or open out/garage.usdz"
	@echo "in Blender: File > Import > Universal Scene Description. For the command alone: . .venv/bin/activate"

# where Python is told to keep no compiled files, each command that a test starts would compile all it imports
test check soak: export PYTHONDONTWRITEBYTECODE =
test: lint
	@.venv/bin/python -m pytest -n auto --dist worksteal

check: lint
	@PYTHONPATH=tests .venv/bin/python -m support.affected_tests $(if $(BASE),--base $(BASE))

soak:
	@./environment.sh test
	@.venv/bin/python -m pytest -n auto --dist worksteal --soak $(if $(PART),--part $(PART))

# sixty garages byte by byte as they were; `make digests WRITE=1` writes them anew after a change that is meant
digests:
	@./environment.sh test
	@.venv/bin/python benchmarks/digests.py $(if $(WRITE),--write)

# draws the pictures of README and documentation that are out of date; `make pictures CHECK=1` only names them, and fails if
# there are any, `make pictures NAMES="above.jpg cars.jpg"` draws these
pictures:
	@./environment.sh test
	@.venv/bin/python docs/pictures/draw.py $(if $(CHECK),--check) $(NAMES)

# the wheels of all systems and the source distribution into dist/, checked; `release/release.sh` does it on a clean clone
wheels:
	@[ -x build/release/bin/python ] || python3 -m venv build/release
	@build/release/bin/python -m pip install --quiet --disable-pip-version-check --requirement release/requirements.txt
	@build/release/bin/python release/wheels.py dist

lint:
	@./environment.sh test
	@.venv/bin/ruff check --quiet .
	@.venv/bin/ruff format --quiet --check .
	@.venv/bin/ruff check --quiet --preview --select PLW1514 garage2usd
	@.venv/bin/mypy
	@.venv/bin/lint-imports
