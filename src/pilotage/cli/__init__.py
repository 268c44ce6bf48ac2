"""The command line: one module a command."""

from typing import NoReturn


def main() -> NoReturn:
    """Run the command line: whatever goes wrong is one line on standard error, and an exit code.

    0: all went well; 1: an input or output will not do; 2: a wrong call; 70: a mistake of ours; 128 and the
    number of a signal: interrupted.
    """
    from pilotage.cli.exits import flush_output, interrupted_by_signals, report
    from pilotage.cli.terminal import secure_streams

    secure_streams()
    try:
        with interrupted_by_signals():
            from pilotage.cli.app import app

            app()
            code = 0
    except BaseException as error:  # noqa: BLE001  # the one place where all errors are told
        code = report(error)
    raise SystemExit(flush_output(code))
