"""Layouts of surveyed garages, whose stalls and lanes lie on no grid: shell, floor, lamps and parked cars."""

from garage2usd.layout.surveyed.layout import SurveyedLayout, lay_out_survey

__all__ = ["SurveyedLayout", "lay_out_survey"]
