"""Campaigns: many runs of a scenario, on the cores of this machine or on a cluster.

>>> from precess import campaign
>>> plan = campaign.latin_hypercube("plan.toml", samples=1000)
>>> found = campaign.run("bus.toml", plan, "out", client="tcp://scheduler:8786")
>>> found.to_pandas()

Rows do not depend on how many workers helped, on which of them died, nor on how often a campaign was ended and continued:
the files have the same bytes.
"""

from .job import VersionError
from .plan import Plan, grid, latin_hypercube, listed, monte_carlo, sobol
from .run import Campaign, run

__all__ = [
    "Campaign",
    "Plan",
    "VersionError",
    "grid",
    "latin_hypercube",
    "listed",
    "monte_carlo",
    "run",
    "sobol",
]
