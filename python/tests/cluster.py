"""A small cluster of Dask in processes of their own, which a test may kill."""

import os
import subprocess
import sys
import time
from pathlib import Path

#: A lost scheduler is noticed soon.
ENVIRONMENT = {**os.environ, "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "3s"}
DRIVER = """
import sys, creepage
from distributed import Client
scheduler, scene, ducts, out, per_part = sys.argv[1:]
with Client(scheduler_file=scheduler, timeout=30, set_as_default=False) as client:
    creepage.study(open(scene).read(), ducts, out, ducts_per_part=int(per_part), client=client)
"""


class Cluster:
    """A scheduler and workers of one thread each, with drivers of a study; all die at the end."""

    def __init__(self, folder: Path, workers: int) -> None:
        self.folder = folder
        self.file = folder / f"scheduler-{time.monotonic_ns()}.json"
        self.processes: list = []
        self.scheduler = self._start("-m", "distributed.cli.dask_scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", self.file)
        while not self.file.exists():
            assert self.scheduler.poll() is None, "the scheduler ended"
            time.sleep(0.02)
        self.workers = [self._worker() for _ in range(workers)]

    def _start(self, *arguments) -> subprocess.Popen:
        with open(self.folder / "log.txt", "ab") as log:
            process = subprocess.Popen(
                [sys.executable, *map(str, arguments)], cwd=self.folder, env=ENVIRONMENT, stdout=log, stderr=log
            )
        self.processes.append(process)
        return process

    def _worker(self) -> subprocess.Popen:
        return self._start(
            "-m", "distributed.cli.dask_worker", "--no-nanny", "--no-dashboard", "--nthreads", "1", "--scheduler-file", self.file
        )

    def drive(self, scene: Path, rows: Path, out: Path, per_part: int) -> subprocess.Popen:
        """A process that makes the study."""
        return self._start("-c", DRIVER, self.file, scene, rows, out, per_part)

    def __enter__(self) -> "Cluster":
        return self

    def __exit__(self, *_) -> None:
        for process in self.processes:
            process.kill()
        for process in self.processes:
            process.wait()
