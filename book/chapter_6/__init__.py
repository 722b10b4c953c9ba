"""Chapter 6, a gripper on one pump: experiments, figures, tables, sliders, numbers."""
