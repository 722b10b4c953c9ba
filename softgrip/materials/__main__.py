"""``python -m softgrip.materials``: make the kept fits and facts from the tensile tests."""

from softgrip.materials import facts, fitting

if __name__ == "__main__":
    found = fitting.measure()
    fitting.write(found)
    facts.write()
    print(f"{len(found)} fits written to data/{fitting.FITS}, facts to data/{facts.FACTS}")
