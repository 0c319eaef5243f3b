"""On a terminal the progress of a run fits its width, also when that changes.
Usage: progress.py DECK OUT"""
import fcntl
import os
import pty
import re
import signal
import struct
import subprocess
import sys
import termios


below = set()  # the beginnings of all lines


def set_width(terminal, columns):
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))


def lines_on_terminal(command, widths, each, is_enough):
    """What stands on the line that is written over, `each` times for every width, and on until that is enough."""
    ours, theirs = pty.openpty()
    set_width(ours, widths[0])
    with subprocess.Popen(command, stderr=theirs, stdout=subprocess.DEVNULL) as process:
        os.close(theirs)
        text, seen = "", []
        while len(seen) < each * len(widths) or not is_enough(seen):
            text += os.read(ours, 4096).decode()
            *whole, text = text.split("\r\x1b[K")
            for line in (each.rstrip("\r\n") for each in whole):
                below.add(re.sub(r"[\d.]+ (s|min|h) to go|\x1b\[A", "", line).strip()[:15])
                if re.match(r" *\d+ %", line):
                    seen.append((widths[min(len(seen) // each, len(widths) - 1)], line))
                    set_width(ours, widths[min(len(seen) // each, len(widths) - 1)])
        process.send_signal(signal.SIGTERM)
        while True:
            try:
                if not os.read(ours, 4096):
                    break
            except OSError:  # the other end is closed
                break
    assert process.returncode == 5, process.returncode
    return seen


deck, out = sys.argv[1:]
run = ["beadwork", "run", deck, "--out", out, "--overwrite", "--threads", "1"]
wide = re.compile(r" +\d+ % \[#*\.+\] (\d.* to go  )?stage 'run', step \d+, time .* s, 0 breaks, largest utilisation 0$")
# Some lines may have been measured before the terminal became wider: one that is wide is waited for.
seen = lines_on_terminal(run, [30, 160], 3, lambda seen: wide.match(seen[-1][1]))
assert all(len(line) < width for width, line in seen), seen
narrow = [line for width, line in seen if width == 30]
assert not any("[" in line for line in narrow), narrow

# A batch: how far its runs have come before one has ended, and how long all will take.
batch = ["beadwork", "batch", deck, "--out", out + "-batch", "--threads", "1", "--vary", "end=300000000,300000001", "--jobs", "2"]
ahead = re.compile(r" *\d+ % \[#*\.*\] \d.* to go  batch")


def share(line):
    return int(line.split("%")[0])


def has_headway(seen):
    return ahead.match(seen[-1][1]) and share(seen[-1][1]) > share(seen[0][1])


seen = [line for _, line in lines_on_terminal(batch, [160], 20, has_headway)]
assert all(line.endswith("batch, 0 of 2 runs done, 2 at work") for line in seen), seen
shares = [share(line) for line in seen]
assert shares == sorted(shares), seen
# Each run has a line of its own below.
assert {"end=300000000 ", "end=300000001 "} <= {each[:14] for each in below}, below
