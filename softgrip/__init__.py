"""softgrip: the executable companion of a dissertation on a soft robotic gripper.

Nothing is imported here: each subject (`softgrip.materials`, ...) is imported where it is used,
so that a page depends on the files that it uses and on no others.
"""

__version__ = "0.1.0"
