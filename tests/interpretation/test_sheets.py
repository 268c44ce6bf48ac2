"""Paper, letters, names of layers, and words."""

import time
from dataclasses import replace

import numpy as np
import pytest

from flats import BLACK, WHITE, WITH_GAP, are_joined, box, graph_of, stroke
from pilotage.geometry import Polyline
from pilotage.interpretation import Mark, Pen, Role, Sheet, Text, interpret
from pilotage.interpretation.names import guessed_role
from pilotage.interpretation.words import find_names

NIGHT = (0.1, 0.1, 0.15)


def letter(x, y=40.0, size=2.0):
    """A round letter, turned into an outline."""
    angles = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    ring = np.array((x, y)) + size / 2.0 * np.column_stack([np.cos(angles), np.sin(angles)])
    return Mark((Polyline(ring, closed=True),), None, BLACK)


def meanings(marks, **options):
    return interpret(Sheet(tuple(marks), **options)).meanings


def test_light_lines_on_a_dark_ground_are_walls():
    light = [Mark(mark.outlines, Pen(WHITE, 1.0), mark.fill and WHITE, mark.names) for mark in WITH_GAP]
    paper = box(-5, -5, 105, 85, fill=NIGHT)

    by_background = interpret(Sheet(tuple(light), background=NIGHT))
    by_paper = interpret(Sheet((paper, *light), page=(-5.0, -5.0, 105.0, 85.0)))

    assert by_background.sketch.strokes == by_paper.sketch.strokes
    assert len(light) == len(by_paper.sketch.strokes)
    assert (Role.IGNORE, "the sheet below the drawing") == (
        by_paper.meanings[0].role,
        by_paper.meanings[0].reason,
    )


def test_white_lines_without_any_ground_are_drawn_for_a_dark_one():
    light = [Mark(mark.outlines, Pen(WHITE, 1.0)) for mark in WITH_GAP]

    assert are_joined(light)
    assert are_joined((*WITH_GAP, stroke((0, 40), (100, 40), color=WHITE)))


@pytest.mark.parametrize(("size", "joined"), [(4.0, True), (30.0, False)])
def test_white_lines_are_drawn_for_a_dark_ground_though_small_things_have_a_color(size, joined):
    walls = [replace(mark, pen=Pen(WHITE, 1.0)) for mark in WITH_GAP]
    lamp = box(20, 20, 20 + size, 20 + size, fill=(0.3, 0.3, 0.3))

    found = {cell.label for cell in graph_of((*walls, lamp)).cells} if joined else set()

    assert ({"bath", "hall"} <= found) is joined
    assert (
        Role.WALL in {meaning.role for meaning in interpret(Sheet((*walls, lamp))).meanings[:3]}
    ) is joined


def test_a_colored_rectangle_on_a_part_of_the_page_is_no_paper():
    marks = (box(0, 0, 100, 80, fill=NIGHT), *WITH_GAP)

    assert Role.IGNORE is not meanings(marks, page=(-100.0, -100.0, 200.0, 180.0))[0].role


def test_ink_in_the_color_of_the_ground_is_not_seen():
    hidden = stroke((0, 40), (100, 40), color=(0.98, 0.98, 0.98))

    assert "painted over" == meanings((hidden, *WITH_GAP))[0].reason
    assert are_joined((hidden, *WITH_GAP))


def test_a_room_is_called_by_the_largest_of_its_words():
    texts = (
        Text("Sofa", (25.0, 20.0), 2.0),
        Text("Living", (25.0, 60.0), 3.0),
        Text("hall", (75.0, 40.0), 2.0),
    )

    assert {"living", "hall"} == {cell.cell_id for cell in graph_of(WITH_GAP, texts).cells}


def test_rows_of_small_round_shapes_are_letters_and_one_alone_is_not():
    word = [letter(x) for x in (20.0, 22.5, 25.0, 27.5)]

    assert [Role.LABEL] * 4 == [meaning.role for meaning in meanings((*WITH_GAP, *word))[3:]]
    assert Role.LABEL is not meanings((*WITH_GAP, letter(20.0)))[3].role
    assert len(graph_of(WITH_GAP).cells) == len(graph_of((*WITH_GAP, *word)).cells)


def test_words_of_one_mark_are_letters_across_the_spaces_between_them():
    area = [letter(x) for x in (20.0, 22.5, 26.8, 29.3)]  # as in "16 m²"
    path = Mark(tuple(outline for each in area for outline in each.outlines), fill=BLACK)

    assert [Role.LABEL] == [meaning.role for meaning in meanings((*WITH_GAP, path))[3:]]
    assert Role.LABEL not in {meaning.role for meaning in meanings((*WITH_GAP, *area))[3:]}


def test_letters_in_outlines_tell_a_closed_room_from_a_block():
    inner = box(35, 30, 65, 50, pen=Pen(BLACK, 1.0))
    word = [letter(x, 40.0) for x in (46.0, 48.5, 51.0, 53.5)]
    marks = (
        box(0, 0, 100, 80, pen=Pen(BLACK, 1.0)),
        stroke((50, 0), (50, 12)),
        stroke((50, 20), (50, 30)),
        inner,
    )

    assert len(graph_of(marks, ()).cells) + 1 == len(graph_of((*marks, *word), ()).cells)


def test_programs_call_the_letters_of_a_font_glyphs():
    two = [replace(letter(x), names=("page", f"glyph{k}-7")) for k, x in enumerate((20.0, 22.5))]

    assert [Role.LABEL] * 2 == [meaning.role for meaning in meanings((*WITH_GAP, *two))[3:]]


def test_the_eye_of_an_o_and_the_dot_of_an_i_belong_to_their_letters():
    eyes = [
        Mark((*letter(x).outlines, *box(x - 0.4, 39.6, x + 0.4, 40.4).outlines), fill=BLACK)
        for x in (20.0, 22.5, 25.0)
    ]
    dotted = Mark((*box(26.8, 39, 27.2, 40.5).outlines, *box(26.8, 40.8, 27.2, 41.2).outlines), fill=BLACK)

    assert [Role.LABEL] * 4 == [meaning.role for meaning in meanings((*WITH_GAP, *eyes, dotted))[3:]]


@pytest.mark.parametrize(
    ("name", "role"),
    [
        ("A-WALL-FULL", Role.WALL),
        ("wandInnen", Role.WALL),
        ("Türen 2", Role.DOOR),
        ("porte_int", Role.DOOR),
        ("fenêtres", Role.WINDOW),
        ("ESCALERA", Role.STAIRS),
        ("мебель", Role.FURNITURE),
        ("Bemaßung", Role.IGNORE),
        ("testo", Role.LABEL),
        ("Couch/Benches", Role.FURNITURE),
        ("estanterías", Role.FURNITURE),
        ("Bücherregale", Role.FURNITURE),
        ("Stahltraeger", Role.IGNORE),
        ("Fahrstuhl", Role.STAIRS),  # no chair
        ("A-Beams", Role.IGNORE),
        ("Außenwand", Role.WALL),
        ("seuils", Role.DOOR),
        ("sheet-border", Role.IGNORE),
        ("外墙", Role.WALL),
        ("尺寸标注", Role.IGNORE),
        ("ALVENARIA", Role.WALL),
        ("Drzwi", Role.DOOR),
        ("Kapılar", Role.DOOR),
        ("Okna", Role.WINDOW),
        ("가구", Role.FURNITURE),
        ("通り芯", Role.IGNORE),
        ("Оси", Role.IGNORE),
        ("DOTE", Role.IGNORE),
        ("E-POWR", Role.IGNORE),
        ("E-CRANE", Role.IGNORE),
        ("A-COLS", Role.WALL),
        ("جدران", Role.WALL),
        ("درب", Role.DOOR),
        ("חלונות", Role.WINDOW),
        ("Cửa 1", Role.DOOR),
        ("Έπιπλα", Role.FURNITURE),
        ("WIN_1800", Role.WINDOW),
        ("site|M-DUCT-SUPP", Role.IGNORE),
        ("P-FIXT", Role.FURNITURE),
        ("A-FLOR-FIXT", Role.FURNITURE),
        ("A-FLOR-EQPM", Role.FURNITURE),
    ],
)
def test_names_of_layers_tell_roles_in_many_languages(name, role):
    assert (role, f"its name is {name!r}") == guessed_role([name])


@pytest.mark.parametrize("name", ["Layer 1", "0", "g1234", "wallaby", "", "room-fill room-border"])
def test_names_that_say_nothing_tell_no_role(name):
    assert guessed_role([name]) is None


def test_the_innermost_name_tells_the_role_and_a_hint_wins_over_all():
    assert (Role.FURNITURE, "its name is 'chair'") == guessed_role(["wall", "chair"])
    line = stroke((10, 10), (20, 10), names=("goal", "x7"))
    said = interpret(Sheet((*WITH_GAP, line)), {"x7": Role.IGNORE})
    assert (Role.IGNORE, "you said that 'x7' is ignore") == (
        said.meanings[-1].role,
        said.meanings[-1].reason,
    )
    assert said.sketch.goal is None


def test_rooms_may_be_called_by_what_stands_in_them():
    pen = Pen(BLACK, 1.0)
    bedroom = box(0, 0, 50, 80, pen=pen, names=("mattress bed",))
    kitchen = box(50, 0, 100, 80, pen=pen, names=("oven sink",))
    bed = box(5, 5, 20, 30, pen=pen, names=("bed",))

    assert [one.role for one in meanings([bedroom, kitchen])] == [Role.WALL, Role.WALL]
    assert meanings([*WITH_GAP, bed])[-1].role is Role.FURNITURE


def test_marks_and_texts_named_start_and_goal_are_where_they_stand():
    start = box(10, 10, 14, 14, fill=BLACK, names=("start",))
    goal = Text("X", (80.0, 40.0), 3.0, names=("goal",))

    sketch = interpret(Sheet((*WITH_GAP, start), (goal,))).sketch

    assert ((12.0, 12.0), (80.0, 40.0), ()) == (sketch.start, sketch.goal, sketch.labels)
    assert len(WITH_GAP) == len(sketch.strokes)


@pytest.mark.parametrize("angle", [0.0, 0.7, np.pi / 2.0, np.pi])
def test_lines_of_words_are_joined_along_any_baseline(angle):
    down = 4.0 * np.array([np.sin(angle), -np.cos(angle)])
    lines = [
        Text(word, tuple((k * down).tolist()), 3.0, angle)
        for k, word in enumerate(["Open", "plan", "office", "11.2 m²", "--"])
    ]
    far = Text("Lobby", tuple((30.0 * down).tolist()), 3.0, angle)

    names = find_names(list(enumerate([*lines, far])))

    assert ["Open plan office", "Lobby"] == [name.words for name in names]
    assert (0, 1, 2) == names[0].members
    assert names[0].position == pytest.approx(tuple(down))


def test_thousands_of_words_take_no_time():
    grid = np.stack(np.meshgrid(np.arange(60.0), np.arange(60.0)), axis=-1).reshape(-1, 2)
    texts = [Text(f"Room {k}", tuple(point), 3.0) for k, point in enumerate((30.0 * grid).tolist())]
    start = time.process_time()
    names = find_names(list(enumerate(texts)))

    assert [text.text for text in texts] == [name.words for name in names]
    assert time.process_time() - start < 3.0  # [s]; pair by pair it is minutes


def test_a_title_and_a_small_word_below_it_are_two_names():
    texts = [Text("KITCHEN", (0.0, 0.0), 6.0), Text("tiled", (0.0, -6.0), 3.0)]

    assert ["KITCHEN", "tiled"] == [name.words for name in find_names(list(enumerate(texts)))]


@pytest.mark.parametrize(
    ("lines", "names"),
    [
        (("Reception", "الاستقبال", "रिसेप्शन"), ["Reception", "الاستقبال", "रिसेप्शन"]),
        (("Main", "hall — الممر"), ["Main hall — الممر"]),
        (("会議室", "エー", "B"), ["会議室 エー B"]),
        (("Kitchen", "KITCHEN"), ["Kitchen"]),
    ],
)
def test_a_line_in_another_script_is_a_name_of_its_own(lines, names):
    texts = [Text(line, (0.0, -4.0 * place), 3.0) for place, line in enumerate(lines)]

    assert names == [name.words for name in find_names(list(enumerate(texts)))]


def test_what_is_written_at_a_door_names_no_room_unless_a_person_says_so():
    texts = (
        Text("Hall", (20.0, 20.0), 3.0),
        Text("Front door", (40.0, 5.0), 3.0),
        Text("Red door", (60.0, 30.0), 3.0, names=("label",)),
    )

    labels = interpret(Sheet(WITH_GAP, texts)).sketch.labels

    assert ["Hall", "Red door"] == [label.text for label in labels]


def test_what_is_written_at_a_door_names_no_room_where_all_words_are_called_labels():
    texts = (
        Text("Hall", (20.0, 20.0), 3.0, names=("room-label",)),
        Text("Front door (90 cm)", (40.0, 5.0), 3.0, names=("room-label",)),
    )

    labels = interpret(Sheet(WITH_GAP, texts)).sketch.labels

    assert ["Hall"] == [label.text for label in labels]
