"""Chapter 4, the pump and its controllers: experiments, figures, tables, sliders, numbers."""
