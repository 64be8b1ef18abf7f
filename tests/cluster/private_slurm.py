"""A Slurm of this machine alone: its own daemons, keys, ports and folders, and nothing
left of it afterwards."""
import ctypes
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import tempfile
import time

DAEMONS = ("munged", "slurmctld", "slurmd")
TOOLS = ("sbatch", "scontrol", "scancel", "srun")
PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"

CONFIGURATION = """
ClusterName=private
SlurmctldHost={host}
SlurmctldPort={control}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=10
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
MailProg=/bin/true
NodeName={host} CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def why_not():
    """What is missing to start one; empty if nothing is."""
    missing = [name for name in (*DAEMONS, *TOOLS) if not shutil.which(name, path=PATH)]
    if missing:
        return f"no {', '.join(missing)} (sh jobscripts/install_packages.sh --with-slurm)"
    if os.geteuid() != 0:
        return "Slurm's daemons are started as root"
    return ""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def die_with_parent():
    """A daemon does not outlive the test, whatever ends that."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)


class PrivateSlurm:
    def __enter__(self):
        # Short: the path of a socket has 107 characters at most.
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="mpm_slurm_"))
        self.folder.chmod(0o755)
        self.started = []
        self.environment = {**os.environ, "PATH": PATH,
                            "SLURM_CONF": str(self.folder / "slurm.conf")}
        try:
            self._start()
        except BaseException:
            self.__exit__()
            raise
        return self

    def _start(self):
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        (self.folder / "state").mkdir()
        (self.folder / "spool").mkdir()
        control, node = free_ports(2)
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=socket.gethostname(), folder=self.folder, control=control, node=node))
        self._daemon("munged", "--force", "--foreground", f"--key-file={key}",
                     f"--socket={self.folder}/munge.socket", f"--pid-file={self.folder}/munged.pid",
                     f"--seed-file={self.folder}/munged.seed")
        self._daemon("slurmctld", "-D")
        self._daemon("slurmd", "-D")
        self.wait(lambda: self.ask("sinfo", "-h", "-t", "idle", "-o", "%D").strip() == "1",
                  30, "no idle node")

    def _daemon(self, name, *words):
        with open(self.folder / f"{name}.log", "w") as output:
            self.started.append(subprocess.Popen(
                [name, *words], stdout=output, stderr=output, stdin=subprocess.DEVNULL,
                env=self.environment, preexec_fn=die_with_parent))

    def __exit__(self, *_):
        if len(self.started) == len(DAEMONS):
            self.ask("scancel", "--user=root", "--signal=KILL", "--full")
            self.ask("scancel", "--user=root")
            time.sleep(1)
        for daemon in reversed(self.started):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def logs(self):
        return "\n".join(f"== {path.name}\n{path.read_text()[-3000:]}"
                         for path in sorted(self.folder.glob("*.log")))

    def wait(self, holds, seconds, what):
        end = time.monotonic() + seconds
        while not holds():
            if time.monotonic() > end:
                raise AssertionError(f"{what} within {seconds} s\n{self.logs()}")
            time.sleep(0.2)

    def ask(self, *words, folder=None, environment=()):
        return subprocess.run([str(word) for word in words], cwd=folder, text=True, timeout=30,
                              capture_output=True, check=False,
                              env={**self.environment, **dict(environment)}).stdout

    def submit(self, *words, folder, environment=()):
        """The number of the job."""
        said = self.ask("sbatch", *words, folder=folder, environment=environment)
        if not said.startswith("Submitted batch job"):
            raise AssertionError(f"sbatch {words}: {said}\n{self.logs()}")
        return said.split()[-1]

    def job(self, number):
        """What Slurm knows of it, or of each task of an array."""
        return [dict(re.findall(r"(\w+)=(\S*)", text))
                for text in self.ask("scontrol", "-o", "show", "job", number).splitlines()]

    def wait_for_end(self, number, seconds):
        """Its last state, and exit status."""
        def ended():
            return all(job["JobState"] not in ("PENDING", "RUNNING", "COMPLETING", "REQUEUED")
                       for job in self.job(number))
        self.wait(ended, seconds, f"no end of job {number}")
        return self.job(number)
