"""How power cables in underground ducts creep under traffic.

>>> import creepage
>>> run = creepage.run("my-duct.toml", {"traffic.passes": 200})     # doctest: +SKIP
>>> run.downstream_force_n                                          # doctest: +SKIP
"""

from ._creepage import Table, __version__
from ._errors import ComputationError, CreepageError, InputError
from ._run import Run, calibrate, run, sweep
from ._scene import schema
from ._study import Study, compute_part, study

__all__ = [
    "ComputationError",
    "CreepageError",
    "InputError",
    "Run",
    "Study",
    "Table",
    "__version__",
    "calibrate",
    "compute_part",
    "run",
    "schema",
    "study",
    "sweep",
]
