#!/usr/bin/env python3
"""A Slurm on the loopback, in a folder of its own: for tests and benches. Needs slurmctld, slurmd, munged, and root.
Usage: small_slurm.py start FOLDER NODES | stop FOLDER NODES"""
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import time

CONFIGURATION = """ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={port}
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
AuthInfo=socket={folder}/munge.socket
SlurmUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool.%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,sched_interval=1
SlurmdParameters=config_overrides
ReturnToService=2
SlurmdTimeout=10
KillWait=2
MinJobAge=2
MaxArraySize=1001
NodeName=n[1-{nodes}] NodeHostname=localhost NodeAddr=127.0.0.1 Port=[{first}-{last}] CPUs=2
PartitionName=main Nodes=ALL Default=YES MaxTime=60
"""


def missing_parts():
    """Returns the reason why no Slurm can be started here, or ""."""
    missing = [name for name in ("slurmctld", "slurmd", "munged", "sbatch") if not shutil.which(name)]
    if missing:
        return ", ".join(missing) + " is not installed"
    return "" if os.geteuid() == 0 else "needs root"


def free_ports(count):
    """Returns the first of so many neighbouring ports that no program uses now."""
    for _ in range(100):
        first = random.randrange(20000, 32000)
        try:
            for port in range(first, first + count):
                with socket.socket() as probe:
                    probe.bind(("127.0.0.1", port))
            return first
        except OSError:
            pass
    raise RuntimeError("no ports are free")


class Cluster:
    """Slurm in a folder of its own."""

    def __init__(self, folder, nodes):
        self.folder = folder
        self.nodes = nodes
        os.environ["SLURM_CONF"] = self.path("slurm.conf")

    def start(self):
        with open(self.path("slurm.conf"), "w", encoding="ascii") as file:
            port = free_ports(1 + self.nodes)
            file.write(CONFIGURATION.format(folder=self.folder, nodes=self.nodes, port=port, first=port + 1,
                                            last=port + self.nodes))
        for name in ["state"] + [f"spool.n{i + 1}" for i in range(self.nodes)]:
            os.mkdir(self.path(name))
        with open(self.path("munge.key"), "wb", opener=lambda path, flags: os.open(path, flags, 0o600)) as file:
            file.write(os.urandom(1024))
        os.chmod(self.folder, 0o755)
        subprocess.run(["munged", "--key-file=" + self.path("munge.key"), "--socket=" + self.path("munge.socket"),
                        "--pid-file=" + self.path("munged.pid"), "--log-file=" + self.path("munged.log"),
                        "--seed-file=" + self.path("munge.seed"), "--num-threads=4"], check=True)
        self.start_controller()
        for i in range(self.nodes):
            self.start_node(i + 1)
        self.wait_for_nodes()

    def path(self, name):
        return os.path.join(self.folder, name)

    def start_controller(self, *words):
        subprocess.run(["slurmctld", *words], check=True)

    def start_node(self, number):
        subprocess.run(["slurmd", "-N", f"n{number}"], check=True)

    def wait_for_nodes(self):
        for _ in range(600):
            run = subprocess.run(["sinfo", "-h", "-o", "%D %t"], capture_output=True, text=True, check=False)
            if run.stdout.strip() == f"{self.nodes} idle":
                return
            time.sleep(0.1)
        raise RuntimeError("the nodes of Slurm do not come up: " + run.stdout)

    def process(self, name):
        with open(self.path(name + ".pid"), encoding="ascii") as file:
            return int(file.read())

    def kill(self, name):
        os.kill(self.process(name), signal.SIGKILL)
        time.sleep(0.2)

    def stop(self):
        for name in ["slurmctld"] + [f"slurmd.n{i + 1}" for i in range(self.nodes)] + ["munged"]:
            try:
                os.kill(self.process(name), signal.SIGTERM)
            except (OSError, ValueError):
                pass
        time.sleep(2)


if __name__ == "__main__":
    reason = missing_parts()
    if reason:
        print(reason)
        sys.exit(77)
    cluster = Cluster(sys.argv[2], int(sys.argv[3]))
    cluster.start() if sys.argv[1] == "start" else cluster.stop()
