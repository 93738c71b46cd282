"""Who computes the parts of a study: this machine, or a cluster of Dask."""

import os
import threading
from collections.abc import Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from itertools import islice
from typing import Any, Callable, Optional

from ._errors import ComputationError

#: Parts that wait for each thread of a cluster: enough that none is idle, few enough that the scheduler holds little.
WAITING = 3
#: How often a part is given to workers that die with it.
ATTEMPTS = 5


class _Stopped(Exception):
    """Ends the other parts where one has failed, or somebody has pressed Ctrl-C."""


def on_this_machine(
    compute: Callable[..., bool], out: str, parts: Sequence[int], threads: Optional[int], tell: Callable[[int], None]
) -> None:
    """Computes the parts in so many threads, each of which computes one part after the other."""
    if not parts:
        return
    threads = threads or _cores()
    workers = min(threads, len(parts))
    stopped = threading.Event()

    def go_on(_: float) -> None:
        if stopped.is_set():
            raise _Stopped

    with ThreadPoolExecutor(workers) as pool:
        todo = iter(parts)
        running = {pool.submit(compute, out, part, threads // workers, go_on) for part in islice(todo, workers)}
        done = 0
        try:
            while running:
                # Python heeds Ctrl-C between two waits.
                finished, running = wait(running, timeout=0.2, return_when=FIRST_COMPLETED)
                for future in finished:
                    future.result()
                    done += 1
                    tell(done)
                    running |= {pool.submit(compute, out, part, threads // workers, go_on) for part in islice(todo, 1)}
        finally:
            stopped.set()


def _cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def on_dask(client: Any, compute: Callable[..., bool], out: str, parts: Sequence[int], tell: Callable[[int], None]) -> None:
    """Computes the parts on the workers of a Dask client, a few at a time. A worker that dies loses what it had not finished."""
    from distributed import as_completed

    todo = iter(parts)
    attempts: dict = {}

    def submit(part: int) -> Any:
        attempts[part] = attempts.get(part, 0) + 1
        return client.submit(compute, out, part, key=f"creepage-{os.path.basename(out)}-{part}-{attempts[part]}", pure=False)

    width = WAITING * max(1, sum(client.nthreads().values()))
    part_of = {}
    for part in islice(todo, width):
        part_of[submit(part)] = part
    running = as_completed(list(part_of), loop=client.loop)
    done = 0
    for future in running:
        part = part_of.pop(future)
        if future.status in ("cancelled", "lost"):
            raise ComputationError("the cluster is lost; the same call goes on with what is missing")
        if future.status == "error":
            error = future.exception()
            if type(error).__name__ != "KilledWorker" or attempts[part] >= ATTEMPTS:
                raise error
            again = [part]
        else:
            done += 1
            tell(done)
            attempts.pop(part)
            again = list(islice(todo, 1))
        future.release()
        for part in again:
            future = submit(part)
            part_of[future] = part
            running.add(future)
