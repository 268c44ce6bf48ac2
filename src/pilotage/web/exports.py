"""Write what a person wants to keep of a drive: its journal, a film, a picture."""

from pathlib import Path

from pilotage.drives import Drive


def write_export(kind: str, drive: Drive, path: Path, title: str) -> None:
    """Write a journal, a film or a picture."""
    if kind == "journal":
        from pilotage.io.journal import journal_file

        with journal_file(path, drive.sketch) as write:
            for step, scene in zip(drive.steps, drive.scenes, strict=True):
                write(step, scene)
    elif kind == "film":
        from pilotage.figures.animation import animate

        animate(drive, path)
    else:
        from pilotage.figures.drive import drive_figure
        from pilotage.figures.style import save

        save(drive_figure(drive, title), path)
