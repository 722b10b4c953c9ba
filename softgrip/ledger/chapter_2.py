"""Recomputation of the numbers printed in Chapter 2, from its parts."""

from softgrip.ledger.chapter_2_element import (
    by_finite_elements,
    ceiling_force,
    cylinder_by_equation,
    hemisphere_by_equation,
    hertzian,
    least_force_felt,
    pyramid_by_equation,
)
from softgrip.ledger.chapter_2_force import (
    accuracy_of,
    best_accuracy,
    largest_force,
    mean_accuracy,
    mean_deviation,
    nearest_weight,
    points,
    weighed,
    weights,
)
from softgrip.ledger.chapter_2_grasp import (
    lift_of_desired,
    pressed,
    printed_lift,
    simulated_lift,
    true_weight,
)
from softgrip.ledger.chapter_2_kind import (
    accuracy_on_objects,
    best_k,
    best_of_the_others,
    object_contacts,
    split_accuracy,
)
from softgrip.ledger.chapter_2_pad import (
    converter_rate,
    element_ceiling,
    elements_of_a_line,
)

__all__ = [
    "accuracy_of",
    "accuracy_on_objects",
    "best_accuracy",
    "best_k",
    "best_of_the_others",
    "by_finite_elements",
    "ceiling_force",
    "converter_rate",
    "cylinder_by_equation",
    "element_ceiling",
    "elements_of_a_line",
    "hemisphere_by_equation",
    "hertzian",
    "largest_force",
    "least_force_felt",
    "lift_of_desired",
    "mean_accuracy",
    "mean_deviation",
    "nearest_weight",
    "object_contacts",
    "points",
    "pressed",
    "printed_lift",
    "pyramid_by_equation",
    "simulated_lift",
    "split_accuracy",
    "true_weight",
    "weighed",
    "weights",
]
