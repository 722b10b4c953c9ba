"""What the author's scripts compute beside what is printed, and where his sources disagree."""

from dataclasses import replace

import pandas as pd

from book.author.scripts import (
    checked_angle,
    checked_finger,
    checked_frequency,
    checked_torque,
    control_model,
    control_plant,
    control_weights,
    design_problem,
    gain_ratio,
    inputs,
    lqr_metrics,
    pid_metrics,
)
from book.companion.claims import printed, sources
from softgrip.actuator.certificate import CertifiedDesign, certified_design
from softgrip.actuator.design import Bounds, DesignProblem, FrequencyBand, Range
from softgrip.actuator.printed import table_3_2
from softgrip.actuator.section import torque
from softgrip.control.designs import unit_step
from softgrip.control.lqr import FINGER, Weights
from softgrip.control.ziegler_nichols import integrating_reaction_curve, ziegler_nichols
from softgrip.dynamics.second_order import SecondOrder
from softgrip.gripper.plant import PRINTED
from softgrip.gripper.printed_loop import FILTERS
from softgrip.gripper.shaping_filter import plant_inside
from softgrip.reads import remembered
from softgrip.units import MM, MPa

COMES_OUT = "comes out"
NOT_PRINTED = "not printed"


def held_against(value: float, claim: str) -> str:
    """Say whether a value rounds to what a claim prints, and if not, by how much it is off.

    >>> held_against(19.27, "table-3.2-top-2"), held_against(19.4, "table-3.2-top-2")
    ('comes out', '+0.5 %')
    """
    number = printed(claim)
    if abs(value - number) <= number.half:
        return COMES_OUT
    return f"{100 * (value / number - 1):+.1f} %"


def source_table() -> pd.DataFrame:
    """Tabulate the author's files that this page uses."""
    return pd.DataFrame(
        {
            "what": source.name,
            "repository": source.repository,
            "file": source.file,
            "commit": source.commit,
        }
        for source in sources().values()
    )


def _against(what: str, value: str, number: float, claim: str, where: str) -> dict[str, str]:
    return {
        "Design 1": what,
        "with his inputs": value,
        "printed": f"{printed(claim).text}, {where}",
        "so": held_against(number, claim),
    }


def model_table() -> pd.DataFrame:
    """Tabulate what the check script computes of Design 1."""
    at_limit = float(torque(checked_finger().section, 0.25 * MPa))
    angle, other = checked_angle(), checked_angle(wall_subtracted=True)
    frequency, design = checked_frequency(), "design-1-e1-"
    told, pressure = "bending angle (deg)", design_problem().pressure / MPa
    first = {
        "Design 1": f"torque at {pressure:g} MPa (N m)",
        "with his inputs": f"{checked_torque():.6f}",
        "printed": "",
        "so": NOT_PRINTED,
    }
    rows = [
        first,
        _against("torque at 0.25 MPa (N m)", f"{at_limit:.3f}", at_limit, "3.4-measured-torque",
                 "measured"),
        _against(told, f"{angle:.2f}", angle, "3.4-model-angle", "by the model"),
        _against(told, f"{angle:.2f}", angle, f"3.4-measured-angle-{design}", "measured"),
        _against(f"{told}, wall subtracted", f"{other:.1f}", other,
                 f"3.4-measured-angle-{design}", "measured"),
        _against("natural frequency (rad/s)", f"{frequency:.3f}", frequency,
                 f"table-3.3-estimated-{design}", "by the model"),
        _against("natural frequency (rad/s)", f"{frequency:.3f}", frequency,
                 f"table-3.3-measured-{design}", "measured"),
    ]  # fmt: skip
    return pd.DataFrame(rows)


@remembered
def his_optimum(band: Range) -> CertifiedDesign:
    """Return the best section of the design script's problem for a band, rad/s, with its proof."""
    return certified_design(design_problem(band))


@remembered
def stated_optimum(band: Range) -> CertifiedDesign:
    """Return the best section of Section 3.3's problem, its a and b exchanged, at n = 1."""
    mass = float(printed("table-3.3-weight-design-1-e1-"))
    return certified_design(DesignProblem(band=FrequencyBand(*band, mass, mass)))


def optimum_table() -> pd.DataFrame:
    """Tabulate Table 3.2 by the design script's problem, and row 3 with the next band below."""
    rows = [(f"{k}", k, (row.low, row.high)) for k, row in enumerate(table_3_2(), start=1)]
    _, _, (low, high) = rows[2]
    rows.insert(3, ("3, with the band below", 3, (2 * low - high, low)))
    found = []
    for name, k, band in rows:
        best, stated = his_optimum(band), stated_optimum(band)
        section, claim = best.design.section, f"table-3.2-top-{k}"
        other = stated.design.section
        others = (section.bottom, section.width, section.wall)
        proved = best.certificate.proven and stated.certificate.proven
        found.append(
            {
                "row": name,
                "band (rad/s)": f"{band[0]:.2f} to {band[1]:.2f}",
                "a printed (mm)": printed(claim).text,
                "a, his inputs": f"{section.top / MM:.2f}",
                "so": held_against(section.top / MM, claim),
                "b, w, t": ", ".join(f"{x / MM:.3g}" for x in others),
                "a, b by Section 3.3": f"{other.top / MM:.2f}, {other.bottom / MM:.2f}",
                "proved": "yes" if proved else "no",
            }
        )
    return pd.DataFrame(found)


def control_table() -> pd.DataFrame:
    """Tabulate what the control script's two loops do, with A right and as the script has it."""
    models = [control_model(as_written=written) for written in (False, True)]
    lqr = [lqr_metrics(model, control_weights()) for model in models]
    pid = [pid_metrics(as_written=written) for written in (False, True)]
    settling, full = "3.4-lqr-settling", "4.3-settling-full-model"
    return pd.DataFrame(
        {
            "of a step": what,
            "A of Eq. (3.28)": f"{right:.{digits}f}",
            "A as written": f"{written:.{digits}f}",
            "printed": printed(claim).text if claim else "",
            "so": held_against(right, claim) if claim else NOT_PRINTED,
        }
        for what, (right, written), digits, claim in (
            ("LQR, settling to 2 % (s)", [float(x.settling_time) for x in lqr], 2, settling),
            ("LQR, rise from 10 to 90 % (s)", [float(x.rise_time) for x in lqr], 3, settling),
            ("PID, overshoot (%)", [100 * float(x.overshoot) for x in pid], 0, ""),
            ("PID, settling to 2 % (s)", [float(x.settling_time) for x in pid], 1, full),
        )
    )


def gains_table() -> pd.DataFrame:
    """Tabulate the script's PID gains beside those of Ziegler and Nichols' rule for its plant."""
    script = inputs("control")
    rule = ziegler_nichols(integrating_reaction_curve(*unit_step(control_plant())))
    rows = {
        "the script": [float(script[name]) for name in ("kp", "ki", "kd")],
        "Ziegler and Nichols, his plant": [float(rule.kp), float(rule.ki), float(rule.kd)],
    }
    return pd.DataFrame(
        {
            "gains": name,
            "Kp": f"{kp:.2f}",
            "Ki": f"{ki:.2f}",
            "Kd": f"{kd:.2f}",
            "Kp² / (Ki Kd)": f"{gain_ratio(kp, ki, kd):.1f}",
        }
        for name, (kp, ki, kd) in rows.items()
    )


def _models() -> list[tuple[str, ...]]:
    check, script = inputs("check"), inputs("design")
    first, mass = check["first_fractional_power"], printed("table-3.3-weight-design-1-e1-")
    frequency, angle = f"{checked_frequency():.2f} rad/s", f"{checked_angle():.1f} deg"
    return [
        ("M", f"Table 3.3: {mass:g}", f"{checked_frequency(mass):.2f} rad/s",
         f"scripts: {script['mass']:g}", frequency, "table-3.3-estimated-design-1-e1-"),
        ("n", f"first check script: {first:g}",
         f"{checked_frequency(fractional_power=first):.2f} rad/s",
         f"last: {check['fractional_power']:g}", frequency, "table-3.3-estimated-design-1-e1-"),
        ("elongation by", "Eq. (3.10), design script: A_c / A_w", angle,
         "check script: 1 less", f"{checked_angle(wall_subtracted=True):.1f} deg",
         "3.4-model-angle"),
    ]  # fmt: skip


def _problems() -> list[tuple[str, ...]]:
    second = table_3_2()[1]
    his, banded, stated = design_problem(), design_problem((second.low, second.high)), Bounds()
    summed = replace(banded, combined=DesignProblem().combined)
    thicker = replace(his, bounds=replace(his.bounds, bottom=stated.bottom))
    taller = replace(his, bounds=replace(his.bounds, height=stated.height))

    def range_of(bounds: Bounds, name: str) -> str:
        low, high = getattr(bounds, name)
        return f"{low / MM:g} to {high / MM:g} mm"

    return [
        ("objective, row 2", f"Eq. (3.17): {summed.combined}", _top_and_bottom(summed),
         f"design script: {banded.combined}", _top_and_bottom(banded), "table-3.2-top-2"),
        ("range of b", f"Section 3.3: {range_of(stated, 'bottom')}", _top_and_bottom(thicker),
         f"design script: {range_of(his.bounds, 'bottom')}", _top_and_bottom(his),
         "table-3.2-bottom-1"),
        ("range of h", f"Section 3.3: {range_of(stated, 'height')}", _top_and_bottom(taller),
         f"design script: {range_of(his.bounds, 'height')}", _top_and_bottom(his),
         "table-3.2-top-1"),
    ]  # fmt: skip


def _regulators() -> list[tuple[str, ...]]:
    stated, his, model = Weights(), control_weights(), control_model()
    chosen, claim = _settling(model, his), "3.4-lqr-settling"
    return [
        ("weights", f"Section 3.4: p = {stated.p:g}, {stated.q[1]:g}", _settling(model, stated),
         f"control script: p = {his.p:g}, {his.q[1]:g}", chosen, claim),
        ("finger of the LQR", f"Table 3.3: {FINGER.natural_frequency:g} rad/s",
         _settling(FINGER, his), f"control script: {model.natural_frequency:g} rad/s", chosen,
         claim),
        ("last row of A", "Eq. (3.28)", chosen, "control script: exchanged",
         _settling(control_model(as_written=True), his), claim),
    ]  # fmt: skip


def _settling(finger: SecondOrder, weights: Weights) -> str:
    return f"{float(lqr_metrics(finger, weights).settling_time):.2f} s"


def _top_and_bottom(problem: DesignProblem) -> str:
    section = certified_design(problem).design.section
    return f"a {section.top / MM:.2f}, b {section.bottom / MM:.2f} mm"


def disagreement_table() -> pd.DataFrame:
    """Tabulate where two of the author's sources disagree, and what follows from each.

    One input is changed at a time; all others are those of the last scripts.
    """
    return pd.DataFrame(
        {
            "what": what,
            "by one": one,
            "gives": gives,
            "by the other": other,
            "then": then,
            "printed": printed(claim).text,
        }
        for what, one, gives, other, then, claim in (*_models(), *_problems(), *_regulators())
    )


def plant_table() -> pd.DataFrame:
    """Tabulate the plant inside each printed filter H(s), beside the author's and the fingers."""
    inside = {f"inside H(s) for {loop}": plant_inside(*FILTERS[loop]) for loop in FILTERS}
    model = control_model()
    w, zeta = model.natural_frequency, model.damping_ratio
    plants = {
        **inside,
        "control script": (2 * zeta * w, w**2),
        **{
            f"element {k}, Eq. (6.26)": (finger.damping, finger.stiffness)
            for k, finger in enumerate(PRINTED.fingers, start=1)
        },
    }
    return pd.DataFrame(
        {
            "plant": name,
            "natural frequency (rad/s)": f"{stiffness**0.5:.3f}",
            "damping ratio": f"{damping / (2 * stiffness**0.5):.3f}",
        }
        for name, (damping, stiffness) in plants.items()
    )
