"""What the package offers by name."""

import pytest

import pilotage


@pytest.mark.parametrize("name", pilotage.__all__)
def test_every_public_name_can_be_fetched_and_explains_itself(name):
    assert name == getattr(pilotage, name).__name__
    assert getattr(pilotage, name).__doc__


def test_every_public_name_has_one_home():
    homes = sorted(name for names in pilotage.HOMES.values() for name in names)

    assert sorted(pilotage.__all__) == homes


def test_other_names_are_not_there():
    with pytest.raises(AttributeError, match="no attribute 'fly'"):
        _ = pilotage.fly
