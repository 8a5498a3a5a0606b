"""A Slurm cluster of two nodes on this machine, in a folder of its own: munge, slurmctld and two slurmd."""

import contextlib
import os
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

CONFIGURATION = """ClusterName=koebe
SlurmctldHost={host}
SlurmctldPort={port}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1
JobRequeue=1
ReturnToService=2
SlurmctldTimeout=10
SlurmdTimeout=10
KillWait=2
MailProg=/bin/true
SlurmdParameters=config_overrides
NodeName=n[1-2] NodeHostname={host} NodeAddr=127.0.0.1 Port=[{first}-{second}] CPUs=1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def children_of(process):
    """All processes below one."""
    found = subprocess.run(["pgrep", "-P", str(process)], capture_output=True, text=True).stdout.split()
    return [one for child in map(int, found) for one in (child, *children_of(child))]


class Cluster:
    """Started in a context, and gone after it."""

    def __init__(self, folder):
        self.folder = Path(folder)
        port = 20000 + os.getpid() % 10000
        host = socket.gethostname().split(".")[0]
        for name in ("state", "spool-n1", "spool-n2"):
            (self.folder / name).mkdir(parents=True)
        self.conf = self.folder / "slurm.conf"
        self.conf.write_text(
            CONFIGURATION.format(folder=self.folder, host=host, port=port, first=port + 1, second=port + 2)
        )
        self.environment = {**os.environ, "SLURM_CONF": str(self.conf)}
        self.processes = {}

    def __enter__(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        self.folder.chmod(0o711)
        munge = [f"--key-file={key}", f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munge.pid"]
        more = [f"--log-file={self.folder}/munge.log", f"--seed-file={self.folder}/munge.seed"]
        self.start("munge", "munged", "--foreground", "--force", *munge, *more)
        self.start("control", "slurmctld", "-D", "-c", "-f", self.conf)
        for node in ("n1", "n2"):
            self.start(node, "slurmd", "-D", "-N", node, "-f", self.conf)
        try:
            self.wait_for(lambda: self.run("sinfo", "-h", "-N", "-o", "%t").split() == ["idle", "idle"], 60)
        except BaseException:
            self.__exit__()
            raise
        return self

    def start(self, name, program, *words):
        path = shutil.which(program, path=f"{os.environ['PATH']}:/usr/sbin")
        with open(self.folder / f"{name}.out", "wb") as log:
            self.processes[name] = subprocess.Popen(
                [path, *map(str, words)], env=self.environment, stdout=log, stderr=log, stdin=subprocess.DEVNULL
            )

    def run(self, *words):
        done = subprocess.run(list(map(str, words)), env=self.environment, capture_output=True, text=True, timeout=60)
        if done.returncode:
            raise RuntimeError(f"{words}: {done.stderr}")
        return done.stdout

    def wait_for(self, condition, seconds):
        end = time.monotonic() + seconds
        while True:
            with contextlib.suppress(RuntimeError):
                if condition():
                    return
            for name, process in self.processes.items():
                if process.poll() is not None:
                    raise AssertionError(f"{name} ended:\n{self.logs()}")
            assert time.monotonic() < end, self.logs()
            time.sleep(0.2)

    def logs(self):
        return "\n".join(f"--- {path.name}\n{path.read_text(errors='replace')[-3000:]}"
                         for path in sorted(self.folder.glob("*.*")) if path.suffix in (".log", ".out"))  # fmt: skip

    def lose(self, node):
        """A node without power: its daemon and all that it started are gone at once."""
        daemon = self.processes.pop(node)
        spool = str(self.folder / f"spool-{node}")
        victims = [daemon.pid, *children_of(daemon.pid)]
        for line in subprocess.run(["pgrep", "-f", "slurmstepd"], capture_output=True, text=True).stdout.split():
            with contextlib.suppress(OSError):
                if spool in Path(f"/proc/{line}/environ").read_text(errors="replace") or self.is_of(int(line), node):
                    victims += [int(line), *children_of(int(line))]
        for victim in victims:
            with contextlib.suppress(ProcessLookupError):
                os.kill(victim, signal.SIGKILL)
        daemon.wait()

    def is_of(self, step, node):
        """Whether a step's processes run on the node, as they are told by their environment."""
        for child in children_of(step):
            with contextlib.suppress(OSError):
                text = Path(f"/proc/{child}/environ").read_bytes()
                if f"SLURMD_NODENAME={node}".encode() in text and str(self.conf).encode() in text:
                    return True
        return False

    def __exit__(self, *error):
        for name in ("n1", "n2"):
            if name in self.processes:
                self.lose(name)
        for process in self.processes.values():
            process.terminate()
        for process in self.processes.values():
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        self.processes.clear()
