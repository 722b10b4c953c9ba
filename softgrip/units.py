"""Factors into SI: multiply on the way in, divide on the way out.

>>> 0.26 * MPa
260000.0
>>> round(3.141592653589793 / DEG, 9)
180.0
"""

from math import pi

MPa = 1e6  # Pa
PSI = 6894.757293168  # Pa
GRAM_FORCE = 9.80665e-3  # N
MM = 1e-3  # m
ML = 1e-6  # m^3
DEG = pi / 180  # rad
REV = 2 * pi  # rad
