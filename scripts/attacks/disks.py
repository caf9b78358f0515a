"""Full disks of many sizes, limited file sizes and /dev/full: checks the message, the old file and a retry.

Expected: exit code 75 with "no space left" and an unchanged old file; with enough space the same command then writes the same
bytes. The disks are small file systems in memory, which only root can mount; without root only file sizes are limited.
"""

import os
import resource
import shutil
import subprocess

from _writing import commands
from common import PROGRAM, WORK, Tally, digest, finish, kind, last_line, rng, run, tries


def mount(folder, kilobytes, remount=False):
    options = f"size={kilobytes}k" + (",remount" if remount else "")
    quiet = subprocess.DEVNULL
    return subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", folder], stderr=quiet, check=False).returncode == 0


def unmount(folder):
    subprocess.run(["umount", "-l", folder], stderr=subprocess.DEVNULL, check=False)


def judge(tally, ended, writing, old, truth, where):
    now = [digest(path) for path in writing.outputs]
    if ended.code == 0 and now == truth:
        tally.good("had room enough")
        return
    if kind(ended) != "exit 75":
        tally.fail(f"{kind(ended)} instead of 75", f"{where}: {last_line(ended)[-200:]}")
    elif "no space left" not in ended.err:
        tally.fail("no word of space", f"{where}: {last_line(ended)[-200:]}")
    else:
        tally.good("told")
    if any(found not in (was, new) for found, was, new in zip(now, old, truth)):
        tally.fail("half-written", where)


def go_on(tally, writing, truth, before, folder, where):
    again = run(writing.arguments)
    now = [digest(path) for path in writing.outputs]
    if now == truth and again.code in (0, 2):
        tally.good("finished with room")
    else:
        tally.fail("not finished with room", f"{where}: {again.code} {last_line(again)[-200:]}")
    left = set(os.listdir(folder)) - before
    if left:
        tally.fail("litter", f"{where}: {' '.join(sorted(left))}")


def attack(name, folder, writing, count, disks):
    tally, choice = Tally(name), rng(f"disks {name}")
    writing.setup()
    before = set(os.listdir(folder)) | {os.path.basename(path) for path in writing.outputs}
    old = [digest(path) for path in writing.outputs]
    start = os.path.join(WORK, "start")
    shutil.rmtree(start, ignore_errors=True)
    shutil.copytree(folder, start)
    assert run(writing.arguments).code == 0
    truth = [digest(path) for path in writing.outputs]
    largest = max(os.path.getsize(path) for path in writing.outputs)
    for place in range(count):
        size = round(choice.uniform(0.02, 1.2) * largest) + 512
        if disks and place % 2:
            # a disk that has so many bytes left once its inputs are there
            shutil.rmtree(folder)
            os.makedirs(folder)
            used = sum(-(-entry.stat().st_size // 4096) * 4 for entry in os.scandir(start)) + 8
            assert mount(folder, used + size // 1024)
            try:
                shutil.copytree(start, folder, dirs_exist_ok=True)
                where = f"disk with {size} bytes left"
                judge(tally, run(writing.arguments), writing, old, truth, where)
                assert mount(folder, 400_000, remount=True)
                go_on(tally, writing, truth, before, folder, where)
            finally:
                unmount(folder)
        else:
            shutil.rmtree(folder)
            shutil.copytree(start, folder)
            where = f"files of {size} bytes at most"
            limits = lambda size=size: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
            judge(tally, run(writing.arguments, limits=limits), writing, old, truth, where)
            go_on(tally, writing, truth, before, folder, where)
    tally.show()
    return tally


def full_streams():
    """Standard output and standard error that take nothing."""
    tally = Tally("/dev/full")
    quiet = subprocess.DEVNULL
    with open("/dev/full", "w") as full:
        for arguments in (["materials"], ["completions", "bash"], ["impact", os.path.join(WORK, "disks", "i.toml")]):
            code = subprocess.run([PROGRAM, *arguments], stdin=quiet, stdout=full, stderr=quiet, check=False).returncode
            tally.good("told") if code == 75 else tally.fail(f"exit {code}", " ".join(arguments))
            code = subprocess.run([PROGRAM, *arguments], stdin=quiet, stdout=quiet, stderr=full, check=False).returncode
            tally.good("done without standard error") if code == 0 else tally.fail(f"exit {code}", " ".join(arguments))
    tally.show()
    return tally


if __name__ == "__main__":
    folder, writings = commands("disks")
    probe = os.path.join(WORK, "mount")
    os.makedirs(probe, exist_ok=True)
    disks = os.geteuid() == 0 and mount(probe, 100)
    unmount(probe)
    # no file of a shard has one content, and a picture is rewritten from the same file
    names = [name for name in writings if name != "shard"]
    tallies = [attack(name, folder, writings[name], tries(8), disks) for name in names]
    writings["impact"].setup()
    finish([*tallies, full_streams()])
