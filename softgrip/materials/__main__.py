"""``python -m softgrip.materials``: make the kept fits and facts from the tensile tests."""

from softgrip.materials import facts, fitting

if __name__ == "__main__":
    fitting.KEPT.main()
    facts.KEPT.main()
