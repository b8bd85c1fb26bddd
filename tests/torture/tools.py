"""What all tortures share: running the program within bounds, and collecting faults."""
import os
import resource
import signal
import subprocess
import sys

MEMORY = 6 << 30  # [bytes] of address space: no input here needs more
SECONDS = 30      # [s] of CPU for one command; of the clock it has PATIENCE times as many, on a busy machine
PATIENCE = 20


class Faults:
    """Prints each as it comes, with the command and, of inputs, a copy to try again."""

    def __init__(self, keep):
        self.keep, self.count, self.done = keep, 0, {}
        os.makedirs(keep, exist_ok=True)

    def did(self, what, n=1):
        self.done[what] = self.done.get(what, 0) + n

    def add(self, what, command, why, files=()):
        self.count += 1
        kept = []
        for path in files:
            if os.path.isfile(path):
                kept.append(os.path.join(self.keep, f"{self.count}-{os.path.basename(path)}"))
                with open(path, "rb") as source, open(kept[-1], "wb") as copy:
                    copy.write(source.read())
        print(f"FAULT {self.count} ({what}): {why}\n  {' '.join(map(str, command))}\n  {' '.join(kept)}", flush=True)


def bounded(memory=MEMORY, file_size=None, seconds=None):
    def apply():
        if seconds is not None:
            resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 5))
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if file_size is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_size, file_size))
    return apply


class Result:
    def __init__(self, code, out, err):
        self.code, self.out, self.err = code, out, err


def run(command, cwd, seconds=SECONDS, file_size=None, env=None, memory=MEMORY):
    """code: exit code, negative for a signal, None for a command that did not end in time (it is killed)."""
    process = subprocess.Popen(command, cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, preexec_fn=bounded(memory, file_size, seconds), env=env,
                               start_new_session=True)
    try:
        out, err = process.communicate(timeout=PATIENCE * seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, err = process.communicate()
        return Result(None, out, err)
    late = process.returncode in (-signal.SIGXCPU, 128 + signal.SIGXCPU)
    return Result(None if late else process.returncode, out, err)


def ends_badly(result, allowed=(0, 2, 3)):
    """Why a command did not end as it may; empty: it did."""
    text = result.err.decode("utf-8", "replace")
    if result.code is None:
        return "does not end"
    if result.code not in allowed:
        return f"exit {result.code}: {text[-300:].strip()}"
    if result.code == 2 and not text.strip():
        return "exit 2 without a word"
    if "internal error" in text or "not enough memory" in text:
        return text[-300:].strip()
    return ""


def leftovers(folder):
    return [name for name in os.listdir(folder) if ".tmp." in name]


def content(path):
    try:
        with open(path, "rb") as file:
            return file.read()
    except FileNotFoundError:
        return None


def fail(message):
    sys.exit(f"torture: {message}")
