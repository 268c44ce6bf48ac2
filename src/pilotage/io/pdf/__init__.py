"""Read a page of a PDF file: its lines and areas, or its picture if it has nothing else."""

from pilotage.io.pdf.picture import read_picture_page
from pilotage.io.pdf.reader import PicturePageError, read_pdf

__all__ = ["PicturePageError", "read_pdf", "read_picture_page"]
