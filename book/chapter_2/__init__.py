"""Chapter 2, the tactile sensor: experiments, figures, tables, sliders, numbers."""
