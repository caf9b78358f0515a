"""A folder that others may write to: another user replaces every temporary file by a link to a private file.

Expected: the private file keeps its bytes, permissions and owner. The command fails or succeeds, and every output is the old
file, the new file, or what the other user put there.
With root the other user has no rights, and the program runs as root, then as a second user.
"""

import os
import shutil
import signal
import stat

from _writing import commands
from common import WORK, Tally, digest, finish, for_all, run, tries, write

OTHER, VICTIM = 54321, 54322
"""Numbers of two users who own nothing."""


def as_user(number):
    """What a child does to become a user, nothing without root."""

    def become():
        os.setgid(number)
        os.setuid(number)

    return become if number and os.geteuid() == 0 else None


def exchange(folder, private):
    """What the other one does, as often as it can, until it is killed."""
    link = os.path.join(folder, ".link")
    while True:
        for name in os.listdir(folder):
            place = os.path.join(folder, name)
            temporary = name.startswith(".") and name.endswith((".part", ".lock")) or name.endswith((".h5.part", ".journal"))
            try:
                if temporary and not os.path.islink(place):
                    os.symlink(private, link)
                    os.rename(link, place)
            except OSError:
                pass


def started(folder, private):
    """The other one at work: the number of its process."""
    child = os.fork()
    if child == 0:
        try:
            (as_user(OTHER) or (lambda: None))()
            exchange(folder, private)
        finally:
            os._exit(1)
    return child


def attack(name, folder, writing, victim):
    tally = Tally(f"{name}, run by {victim or 'this user'}")
    private_folder = os.path.join(WORK, f"private.{victim}")
    shutil.rmtree(private_folder, ignore_errors=True)
    os.makedirs(private_folder)
    private = os.path.join(private_folder, "private")
    for _ in range(tries(4)):
        writing.setup()
        for output in writing.outputs:
            if "--force" in writing.arguments:
                os.chmod(output, 0o666)
        for entry in [folder, *(os.path.join(base, file) for base, folders, files in os.walk(folder) for file in folders + files)]:
            os.chmod(entry, 0o777 if os.path.isdir(entry) else 0o666)
        write(private, "private " * 40)
        os.chmod(private, 0o600)
        if os.geteuid() == 0:
            os.chown(private_folder, victim or 0, victim or 0)
            os.chown(private, victim or 0, victim or 0)
        before = (digest(private), os.stat(private).st_mode, os.stat(private).st_uid)
        other = started(folder, private)
        try:
            ended = run(writing.arguments, limits=as_user(victim))
        finally:
            os.kill(other, signal.SIGKILL)
            os.waitpid(other, 0)
        tally.ended(ended, {0, 1, 2, 75})
        after = (digest(private), os.stat(private).st_mode, os.stat(private).st_uid)
        if after != before:
            what = [word for word, was, now in zip(("bytes", "permissions", "owner"), before, after) if was != now]
            tally.fail(f"private file: other {', '.join(what)}", stat.filemode(after[1]))
        for output in writing.outputs:
            if ended.code == 0 and os.path.islink(output):
                tally.fail("done, but the output is a link")
    tally.show()
    return tally


if __name__ == "__main__":
    folder, writings = commands("shared")
    for_all()
    victims = [0, VICTIM] if os.geteuid() == 0 else [0]
    names = ["tabulate --force", "sweep --force", "impact --force", "plot"]
    finish([attack(name, folder, writings[name], victim) for victim in victims for name in names])
