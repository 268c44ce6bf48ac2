"""Settings of robots that take a fraction of the time, for tests of what does not depend on their number."""

import tomllib

from pilotage.config import settings_from

FEW_AS_TOML = """[localizer]
proposals = 4000
[localizer.tracks]
first_count = 40000
max_count = 8000
min_count = 2000
"""
FEW = settings_from(tomllib.loads(FEW_AS_TOML))
