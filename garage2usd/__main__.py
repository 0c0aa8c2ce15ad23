"""Entry point of ``python -m garage2usd``."""

from garage2usd.cli import run

if __name__ == "__main__":
    run()
