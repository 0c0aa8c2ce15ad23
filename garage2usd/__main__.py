"""``python -m garage2usd``."""

from garage2usd.cli import main

if __name__ == "__main__":
    main()
