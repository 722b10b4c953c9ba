"""Chapter 5, materials and dynamics: experiments, figures, tables, sliders, numbers."""
