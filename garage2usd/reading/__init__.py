"""Readers of stages and the files beside them: objects, lane graph and labels, shared by all other packages."""
