"""A small surveyed garage: two rows beside a lane from an entrance to an exit, one row for charging."""

from garage2usd.config import GarageConfig
from garage2usd.layout.surveyed import lay_out_survey
from garage2usd.survey.clear_ground import with_medial_lanes
from garage2usd.survey.reader import read_survey
from garage2usd.survey.survey import aligned

SURVEY = """
outline = [[0, 0], [40, 0], [40, 18.2], [0, 18.2]]
lanes = [{points = [[0, 8.8], [40, 8.8]], width_m = 6}]
portals = [{at = [0, 8.8], kind = "entrance"}, {at = [40, 8.8], kind = "exit"}]

[[runs]]
first = [6, 5.8]
last = [33.5, 5.8]
side = "left"
count = 11
length_m = 5.3
number = 1
use = "ev"

[[runs]]
first = [6, 11.8]
last = [33.5, 11.8]
side = "right"
count = 11
length_m = 5.3
number = 12
"""


def surveyed(folder, **settings):
    """Lay out the survey."""
    path = folder / "lot.toml"
    path.write_text(SURVEY)
    survey, _ = aligned(with_medial_lanes(read_survey(path)))
    return lay_out_survey(survey, GarageConfig(**settings))
