"""The optimal design of Eq. (3.20): IPOPT against SciPy's solvers on the same problem."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, replace
from time import perf_counter

import numpy as np
from scipy.optimize import Bounds as Box
from scipy.optimize import NonlinearConstraint, differential_evolution, minimize

from softgrip.actuator.certificate import certified_design
from softgrip.actuator.design import DIMENSIONS, DesignProblem, objective, product
from softgrip.actuator.optimize import optimal_design
from softgrip.actuator.printed import table_3_2
from softgrip.actuator.section import Section
from tests.bench.entry import Entry, entry, timed

MOST_ITERATIONS, MOST_SECONDS, MOST_ROWS_SECONDS = 10, 3e-3, 2.0
PRINTED_ITERATIONS = 42
RIVALS = ("SLSQP", "trust-constr", "differential evolution")


@dataclass
class _Counted:
    """The objective of the four dimensions in mm, and how often it was asked for."""

    problem: DesignProblem
    calls: int = 0

    def __call__(self, x: np.ndarray) -> float:
        self.calls += 1
        section = Section(*(np.asarray(x) * 1e-3))
        if section.bottom <= section.wall:
            return 1e3  # bends backwards: there is no angle
        return -float(objective(self.problem, section))


def _constraints(problem: DesignProblem) -> list[NonlinearConstraint]:
    height = problem.bounds.height
    found = [NonlinearConstraint(lambda x: x[0] + x[1], height[0] * 1e3, height[1] * 1e3)]
    if problem.band is not None:
        first, last = problem.product_range
        found.append(
            NonlinearConstraint(
                lambda x: product(problem, Section(*(np.asarray(x) * 1e-3))) / last,
                first / last,
                1.0,
            )
        )
    return found


def _starts(problem: DesignProblem, count: int) -> list[Section]:
    rng, bounds = np.random.default_rng(0), problem.bounds
    drawn = [Section(*(rng.uniform(*getattr(bounds, d)) for d in DIMENSIONS)) for _ in range(count)]
    # And starts that bend backwards, where Eq. (3.10) is undefined.
    backwards = replace(drawn[0], bottom=bounds.bottom[0], wall=bounds.wall[1])
    return [*drawn, backwards]


def _rivals(problem: DesignProblem, starts: list[Section], names: Sequence[str]) -> list[Entry]:
    low, high = np.array([getattr(problem.bounds, d) for d in DIMENSIONS]).T * 1e3
    feasible = [s for s in starts if s.bottom > s.wall]
    best = optimal_design(problem).objective
    ours = float(np.median([timed(lambda s=s: optimal_design(problem, s)) for s in starts]))
    found = []
    for name in names:
        seconds, calls, values = [], [], []
        for start in feasible[: 1 if name == "differential evolution" else 5]:
            counted, begin = _Counted(problem), perf_counter()
            x0 = 1e3 * np.array([getattr(start, d) for d in DIMENSIONS])
            if name == "differential evolution":
                result = differential_evolution(
                    counted, Box(low, high), constraints=_constraints(problem), seed=0
                )
            else:
                with warnings.catch_warnings():
                    # trust-constr remarks that a constraint is linear.
                    warnings.simplefilter("ignore", UserWarning)
                    result = minimize(
                        counted, x0, method=name, bounds=Box(low, high, keep_feasible=True),
                        constraints=_constraints(problem),
                        options={"maxiter": 400, **({"ftol": 1e-9} if name == "SLSQP" else {})},
                    )  # fmt: skip
            seconds.append(perf_counter() - begin)
            calls.append(counted.calls)
            inside = all(
                np.all(c.fun(result.x) >= c.lb - 1e-6) and np.all(c.fun(result.x) <= c.ub + 1e-6)
                for c in _constraints(problem)
            )
            values.append(-float(result.fun) if inside else -np.inf)
        taken = float(np.median(seconds))
        found.append(
            entry(
                f"one design, against {name}", ours, "s", taken, "", None,
                f"Row 2 of Table 3.2, four dimensions, derivatives by differences:"
                f" {np.median(calls):.0f} evaluations, best value {max(values):.6f} of"
                f" {len(values)} starts (worst {min(values):.6f}); ours {best:.6f}.",
            )
        )  # fmt: skip
    return found


def entries(*, starts: int = 300, rivals: Sequence[str] = RIVALS) -> list[Entry]:
    """Return iterations and times of the solver, the certificates of Table 3.2, and the rivals."""
    problems = [row.problem() for row in table_3_2()]
    optimal_design(problems[0])  # builds the program, once
    iterations, seconds, values = [], [], []
    for problem in (DesignProblem(fractional_power=2.5), *problems):
        reached = []
        for start in _starts(problem, starts):
            begin = perf_counter()
            design = optimal_design(problem, start)
            seconds.append(perf_counter() - begin)
            iterations.append(design.iterations)
            reached.append(design.objective)
        values.append(np.ptp(reached) / max(reached))
    most, median = max(iterations), float(np.median(seconds))
    certified = timed(lambda: [certified_design(problem) for problem in problems])
    certificates = [certified_design(problem).certificate for problem in problems]
    found = [
        entry(
            "one design, most iterations", float(most), "1", float(PRINTED_ITERATIONS),
            f"<= {MOST_ITERATIONS}", most <= MOST_ITERATIONS,
            f"Of {len(iterations)} starts on {1 + len(problems)} problems, starts that bend"
            f" backwards included; all reached one value within {max(values):.1g}. Baseline: the"
            " iterations that Section 3.3 reports of its solver.",
        ),
        entry(
            "one design, time", median, "s", None, f"<= {MOST_SECONDS:g}", median <= MOST_SECONDS,
            f"Median; {1e3 * np.percentile(seconds, 99):.2g} ms at the 99th percentile.",
        ),
        entry(
            "Table 3.2 with certificates, time", certified, "s", None, f"< {MOST_ROWS_SECONDS:g}",
            certified < MOST_ROWS_SECONDS and all(c.proven for c in certificates),
            f"{len(problems)} rows, each solved and proved to be within 1e-5 of the best:"
            f" {sum(c.boxes for c in certificates):,} boxes.",
        ),
    ]  # fmt: skip
    return found + _rivals(problems[1], _starts(problems[1], 5), rivals)
