"""How long tests wait for what a program does: until it has come. A limit is for what never comes, so it is generous, and it grows
with what others do on the machine."""
import os
import resource
import time

PATIENCE = 120  # seconds until something counts as never happening, on a machine without other work
STEP = 0.005  # seconds between two looks


def seconds_of_children():
    """Of the processor, by all processes of this one that have ended: what others do does not count."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def load():
    """How many want each processor, at least 1."""
    return max(1.0, os.getloadavg()[0] / (os.cpu_count() or 1))


def patience(seconds=PATIENCE):
    """The limit, in seconds from now on, for what takes `seconds` at most without other work."""
    return seconds * load()


def wait_until(condition, seconds=PATIENCE, step=STEP):
    """The value of the condition once it is true; None where it never is."""
    begin = time.monotonic()
    while not (value := condition()):
        if time.monotonic() - begin > patience(seconds):
            return None
        time.sleep(step)
    return value
