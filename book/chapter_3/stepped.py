"""The simulated rig with a finger of another section, and the frequency that its steps tell."""

from book.companion.choices import choice
from softgrip.actuator.printed import section as printed_section
from softgrip.actuator.printed import table_3_2
from softgrip.actuator.section import Section
from softgrip.dynamics.identify import Identified, identify
from softgrip.reads import remembered
from softgrip.simulator.chance import SEED
from softgrip.simulator.fitted_rigs import design_1
from softgrip.simulator.parameters import RigParameters
from softgrip.simulator.scaled_section import with_section
from softgrip.simulator.small_signal import small_signal_poles
from softgrip.simulator.steps import simulate_step_test, travel_to

RUNS = 7


def rig_with(section: Section) -> RigParameters:
    """Return the rig of Design 1 with another section; as `with_section`."""
    return with_section(design_1(), section, printed_section("Opt. parameters"))


def frequency_step() -> float:
    """Return the step whose frequency is identified, rad: fitted, as none is printed."""
    return choice("frequency_step")


def small_motions() -> float:
    """Return the natural frequency of Design 1 for small motions about that step's end, rad/s."""
    return float(abs(small_signal_poles(design_1().finger, frequency_step())[0]))


def identified_step(rig: RigParameters) -> Identified:
    """Identify the mean of seven simulated steps, pressure to angle, as Section 3.4 does."""
    test = simulate_step_test(rig, travel_to(rig, frequency_step()), runs=RUNS, seed=SEED)
    return identify(test.time, test.pressure, test.angle, initial_input=0.0, dead_time=0.0)


@remembered
def identified_row(row: int) -> Identified:
    """Identify simulated steps of the section of a row of Table 3.2, 1 to 4."""
    return identified_step(rig_with(table_3_2()[row - 1].section))
