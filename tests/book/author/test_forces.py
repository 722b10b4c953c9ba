"""Regressors on the author's force readings: by hand, as kept, and what the page says of them."""

import hashlib
from dataclasses import astuple

import numpy as np
import pytest

from book.author import forces
from book.author.forces import LEVEL, LINE, PARABOLA, PUBLISHED, READING, SIMULATED
from softgrip.provenance import data_folder
from softgrip.tactile import published_readings
from softgrip.tactile.force_comparison import root_mean_square


def left_out_by_hat(signal, force, degree):
    """Errors of a polynomial without each point, from the diagonal of its hat matrix."""
    X = np.vander(signal / signal.max(), degree + 1)
    hat = X @ np.linalg.pinv(X)
    return (force - hat @ force) / (1 - np.diag(hat))


@pytest.mark.usefixtures("published_readings")
def test_errors_by_hand_of_a_reading_left_out():
    signal, force = forces.points(PUBLISHED)
    away = abs(signal[:, None] - signal)
    np.fill_diagonal(away, np.inf)
    weights = np.exp(-0.5 * (away / 0.5) ** 2)
    by_hand = [
        root_mean_square(left_out_by_hat(signal, force, 1)),
        root_mean_square(left_out_by_hat(signal, force, 2)),
        root_mean_square(force - weights @ force / weights.sum(axis=1)),
    ]
    assert by_hand == pytest.approx([0.0953, 0.0958, 0.0985], abs=5e-5)
    kept = forces.kept_errors(PUBLISHED, READING)
    # Widths are tried in steps of 12 %: the best of them is as good as 0.5, and no better.
    names = LINE, PARABOLA, "Nadaraya-Watson, best width"
    assert [kept[name].error for name in names] == pytest.approx(by_hand, abs=2e-5)
    assert kept["k-nearest neighbours, best k"].error == pytest.approx(0.100, abs=5e-4)


@pytest.mark.usefixtures("published_readings")
@pytest.mark.parametrize("left_out", [READING, LEVEL])
def test_kept_errors_are_what_the_readings_give(left_out):
    # The network and the neighbours, which take longest, are left to the command.
    kept = forces.kept_errors(PUBLISHED, left_out)
    chosen = [LINE, PARABOLA, "Nadaraya-Watson", "Nadaraya-Watson, best width"]
    for found in forces.regressor_errors(PUBLISHED, left_out, chosen):
        numbers = astuple(found)[3:]
        # Five decimals are kept.
        assert numbers == pytest.approx(astuple(kept[found.regressor])[3:], abs=6e-6)


@pytest.mark.usefixtures("published_readings")
def test_kept_repeatability_is_what_the_readings_give():
    signal, force = forces.points(PUBLISHED)
    found = forces.repeatability(signal, force)
    kept = forces.REPEATABILITY.read()[0]
    assert astuple(found) == pytest.approx(astuple(kept), abs=6e-6)
    # The line's forces are its slope times the signal, plus a constant.
    slope = np.cov(signal, force)[0, 1] / signal.var(ddof=1)
    spread = [abs(slope) * signal[force == level].std(ddof=1) for level in np.unique(force)]
    assert (found.least, found.largest) == pytest.approx((min(spread), max(spread)))
    assert found.above == sum(s > forces.LIMIT for s in spread)


def test_readings_on_a_line_repeat_and_levels_of_one_do_not_count():
    force = np.array([0.0, 0.0, 0.5, 0.5, 1.0])
    found = forces.repeatability(3 + 2 * force, force)
    assert (found.readings, found.levels, found.above) == (4, 2, 0)
    assert found.largest < 1e-12


def test_what_the_page_says_of_the_errors():
    by_reading, by_level = (forces.kept_errors(PUBLISHED, how) for how in (READING, LEVEL))
    others = {name for name in by_level if name != LINE}
    assert len(others) == 6
    for rows in (by_reading, by_level):
        assert all(rows[name].error > rows[LINE].error for name in others)
    assert by_reading[PARABOLA].beyond_low < 0 < by_reading[PARABOLA].beyond_high
    assert by_level["Nadaraya-Watson"].beyond_low > 0
    simulated = forces.kept_errors(SIMULATED, LEVEL)
    assert all(simulated[name].beyond_high < 0 for name in others)
    assert forces.error_if_curved_as_simulated() > by_level[LINE].high
    repeated = forces.REPEATABILITY.read()[0]
    assert repeated.pooled > forces.LIMIT
    assert repeated.above > repeated.levels / 2


def test_figure_without_the_readings_has_the_simulated_ones(monkeypatch):
    monkeypatch.setattr(published_readings, "available", lambda: False)
    drawn = forces.draw_fits()
    assert [axes.get_title() for axes in drawn.axes] == [SIMULATED]


@pytest.mark.usefixtures("published_readings")
def test_figure_has_both_sensors_and_all_regressors():
    drawn = forces.draw_fits()
    assert [axes.get_title() for axes in drawn.axes] == [PUBLISHED, SIMULATED]
    for axes in drawn.axes:
        labels = [line.get_label() for line in axes.lines]
        assert labels == ["readings", *forces.CURVES]


def test_the_readings_are_no_part_of_the_project():
    files = [path for path in data_folder().rglob("*") if path.is_file()]
    digests = {hashlib.sha256(path.read_bytes()).hexdigest() for path in files}
    assert len(digests) > 50
    assert not digests & {*published_readings.FILES.sha256.values()}
