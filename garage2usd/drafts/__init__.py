"""Garages drawn in the browser: a configuration or survey as a document with undo, its plan, and the server."""
