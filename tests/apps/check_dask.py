"""The jobs of `tilth compare` on a Dask cluster of two workers, one of them killed in the middle: every job is done all
the same, each once.

check_dask.py TILTH
"""

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent.parent / "support"))
from needs import needs  # noqa: E402

needs("dask", "distributed")
from distributed import Client, LocalCluster  # noqa: E402

SOURCE = "sim://corridor?columns=400&duration=1.6"


def kill_worker_after_first_job(client, runs, killed):
    """Kills a worker process as soon as a job is done."""
    processes = list(client.run(os.getpid).values())
    while not list(runs.glob("*/*/done.json")):
        time.sleep(0.02)
    os.kill(processes[0], signal.SIGKILL)
    killed.append(processes[0])


def main():
    tilth = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder, LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster, Client(cluster) as client:
        out, killed = Path(folder) / "out", []
        killer = threading.Thread(target=kill_worker_after_first_job, args=(client, out / "runs", killed))
        killer.start()
        command = [tilth, "compare", "--source", SOURCE, "--seeds", "1-6", "--align", "origin", "--pipelines", "tilth", "--out", str(out)]
        command += ["--engine", "dask", "--scheduler", cluster.scheduler_address, "--python", sys.executable]
        ended = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
        killer.join(timeout=10)
        assert ended.returncode == 0, ended.stdout + ended.stderr
        assert len(killed) == 1, "no worker was killed"
        summary = json.loads((out / "comparison.json").read_text())["summary"]["rows"][0]
        assert summary["runs"] == 6 and summary["failed"] == 0, summary
        assert not list(out.glob("recordings/*/scans")), "scans were left behind"
    print("6 jobs done by two workers, one of them killed")


if __name__ == "__main__":
    main()
