"""A quantity on a command line."""


def quantity(words: str) -> float | str:
    """Return a bare number, which is in SI, or words with a unit, as `softgrip.quantities` takes.

    >>> quantity("0.08"), quantity("80 mm")
    (0.08, '80 mm')
    """
    try:
        return float(words)
    except ValueError:
        return words
