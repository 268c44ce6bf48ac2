"""Doors that are drawn as a line upon a patch in the color of the ground."""

import pytest

from flats import BLACK, OUTSIDE, RED, ROOMS, WHITE, are_joined, box, graph_of, stroke
from pilotage.interpretation import Pen, Role, Sheet, interpret

BOXES = tuple(box(*sides, pen=Pen(BLACK, 1.0)) for sides in ((0, 0, 48, 80), (50, 0, 100, 80)))


def patched(start, end, *, wide=8.0, thin=0.7, color=BLACK):
    """A patch, and a line upon it."""
    return stroke(start, end, color=WHITE, width=wide), stroke(start, end, color=color, width=thin)


def have_doors(marks):
    """Tell whether a door leads into each of the two rooms; a doorway may be a place of its own."""
    graph = graph_of(marks)
    return all(graph.gateways_of(cell.cell_id) for cell in graph.cells if cell.label in ROOMS)


@pytest.mark.parametrize("wide", [1.5, 8.0])
def test_a_patch_from_box_to_box_is_a_doorway_however_narrow_it_is(wide):
    marks = (*BOXES, *patched((48, 30), (50, 30), wide=wide))

    assert have_doors(marks)
    assert not have_doors((*BOXES, marks[-1]))
    assert Role.DOOR is interpret(Sheet(marks)).meanings[-1].role


@pytest.mark.parametrize(("ends", "wide"), [(((10, 20), (16, 20)), 8.0), (((48, 30), (50, 30)), 1.0)])
def test_a_line_that_leads_nowhere_or_has_but_a_light_edge_is_no_doorway(ends, wide):
    assert not have_doors((*BOXES, *patched(*ends, wide=wide)))


@pytest.mark.parametrize("color", [BLACK, RED])
def test_a_single_line_upon_a_patch_in_a_wall_is_a_door(color):
    door = patched((50, 30), (50, 40), color=color)

    assert are_joined((OUTSIDE, stroke((50, 0), (50, 80)), *door))
    assert not are_joined((OUTSIDE, stroke((50, 0), (50, 80)), door[1]))


def test_lines_upon_patches_in_outer_walls_are_windows():
    windows = patched((10, 0), (20, 0)) + patched((0, 30), (0, 40))
    found = interpret(Sheet((OUTSIDE, stroke((50, 0), (50, 80)), *windows)))

    assert not found.sketch.doors


@pytest.mark.parametrize(("name", "doors"), [("opening", 1), ("sign", 0)])
def test_a_patch_that_is_named_an_opening_opens_the_wall_of_the_next_room_too(name, doors):
    rooms = [
        box(left + x, bottom, left + x + width, bottom + height, fill=BLACK)
        for left in (0, 50)
        for x, bottom, width, height in ((0, 0, 50, 1), (0, 79, 50, 1), (0, 0, 1, 80), (49, 0, 1, 80))
    ]
    patch = box(49, 30, 50, 42, fill=WHITE, names=(name,))

    assert doors == len(graph_of((*rooms, patch)).gateways)
