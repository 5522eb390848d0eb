#!/usr/bin/env python3
"""Acts as sbatch, squeue and scontrol, by the name that it is called by. FAKE_SLURM is its folder; FAKE_MODE makes
it refuse ("refuse"), run the first task alone ("first"), run tasks twice at once ("twice"), lose all tasks ("lose"), or forget jobs that have ended
("forget")."""
import os
import subprocess
import sys
import time

FOLDER = os.environ["FAKE_SLURM"]
MODE = os.environ.get("FAKE_MODE", "")


def option(name, default=""):
    for word in sys.argv[1:]:
        if word.startswith(f"--{name}="):
            return word.split("=", 1)[1]
    return default


def running(job):
    return not os.path.exists(os.path.join(FOLDER, f"{job}.ended"))


def run_array(job, script):
    """Runs the tasks of an array; this process has been left by its parent."""
    first, last = map(int, option("array", "0-0").split("-"))
    for task in range(first, last + 1):
        if MODE == "lose" or (MODE == "first" and task > first):
            continue
        environment = dict(os.environ, SLURM_ARRAY_TASK_ID=str(task), SLURM_JOB_ID=job)
        log = option("output").replace("%A", job).replace("%a", str(task))
        with open(log, "a", encoding="utf-8") as output:
            tasks = [subprocess.Popen(["sh", script], env=environment, cwd=option("chdir"), stdout=output,
                                      stderr=output) for _ in range(2 if MODE == "twice" else 1)]
            for one in tasks:
                one.wait()
    with open(os.path.join(FOLDER, f"{job}.ended"), "w", encoding="utf-8"):
        pass


def sbatch():
    if MODE == "refuse":
        print("sbatch: error: Batch job submission failed: Invalid account", file=sys.stderr)
        sys.exit(1)
    with open(os.path.join(FOLDER, "calls"), "a", encoding="utf-8") as calls:
        print(*sys.argv[1:], file=calls)
    job = str(100 + sum(1 for _ in open(os.path.join(FOLDER, "calls"), encoding="utf-8")))
    print(job + ";cluster", flush=True)
    if os.fork():
        return
    os.setsid()
    null = os.open(os.devnull, os.O_RDWR)
    for descriptor in range(3):
        os.dup2(null, descriptor)
    before = option("dependency").rpartition(":")[2]
    while before and running(before) and os.path.exists(FOLDER):
        time.sleep(0.05)
    run_array(job, sys.argv[-1])


def squeue():
    job = option("jobs")
    if MODE == "forget" and not running(job):
        print("slurm_load_jobs error: Invalid job id specified", file=sys.stderr)
        sys.exit(1)
    if running(job):
        print("RUNNING")


def scontrol():
    print("MaxArraySize            = " + os.environ.get("FAKE_ARRAY_SIZE", "1001"))


{"sbatch": sbatch, "squeue": squeue, "scontrol": scontrol}[os.path.basename(sys.argv[0])]()
