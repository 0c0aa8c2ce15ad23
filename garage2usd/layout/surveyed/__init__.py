"""Layouts of surveyed garages, whose stalls and lanes lie on no grid: shell, floor, lamps and parked cars."""

from garage2usd.layout.surveyed.layout import SurveyedFloor, lay_out_survey

__all__ = ["SurveyedFloor", "lay_out_survey"]
