"""How property tests draw: the same examples in every run, or anew in a campaign."""

import os

from hypothesis import HealthCheck, settings

# Nothing here judges time (a busy machine is no defect), and no failure of an earlier run is tried
# first: a run depends on the tree alone.
_SETTINGS = settings(
    deadline=None,
    database=None,
    suppress_health_check=[
        HealthCheck.too_slow,
        HealthCheck.data_too_large,
        HealthCheck.filter_too_much,
        HealthCheck.large_base_example,
        HealthCheck.function_scoped_fixture,
    ],
)
settings.register_profile("gate", _SETTINGS, derandomize=True)
settings.register_profile("campaign", _SETTINGS, derandomize=False, max_examples=1000)
settings.load_profile(os.environ.get("RAPIDGEN_PROPERTIES", "gate"))
