"""The finger as it is designed: section, torque, bending, natural frequency, optimal design, finite elements."""
