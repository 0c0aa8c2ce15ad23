"""Small stages, one for each rule: file names and texts, the first file the root."""

from support.unity.small_arcs import ARCS
from support.unity.small_chains import CHAINS
from support.unity.small_opinions import OPINIONS
from support.unity.small_scenes import SCENES

SMALL_STAGES = {**ARCS, **CHAINS, **OPINIONS, **SCENES}
