"""Where the repository is."""
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def go_to_root():
    """For tests that give programs paths in the repository: they may be started from any folder. Files among their own
    arguments are those of before."""
    sys.argv[1:] = [os.path.abspath(word) if os.path.exists(word) else word for word in sys.argv[1:]]
    os.chdir(ROOT)
