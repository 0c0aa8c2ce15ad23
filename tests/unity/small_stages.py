"""Small stages, one for each rule: file names and texts, the first file the root."""

from small_arcs import ARCS
from small_opinions import OPINIONS
from small_scenes import SCENES

SMALL_STAGES = {**ARCS, **OPINIONS, **SCENES}
