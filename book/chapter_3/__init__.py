"""Chapter 3, the finger and its regulator: experiments, figures, tables, sliders, numbers."""
