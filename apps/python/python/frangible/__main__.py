"""The command line: ``frangible break bunny.obj``, ``frangible dataset …``. This one has no window."""

import signal
import sys

from ._frangible import run


def main() -> int:
    """Does what the words of the command line say."""
    if sys.argv[1:2] == ["dataset"]:
        from .dataset import main as dataset

        return dataset(sys.argv[2:])
    # Ctrl-C ends the program at once, as it does any other.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["frangible", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
