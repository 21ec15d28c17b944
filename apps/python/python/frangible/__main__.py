"""The command line: ``frangible break bunny.obj``, ``frangible dataset …``. This build has no viewer."""

import signal
import sys

from ._frangible import run


def main() -> int:
    """Runs the command line and returns its exit status."""
    if sys.argv[1:2] == ["dataset"]:
        from .dataset import main as dataset

        return dataset(sys.argv[2:])
    # Ctrl-C ends the program at once.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return run(["frangible", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
