"""Settings from TOML: what is not known or cannot be meant is refused by name."""

import dataclasses
import math
import tomllib
from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

import pytest

from pilotage.config import Settings, build, meanings, read_settings, settings_from, settings_text
from pilotage.errors import FileError, SettingsError
from pilotage.geometry import Pose2


class Manner(Enum):
    QUICK = "quick"
    EXACT = "exact"


@dataclass(frozen=True, slots=True)
class Inner:
    width: float = 1.0
    count: int = 3

    def __post_init__(self):
        if not self.width > 0.0:
            raise ValueError(f"width must be > 0, got {self.width}")


@dataclass(frozen=True, slots=True)
class Outer:
    inner: Inner = field(default_factory=Inner)
    loud: bool = False
    name: str = "x"
    manner: Manner = Manner.QUICK
    steps: tuple[float, ...] = (1.0, 2.0)
    pair: tuple[int, int] = (1, 2)
    limit: float | None = None
    mount: Pose2 = field(default_factory=Pose2.identity)


def test_an_empty_file_gives_the_defaults(tmp_path):
    path = tmp_path / "empty.toml"
    path.write_text("")

    assert Settings() == read_settings(path)


def test_every_kind_of_value_is_read():
    tree = {
        "inner": {"width": 2, "count": 5},
        "loud": True,
        "name": "y",
        "manner": "exact",
        "steps": [1, 2.5, 3],
        "pair": [4, 5],
        "limit": 7,
        "mount": {"x": 0.1, "y": 0, "theta": 0.5},
    }
    expected = Outer(
        Inner(2.0, 5), True, "y", Manner.EXACT, (1.0, 2.5, 3.0), (4, 5), 7.0, Pose2(0.1, 0.0, 0.5)
    )

    assert expected == build(Outer, tree, "")


@pytest.mark.parametrize(
    ("tree", "message"),
    [
        ({"iner": {}}, "unknown setting iner, the nearest known one is inner"),
        ({"inner": {"widht": 1}}, "unknown setting inner.widht, the nearest known one is inner.width"),
        ({"inner": 3}, "setting inner must be a table"),
        ({"inner": {"width": "wide"}}, "setting inner.width must be a number, got 'wide'"),
        ({"inner": {"width": True}}, "setting inner.width must be a number, got True"),
        ({"inner": {"count": 1.5}}, "setting inner.count must be a whole number, got 1.5"),
        ({"inner": {"count": True}}, "setting inner.count must be a whole number, got True"),
        ({"inner": {"width": -1}}, "setting inner: width must be > 0, got -1.0"),
        ({"inner": {"width": math.nan}}, "setting inner.width must be finite, got nan"),
        ({"limit": math.inf}, "setting limit must be finite, got inf"),
        ({"steps": [1.0, math.nan]}, r"setting steps\[1\] must be finite, got nan"),
        ({"inner": {"width": 10**400}}, "setting inner.width must be a number of at most 15 digits, got 10"),
        ({"inner": {"count": 16**5000}}, "at most 15 digits, got a number of thousands of digits"),
        ({"loud": 1}, "setting loud must be true or false, got 1"),
        ({"name": 1}, "setting name must be a text, got 1"),
        ({"manner": "slow"}, "setting manner must be one of quick, exact, got 'slow'"),
        ({"manner": []}, "setting manner must be one of quick, exact"),
        ({"steps": 1}, "setting steps must be an array, got 1"),
        ({"steps": [1, "a"]}, r"setting steps\[1\] must be a number"),
        ({"pair": [1]}, "setting pair must hold 2 values, got 1"),
        ({"limit": "none"}, "setting limit must be a number"),
        ({"mount": {"x": 1.0}}, "setting mount: "),
    ],
)
def test_what_cannot_be_meant_is_refused_by_its_full_name(tree, message):
    with pytest.raises(SettingsError, match=message):
        build(Outer, tree, "")


def test_settings_of_a_stage_are_changed_and_no_others():
    settings = settings_from({"simulator": {"laser": {"beams": 361}, "time_step": 1}})

    assert 361 == settings.simulator.laser.beams
    assert 1.0 == settings.simulator.time_step
    assert Settings().simulator.body == settings.simulator.body


@pytest.mark.parametrize(
    ("content", "error", "message"),
    [
        ("a = [", FileError, "must be TOML"),
        ("a = " + "9" * 5000, FileError, "holds a value that cannot be read"),
        ("[localizer]\nstep = 1" + "0" * 400, SettingsError, "setting localizer.step must be a number of at"),
        ("a = " + "[" * 5000, FileError, "must not be nested so deeply"),
        ("[localizer.sensor]\nsigma_hit = nan", SettingsError, "localizer.sensor.sigma_hit must be finite"),
        ("nonsense = 1", SettingsError, "unknown setting nonsense"),
        (
            "[simulator.laser]\nbeams = 1",
            SettingsError,
            "setting simulator.laser: beams must be at least 2",
        ),
    ],
)
def test_a_wrong_file_is_refused_with_its_path(tmp_path, content, error, message):
    path = tmp_path / "settings.toml"
    path.write_text(content)

    with pytest.raises(error, match=message) as caught:
        read_settings(path)

    assert str(caught.value).endswith(str(path))


def test_files_that_cannot_be_read_are_refused(tmp_path):
    (tmp_path / "latin.toml").write_bytes(b"a = '\xff'")

    for name, rule in (("latin.toml", "UTF-8"), ("nowhere.toml", "no such file"), ("", "cannot be opened")):
        with pytest.raises(FileError, match=rule):
            read_settings(tmp_path / name)


def all_settings(kind):
    """Every nested dataclass below a settings class."""
    yield kind
    for one in dataclasses.fields(kind):
        value = getattr(kind(), one.name)
        if dataclasses.is_dataclass(value) and not isinstance(value, Pose2):
            yield from all_settings(type(value))


@pytest.mark.parametrize(
    "settings",
    [
        Settings(),
        settings_from({"simulator": {"laser": {"base_from_laser": {"x": 0.2, "y": 0, "theta": 1}}}}),
    ],
)
def test_settings_that_are_written_out_are_read_back(tmp_path, settings):
    path = tmp_path / "settings.toml"
    path.write_text(settings_text(settings))

    assert settings == read_settings(path)


def test_every_kind_of_value_is_written():
    inner = Outer(Inner(2.0, 5), True, 'a "b"', Manner.EXACT, (1.0, 2.5), (4, 5), 0.5)
    written = tomllib.loads(settings_text(inner, "outer"))["outer"]

    assert inner == build(Outer, written, "")


def test_all_settings_are_frozen():
    assert all(kind.__dataclass_params__.frozen for kind in all_settings(Settings))


def test_each_setting_is_printed_with_its_comment():
    lines = settings_text(Settings()).splitlines()

    assert "time_limit = 900.0  # [s] after which the robot gives up" in lines
    assert all("noqa" not in line for line in lines)


@dataclass(frozen=True, slots=True)
class Commented:
    """Not a comment: x."""

    plain: float = 1.0
    # about nothing
    short: float = 2.0  # [m] short
    long: tuple[float, float] = (  # [s] first,
        1.0,  # then second
        2.0,
    )
    silenced: int = 3  # count  # fmt: skip

    def method(self):
        return self.short  # no setting


def test_meanings_are_the_comments_behind_fields():
    assert meanings(Commented) == {
        "short": "[m] short",
        "long": "[s] first, then second",
        "silenced": "count",
    }


def test_the_reference_of_settings_is_up_to_date():
    page = (Path(__file__).parents[1] / "docs" / "reference" / "settings.md").read_text(encoding="utf-8")

    assert settings_text(Settings()) == page.split("```toml\n")[1].split("```")[0], "run `make reference`"
