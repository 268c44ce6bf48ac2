"""The command line: one module a command."""

import os
import sys

from pilotage.errors import PilotageError


def main() -> None:
    """Run the command line; what goes wrong with a user's files is one line and exit code 1."""
    from pilotage.cli.app import app

    try:
        app()
    except PilotageError as error:
        line = " ".join(str(error).split())
        sys.stderr.write(f"pilotage: error: {line}\n")
        raise SystemExit(1) from None
    except BrokenPipeError:  # the reader of our output has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise SystemExit(1) from None
