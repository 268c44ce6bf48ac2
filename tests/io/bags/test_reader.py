"""A bag of any kind gives the readings that were recorded, or says in one line why it does not."""

import math
import os
import threading

import numpy as np
import pytest
from benchmarks.lib.bag_making import KINDS, Maker, write_bag
from benchmarks.lib.long_logs import four_formats

from pilotage import FileError, Localizer, LocalizerSettings, open_log, open_map, worlds
from pilotage.io.estimates import estimate_record
from pilotage.maps import build_atlas
from pilotage.ranking.evidence import reduced
from shared_data import DATA, needs_bags

HALF_TURN = math.sqrt(0.5)


def drive(maker, count=6, *, mount=None, with_odometry=True):
    """Scans ten times a second, odometry twice as often."""
    if mount is not None:
        yield "/tf_static", 0.5, maker.transform("base_link", "laser", **mount)
    for k in range(count):
        stamp = 1.0 + 0.1 * k
        if with_odometry:
            yield "/odom", stamp - 0.05, maker.odometry(stamp - 0.05, (0.1 * k - 0.05, 0.0, 0.0))
            yield "/odom", stamp, maker.odometry(stamp, (0.1 * k, 0.0, 0.0))
        yield "/scan", stamp, maker.scan(stamp, np.linspace(1.0, 2.0, 7))


def saved(tmp_path, messages, kind=".mcap"):
    return write_bag(tmp_path / (f"run{kind}" if kind == ".bag" else "run"), messages, kind)


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_bag_gives_scans_and_odometry(tmp_path, kind):
    log = open_log(saved(tmp_path, drive(Maker(kind)), kind))

    assert 6 == len(log)
    assert "no transform leads from base_link to laser" in log.complaint
    for k, reading in enumerate(log):
        assert pytest.approx(1.0 + 0.1 * k) == reading.scan.stamp
        assert pytest.approx(0.1 * k) == reading.odometry.odom_from_base.x
        np.testing.assert_array_equal(np.linspace(1.0, 2.0, 7).round(4), reading.scan.ranges)


@pytest.mark.parametrize("kind", [".db3", ".mcap"])
def test_a_file_without_its_folder_is_read_too(tmp_path, kind):
    folder = saved(tmp_path, drive(Maker(kind)), kind)
    (file,) = folder.glob(f"*{kind}")
    (folder / "metadata.yaml").unlink()

    assert 6 == len(open_log(file)) == len(open_log(folder))


def test_readings_can_be_taken_in_any_stretch(tmp_path):
    readings = open_log(saved(tmp_path, drive(Maker(""), 10))).readings

    stamps = [reading.scan.stamp for reading in readings]
    assert stamps == [readings[k].scan.stamp for k in range(10)]
    assert stamps[3:7] == [reading.scan.stamp for reading in readings[2:8][1:5]]
    assert stamps[-1] == readings[-1].scan.stamp
    assert [] == list(readings[5:5])
    with pytest.raises(IndexError):
        _ = readings[10]


def test_a_turned_mount_moves_the_points(tmp_path):
    mount = {"position": (0.2, 0.1, 0.3), "quaternion": (0.0, 0.0, HALF_TURN, HALF_TURN)}
    scan = open_log(saved(tmp_path, drive(Maker(""), mount=mount))).readings[0].scan

    assert pytest.approx(math.pi / 2) == scan.base_from_laser.theta
    np.testing.assert_allclose([0.2 + 1.0, 0.1], scan.points_in_base[0], atol=1e-6)  # looks right of left


def test_a_laser_that_hangs_upside_down_is_mirrored(tmp_path):
    maker = Maker("")
    scans = open_log(saved(tmp_path, drive(maker, mount={"quaternion": (1.0, 0.0, 0.0, 0.0)}))).readings
    upright = open_log(saved(tmp_path / "upright", drive(maker))).readings[0].scan.points_in_base

    np.testing.assert_allclose(upright * [1.0, -1.0], scans[0].scan.points_in_base, atol=1e-6)


def test_a_tilted_laser_is_refused(tmp_path):
    tilted = {"quaternion": (0.0, math.sin(0.5), 0.0, math.cos(0.5))}

    with pytest.raises(FileError, match="tilted by 57 degrees"):
        open_log(saved(tmp_path, drive(Maker(""), mount=tilted)))


def test_odometry_is_taken_from_transforms_where_no_topic_has_it(tmp_path):
    maker = Maker("")
    messages = [("/tf_static", 0.0, maker.transform("base_link", "laser", position=(0.1, 0.0, 0.0)))]
    for k in range(4):
        at = (0.3 * k, 0.0, 0.0)
        messages.append(
            ("/tf", 1.0 + 0.2 * k, maker.transform("odom", "base_link", 1.0 + 0.2 * k, position=at))
        )
        messages.append(
            ("/tf", 1.0 + 0.2 * k, maker.transform("map", "odom", 1.0 + 0.2 * k, position=(9.0, 9.0, 0.0)))
        )
        messages.append(("/scan", 1.1 + 0.2 * k, maker.scan(1.1 + 0.2 * k, [1.0, 2.0])))
    readings = open_log(saved(tmp_path, messages)).readings

    assert pytest.approx(0.1) == readings[0].scan.base_from_laser.x
    np.testing.assert_allclose([0.15, 0.45, 0.75], [r.odometry.odom_from_base.x for r in readings][:3])


def test_without_odometry_the_log_says_so(tmp_path):
    log = open_log(saved(tmp_path, drive(Maker(""), with_odometry=False)))

    assert "no odometry" in log.complaint
    assert not any(reading.odometry.is_known for reading in log)


def test_special_ranges_mean_what_rep_117_says(tmp_path):
    maker = Maker("")
    ranges = [math.nan, math.inf, -math.inf, 0.0, 0.01, 40.0, 1.0]
    bag = saved(tmp_path, [("/scan", 1.0, maker.scan(1.0, ranges))])

    expected = [math.nan, math.inf, -math.inf, math.nan, -math.inf, math.inf, 1.0]
    np.testing.assert_array_equal(expected, open_log(bag).readings[0].scan.ranges)


def test_odd_stamps_are_left_out_and_told(tmp_path):
    maker = Maker("")
    stamps = [10.0, 10.1, 10.1, 10.05, 10.2, 15.0, 2.0, 2.1]
    messages = [("/scan", 1.0 + k, maker.scan(stamp, [1.0, 2.0])) for k, stamp in enumerate(stamps)]
    log = open_log(saved(tmp_path, messages))

    assert [10.0, 10.1, 10.2, 15.0, 2.0, 2.1] == [reading.scan.stamp for reading in log]
    for what in ("1 scan with the stamp", "1 scan out of order", "set back 1 time", "longest of 4.8 s"):
        assert what in log.complaint


def test_clocks_that_differ_are_replaced_by_the_times_of_recording(tmp_path):
    maker = Maker("")
    messages = [("/odom", k / 10, maker.odometry(k / 10, (k / 10, 0.0, 0.0))) for k in range(1, 30)]
    messages += [("/scan", k / 10 + 0.05, maker.scan(1e6 + k, [1.0, 2.0])) for k in range(1, 29)]
    log = open_log(saved(tmp_path, sorted(messages, key=lambda message: message[1])))

    assert "times of recording" in log.complaint
    for reading in log:
        assert pytest.approx(reading.scan.stamp) == reading.odometry.odom_from_base.x


def test_topics_are_chosen_by_name(tmp_path):
    maker = Maker("")
    messages = [("/front", 1.0 + k, maker.scan(1.0 + k, [1.0, 2.0])) for k in range(3)]
    messages += [("/rear", 9.0, maker.scan(9.0, [1.0, 2.0]))]
    bag = saved(tmp_path, messages)

    assert 3 == len(open_log(bag))
    assert "/front is used" in open_log(bag).complaint
    assert 1 == len(open_log(bag, scan_topic="/rear"))
    with pytest.raises(FileError, match="there are: /front, /rear"):
        open_log(bag, scan_topic="/side")


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("damage", ["cut", "flipped"])
def test_a_damaged_bag_is_refused_in_one_line_or_read(tmp_path, kind, damage):
    path = saved(tmp_path, drive(Maker(kind), 20), kind)
    file = path if kind == ".bag" else next(path.glob(f"*{kind}"))
    content = bytearray(file.read_bytes())
    for share in (0.2, 0.5, 0.8, 0.99):
        at = int(share * len(content))
        spoilt = content[:at] if damage == "cut" else content[:at] + b"\xff" * 40 + content[at + 40 :]
        file.write_bytes(spoilt)
        try:
            list(open_log(path))
        except FileError as error:
            assert "\n" not in str(error)  # noqa: PT017  # either is right


@pytest.mark.slow
def test_the_same_log_gives_the_same_estimates_in_every_format(tmp_path):
    sketch, settings = open_map(worlds.OFFICE.careful), reduced(LocalizerSettings(), 1 / 20)
    atlas = build_atlas(sketch, settings.atlas)

    def estimates(log):
        localizer = Localizer(atlas, settings)
        return [estimate_record(localizer.update(r.scan, r.odometry), sketch) for r in log]

    told = [estimates(open_log(path)) for path in four_formats(tmp_path)]

    assert 4 == len(told)
    assert told[0] == told[1] == told[2] == told[3]


def test_a_text_log_comes_through_a_pipe(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    line = "FLASER 3 1.0 2.0 3.0 0 0 0 0 0 0 7.5 host 7.5\n"
    writer = threading.Thread(target=pipe.write_text, args=(line * 2,))
    writer.start()

    assert 2 == len(open_log(pipe))
    writer.join()


@needs_bags
def test_a_real_bag_is_read_with_its_mount_and_odometry():
    log = open_log(DATA / "bags" / "mac_take_2_bag")

    assert 356 == len(log)
    assert "1 scan without odometry at the time, left out" == log.complaint
    scan = log.readings[0].scan
    assert {720, 721} >= {len(scan)}
    assert pytest.approx(math.pi / 2, abs=1e-6) == scan.base_from_laser.theta


@needs_bags
def test_a_real_log_of_breezyslam_is_read():
    log = open_log(DATA / "bags" / "exp1.dat")

    assert 756 == len(log)
    assert {682} == {len(reading.scan) for reading in log}
