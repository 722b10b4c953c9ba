"""The finger as it is designed: section, torque, bending, frequency, optimum, finite elements."""
