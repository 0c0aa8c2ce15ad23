"""Stages and the files beside them read: their objects, lane graph and labels; whoever reads one does it here."""
