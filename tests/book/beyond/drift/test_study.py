import numpy as np
import pytest
from scipy.stats import binom

from book.beyond.drift import kept, study, tasks
from book.beyond.drift.author_order import KEPT as ORDER
from book.beyond.drift.author_order import order
from book.beyond.drift.methods import METHODS, Case
from book.beyond.drift.sessions import HOURS, START, session
from book.beyond.drift.sliders import FORCE, SIZE, WEIGHED, WEIGHT, expected_error, slopes
from book.beyond.drift.study import DRAWN, FITTED, KNOWN, NONE, SETTINGS, SPREADS, TEXT
from book.explore.law import recorded
from softgrip.provenance import data_rows
from softgrip.simulator.fitted_rigs import PAD, fitted_layer
from softgrip.tactile import published_readings
from softgrip.tactile.drift_filter import COUNT, LEFT
from softgrip.tactile.drift_model import DriftSize
from softgrip.units import GRAM_FORCE


@pytest.fixture(scope="module")
def case():
    return Case(session(fitted_layer(), DriftSize(), tasks.SEED), DriftSize())


def rms(case, method):
    return float(np.sqrt(np.mean((METHODS[method][1](case) - case.borne) ** 2)))


def test_the_best_constant_line_is_better_than_other_lines(case):
    best = rms(case, study.BEST)
    for offset, gain in ((0.0, 1.0), (0.05, 1.0), (-0.05, 1.1), (0.1, 0.9)):
        other = case.force(offset + gain * case.voltage) - case.borne
        assert best <= np.sqrt(np.mean(other**2)) + 1e-5
    assert best < rms(case, TEXT)


def test_errors_are_those_by_hand(case):
    force = case.borne + 0.01
    found = study.errors(case, force)
    assert found.force == pytest.approx(0.01)
    assert found.hourly == pytest.approx(np.full(HOURS, 0.01))
    holds = case.session.grasps
    shares = []
    for hour in range(HOURS):
        for weight in {hold.weight for hold in holds}:
            own = [
                f for f, h in zip(force, holds, strict=True) if (h.hour, h.weight) == (hour, weight)
            ]
            shares.append(1 - abs(sum(own) / len(own) - weight) / weight)
    assert found.accuracy == pytest.approx(sum(shares) / len(shares))


def test_all_pauses_that_are_found_are_ones(case):
    record = case.session.record
    assert len(case.rests) > 500
    assert all(record.force[round(rest.time)] == 0 for rest in case.rests)


def test_interval_of_a_median_holds_it_as_often_as_it_says():
    low, high = study.median_interval(np.arange(1.0, 41.0))
    # Between the k-th and the l-th of 40 lies the median with this chance.
    chance = binom.cdf(high - 1, 40, 0.5) - binom.cdf(low - 1, 40, 0.5)
    assert 0.95 <= chance < 0.97


def test_wilson_is_its_formula():
    share, low, high = study.wilson(96, 100)
    z, n = 1.959964, 100
    middle = (share + z**2 / (2 * n)) / (1 + z**2 / n)
    half = z / (1 + z**2 / n) * (share * (1 - share) / n + z**2 / (4 * n**2)) ** 0.5
    assert (low, high) == pytest.approx((middle - half, middle + half), abs=1e-5)


def test_drawn_layers_lie_in_the_intervals():
    layers = study.drawn_layers(50)
    rows = {row["parameter [unit]"].partition(" ")[0]: row for row in data_rows(PAD)}
    for name in ("soft_force", "voltage_noise", "seating", "object_seating"):
        low, high = (float(rows[f"layer.{name}"][end]) for end in ("low", "high"))
        own = [getattr(layer, name) for layer in layers]
        assert low <= min(own) < max(own) <= high
        # In the logarithm the middle one lies about the middle.
        assert np.median(np.log(own)) == pytest.approx(
            np.log(low * high) / 2, abs=0.3 * np.log(high / low)
        )


def test_kept_row_comes_out_again():
    """One setting without the filter, which its own tests check; all sessions of it."""
    chosen = (NONE, TEXT, KNOWN)
    found = study.tried(FITTED, "gain alone", chosen, study.FEWER)
    for name in chosen:
        own = study.outcome(FITTED, "gain alone", name, found[name], found[TEXT])
        row = kept.row(name, FITTED, "gain alone")
        for field in (
            "error",
            "error_high",
            "hour_8",
            "accuracy",
            "median_low",
            "reached",
            "better",
        ):
            # Kept with five digits.
            assert getattr(row, field) == pytest.approx(getattr(own, field), rel=1e-4)


def test_kept_table_has_all_parts():
    rows = {(one.layers, one.setting, one.method): one.sessions for one in kept.kept()}
    wanted = {
        (layers, setting, name): count
        for layers, setting, chosen, count in study.plan()
        for name in chosen
    }
    assert rows == wanted
    assert study.SESSIONS[DRAWN] >= 200
    assert study.SESSIONS[FITTED] >= 100


def test_findings_of_the_page_hold_in_the_table():
    """What its sentences say without a number."""
    one, two, text = (kept.row(name) for name in (SPREADS[1], SPREADS[2], TEXT))
    assert two.error < one.error < text.error
    assert two.reached_low > text.reached_high
    assert kept.row("tracked, 4 at the start").reached_high < kept.row(SPREADS[4]).reached_low
    assert kept.row(SPREADS[32], DRAWN).reached_high < 0.9
    assert kept.enough(DRAWN, "wandering", 0.9) is None
    worse = {
        setting
        for setting in SETTINGS
        if setting != "memory"
        and kept.row(SPREADS[0], FITTED, setting).error > kept.row(TEXT, FITTED, setting).error
    }
    ways = {"never unloaded", "touched in pauses"}
    assert worse == ways | {"no wander is expected", "offset alone"}
    for setting in {*SETTINGS} - ways - {"memory"}:
        own, theirs = (kept.row(name, FITTED, setting) for name in (SPREADS[2], TEXT))
        assert own.error <= theirs.error
    memory = [kept.row(name, DRAWN, "memory") for name in (SPREADS[4], study.MEMORY[0])]
    assert memory[1].error == pytest.approx(memory[0].error, rel=0.2)


@pytest.mark.parametrize("pauses", ["used", "not used"])
@pytest.mark.parametrize(("times", "share", "weights"), [(1, 0.5, 0), (3, 0.2, 1), (0.3, 0.9, 4)])
def test_law_of_the_page_is_gaussian_conditioning(pauses, times, share, weights):
    found = expected_error(pauses, times, share, weights)
    prior = np.diag(
        [
            (2 * times * share * SIZE.gain_rate) ** 2,
            (2 * times * (1 - share) * SIZE.offset_rate) ** 2,
        ]
    )
    for k in (0, 17, 31):
        age = START + found["time"][k]
        seen = [(START * np.array([slopes(WEIGHT)[0], 1]), WEIGHED)] * weights
        if pauses == "used":
            seen.append((age * np.array([slopes(0.0)[0], 1]), LEFT * COUNT / 2))
        left = prior
        if seen:
            H, error = np.array([h for h, _ in seen]), np.diag([e**2 for _, e in seen])
            left = prior - prior @ H.T @ np.linalg.solve(H @ prior @ H.T + error, H @ prior)
        slope, per_force = slopes(FORCE)
        h = age * np.array([slope, 1])
        expected = np.sqrt(h @ left @ h) / per_force / GRAM_FORCE
        assert found["tracked"][k] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("pauses", ["used", "not used"])
def test_law_runs_on_symbols_as_on_numbers(pauses):
    made = recorded(expected_error, ["times", "share", "weights"], pauses=pauses)
    for values in ((1.0, 0.5, 0.0), (0.1, 0.0, 8.0), (10.0, 1.0, 3.0)):
        numbers, symbols = expected_error(pauses, *values), made(values)
        for name, each in numbers.items():
            assert symbols[name] == pytest.approx(np.ravel(each), rel=1e-9)


def test_worst_share_is_where_pauses_tell_least():
    worst = tasks.worst_share()
    at = [tasks.last_error("used", share, 0.0) for share in (worst - 0.1, worst, worst + 0.1)]
    assert at[1] > max(at[0], at[2])


def test_order_counts_neighbours_of_one_weight():
    found = order(np.array([1.0, 3.0, 2.0, 9.0, 8.0, 7.0]), np.array([0.1] * 3 + [0.2] * 3))
    assert (found.up, found.down) == (1, 3)
    assert found.p == pytest.approx(2 * (1 + 4) / 16)


@pytest.mark.skipif(not published_readings.available(), reason="needs the author's readings")
def test_kept_order_is_that_of_the_readings():
    found = published_readings.load()
    own, row = order(found.signal, found.force), ORDER.read()[0]
    assert (own.up, own.down, own.readings) == (row.up, row.down, row.readings)
