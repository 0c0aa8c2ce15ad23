"""Garages that are drawn in the browser: their configuration as a document with undo, its plan, and the server."""
