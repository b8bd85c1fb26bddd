"""Kills and interrupts at random times: the same command with --resume, as often as need be, ends in the same bits as the
run that was left alone, with the same series, and leaves nothing behind."""
import json
import os
import shutil
import signal
import subprocess
import time

from tools import bounded, content, leftovers, run

# Clocks that run ahead bring a checkpoint, due after a minute, every few milliseconds.
FAST_CLOCK = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <time.h>
static int (*real)(clockid_t, struct timespec*);
int clock_gettime(clockid_t id, struct timespec* t) {
  if (!real) real = (int (*)(clockid_t, struct timespec*))dlsym(RTLD_NEXT, "clock_gettime");
  int code = real(id, t);
  if (id == CLOCK_MONOTONIC) {
    __int128 ns = ((__int128)t->tv_sec * 1000000000 + t->tv_nsec) * 10000;
    t->tv_sec = (time_t)((ns / 1000000000) % 4000000000000ll), t->tv_nsec = (long)(ns % 1000000000);
  }
  return code;
}
"""

SCENES = {
    "newton": ("disks-method1", ["grains.count=250", "finish.method=\"newton\"", "output.series_interval=0.5"]),
    "path": ("disks-load-path", ["grains.count=60", "output.series_interval=1.0", "output.stages=true"]),
    "aggregates": ("disks-method2-a", ["grains.count=100", "output.series_interval=2.0",
                                       "output.snapshot_times=[5.0, 20.0, 60.0]"]),
    "triangles": ("triangles-settle", ["grains.count=40", "container.width=1.8", "output.series_interval=0.05",
                                       "stage.0.until=\"time\"", "stage.0.time=1.0"]),
    "spheres": ("spheres-method1", ["grains.count=400", "output.series_interval=0.5", "stage.0.until=\"time\"",
                                    "stage.0.time=20.0"]),
}


def fast_clock(folder):
    source, library = os.path.join(folder, "clock.c"), os.path.join(folder, "clock.so")
    with open(source, "w") as file:
        file.write(FAST_CLOCK)
    done = subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, source, "-ldl"], capture_output=True)
    return library if done.returncode == 0 else None


def command_of(program, data, name):
    scene, settings = SCENES[name]
    command = [program, "pack", os.path.join(data, "scenes", scene + ".toml"), "-o", "x.h5", "--set",
               'output.series="x.csv"']
    for s in settings:
        command += ["--set", s]
    return command


def hash_of(program, path):
    return json.loads(subprocess.run([program, "info", path], capture_output=True).stdout or b"{}").get("hash")


def files_of(program, folder):
    return {name: hash_of(program, os.path.join(folder, name)) if name.endswith(".h5") else content(os.path.join(folder, name))
            for name in sorted(os.listdir(folder))}


def torture(program, data, folder, random, faults, count, until, names=None):
    clock = fast_clock(folder)
    straight = {}
    done = 0
    while done < count and not until():
        name = random.choice(names or list(SCENES))
        command = command_of(program, data, name)
        place = os.path.join(folder, "run")
        shutil.rmtree(place, ignore_errors=True)
        os.makedirs(place)
        if name not in straight:
            start = time.monotonic()
            result = run(command, place, seconds=300)
            straight[name] = (result.code, files_of(program, place), time.monotonic() - start)
            if result.code not in (0, 3):
                faults.add("kill", command, f"{name}: exit {result.code} when left alone: {result.err[-300:]}")
                return
            shutil.rmtree(place)
            os.makedirs(place)
        code, expected, seconds = straight[name]
        env = dict(os.environ, LD_PRELOAD=clock) if clock and random.random() < 0.7 else None
        told, got = "", None
        for attempt in range(60):
            resume = ["--resume"] if attempt else []
            process = subprocess.Popen(command + resume, cwd=place, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.PIPE, env=env, preexec_fn=bounded(), start_new_session=True)
            which = random.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
            try:
                process.wait(timeout=random.random() * 0.8 * seconds if done < count and attempt < 50 else 3000)
            except subprocess.TimeoutExpired:
                process.send_signal(which)
                done += 1
                faults.did("kills and interrupts")
                try:
                    process.wait(timeout=300)
                except subprocess.TimeoutExpired:
                    told = f"outlives signal {which}"
                    os.killpg(process.pid, signal.SIGKILL)
            got = process.wait()
            err = process.stderr.read().decode("utf-8", "replace")
            process.stderr.close()
            if got in (-signal.SIGKILL, 130) and not told:
                continue
            if got == -which and not told:
                faults.did("signals before the handlers were there")
                continue
            break
        if not told and got != code:
            told = f"exit {got} after {attempt} resumptions, straight {code}: {err[-300:]}"
        found = files_of(program, place)
        if not told and found != expected:
            differing = [k for k in sorted(set(found) | set(expected)) if found.get(k) != expected.get(k)]
            told = f"other files than of the straight run: {differing}"
        if told:
            faults.add("kill", command, f"{name}: {told}", [os.path.join(place, f) for f in os.listdir(place)])
        faults.did("killed runs")
    # A study: what is there stays, what is missing is run.
    place = os.path.join(folder, "study")
    shutil.rmtree(place, ignore_errors=True)
    os.makedirs(place)
    with open(os.path.join(place, "s.toml"), "w") as file:
        file.write(f'scene = "{data}/scenes/disks-method2-a.toml"\nseeds = 3\nanalyze = ["counts", "rigidity"]\n[set]\n'
                   '"grains.count" = 20\n[[row]]\nname = "a"\n')
    command = [program, "study", "s.toml", "-j", "2"]
    alone = run(command + ["-o", "straight"], place, seconds=300)
    if alone.code not in (0, 3):
        faults.add("kill", command, f"a study left alone: exit {alone.code}: {alone.err[-300:]}")
        return
    for k in range(200):
        process = subprocess.Popen(command + ["-o", "cut"], cwd=place, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, start_new_session=True)
        try:
            process.wait(timeout=0.1 + 2 * random.random() if k < 12 and not until() else 3000)
            break
        except subprocess.TimeoutExpired:
            which = random.choice([signal.SIGKILL, signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
            process.send_signal(which)
            faults.did("kills and interrupts")
            process.wait()
            time.sleep(0.3)  # the runs of a killed study notice that it is gone
    same = content(os.path.join(place, "straight/study.csv")) == content(os.path.join(place, "cut/study.csv"))
    if process.returncode not in (0, 3) or not same or leftovers(os.path.join(place, "cut")):
        faults.add("kill", command, f"a killed study: exit {process.returncode}, same table {same}")
    faults.did("killed studies")
