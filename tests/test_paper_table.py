"""The table of the paper is true: each file that it names exists, and holds the tag beside it."""

import re
from pathlib import Path

import pytest

PAGE = Path(__file__).parents[1] / "docs" / "theory" / "paper.md"
TABLE = [line for line in PAGE.read_text(encoding="utf-8").splitlines() if line.startswith("|")][2:]
TAGGED = re.findall(r"\[[^\]]+\]\(([^)]+\.py)\) `([^`]+)`", "\n".join(TABLE))
LINKS = re.findall(r"\]\(([^)]+)\)", PAGE.read_text(encoding="utf-8"))


@pytest.mark.parametrize(("link", "tag"), TAGGED)
def test_a_file_that_is_named_holds_its_tag(link, tag):
    assert tag in (PAGE.parent / link).read_text(encoding="utf-8")


def test_every_link_leads_somewhere():
    assert [] == [link for link in LINKS if not (PAGE.parent / link).is_file()]


def test_every_row_names_a_file():
    assert [] == [row for row in TABLE if not re.search(r"\.py\) `", row)]


@pytest.mark.parametrize(
    "part",
    ["2.1", "2.2", "eq. (1)", "eq. (2)", "3 ", "3.1", "3.2", "3.3", "3.4", "4.1", "4.2", "5 ", "fig. 3"],
)
def test_every_part_of_the_paper_has_a_row(part):
    assert any(row.startswith(f"| {part}") for row in TABLE)
