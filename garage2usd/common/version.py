"""The version that is written into every stage and report."""

from importlib.metadata import version

__all__ = ["VERSION"]

VERSION = version("garage2usd")
