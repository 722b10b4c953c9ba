"""Valid files of every kind that is read, small, as bytes: what damage starts from."""

import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

from softgrip.board.calibration import BoardCalibration, fit_sensor, nominal, save
from softgrip.logs.schema import LogHeader
from softgrip.provenance import Provenance, data_folder
from softgrip.tactile import pad_model
from softgrip.tactile.own_pad import PadReadings

TIME = np.arange(0, 4, 0.05)
STRAIN = np.linspace(0, 3, 40)
STRESS = 0.12e6 * STRAIN**1.6
MAPPING = """[columns]
time = "t [ms]"
command = "motor [rpm]"
pressure = "P [psi]"
angle = "flex [deg]"
reference = "goal [deg]"
event = "note"

[header]
area = "3.2e-4 m^2"
lead = "2e-3 m"
"""
HEADER = LogHeader(
    Provenance.LOGGED, "a rig", "board", 0.05, notes={"area": "3.2e-4 m^2", "lead": "2e-3 m"}
)


def table(names: str, *columns: object, separator: str = ",", decimal: str = ".") -> str:
    """Return rows of numbers and words under their names."""
    rows = zip(*(np.asarray(column) for column in columns), strict=True)
    cells = (
        (f"{x:.6g}".replace(".", decimal) if isinstance(x, float) else str(x) for x in row)
        for row in rows
    )
    return "\n".join([names, *(separator.join(row) for row in cells), ""])


def log() -> bytes:
    """Return a log of the rig: a push that settles, with all that the analyses need."""
    angle = 1 - np.exp(-2 * TIME) * (1 + 2 * TIME)
    pressure = 1.6e5 * (1 - np.exp(-TIME))
    speed = np.where(TIME < 3, 6.0, 0.0)
    names = "time [s],command [rad/s],pressure_counts [count],angle_counts [count]," \
        "pressure [Pa],angle [rad],reference [rad],event"  # fmt: skip
    counts = np.round(100 + 300 * angle).astype(int)
    event = np.where(TIME == 1.0, "half way", "")
    head = "".join(f"# {key}: {value}\n" for key, value in HEADER.lines().items())
    one = np.ones_like(TIME)
    return (head + table(names, TIME, speed, counts, counts, pressure, angle, one, event)).encode()


def other_log() -> bytes:
    """Return a log of another program: its own names and units, no header."""
    angle = 57.3 * (1 - np.exp(-2 * TIME) * (1 + 2 * TIME))
    names = "t [ms];motor [rpm];P [psi];flex [deg];goal [deg];note"
    note = np.where(TIME == 1.0, "half way", "")
    columns = (1e3 * TIME, 60 + 0 * TIME, 13 - 13 * np.exp(-TIME), angle, 57.3 + 0 * TIME, note)
    return table(names, *columns, separator=";", decimal=",").encode()


def kept(name: str, rows: int) -> Callable[[], bytes]:
    """Return what reads the first rows of a log that the book brings."""
    return lambda: b"".join(
        (data_folder() / "simulated" / name).read_bytes().splitlines(keepends=True)[:rows]
    )


def readings() -> bytes:
    """Return readings of a pad with kinds, forces and presses."""
    volts = np.random.default_rng(0).uniform(0.2, 4, (24, 3))
    kinds, press = np.tile(["point", "line", "none"], 8), np.arange(24) // 2
    return table(
        "e1 [V],e2 [V],e3 [V],kind,weight [gf],press", *volts.T, kinds, 10.0 * press, press
    ).encode()


def export() -> bytes:
    """Return a tester's export: sizes before the names, units in a row, every number quoted."""
    rows = zip(STRAIN * 10, STRAIN * 30, STRESS * 12e-6, strict=True)
    body = "\n".join(",".join(f'"{x:.6f}"' for x in row) for row in rows)
    return (
        '"Specimen label","rubber"\n"Gauge length","30","mm"\n"Width","4","mm"\n'
        '"Thickness","3","mm"\n\n"Time","Extension","Load"\n"(s)","(mm)","(N)"\n' + body + "\n"
    ).encode("utf-8-sig")


def german_export() -> bytes:
    """Return a tester's export of strain and stress, with decimal commas, in latin-1."""
    text = table("Dehnung;Standardkraft;Spannung", 100 * STRAIN, STRESS * 12e-6, STRESS / 1e6,
                 separator=";", decimal=",").replace("\n", "\n%;N;MPa\n", 1)  # fmt: skip
    return ("Prüfkörper;Größe 2\n\n" + text).encode("latin-1")


def database() -> bytes:
    """Return a tensile test as the database has it."""
    names = "Time (s);True Strain;True Stress (MPa);Engineering Strain;Engineering Stress (MPa)"
    true = np.log1p(STRAIN), STRESS / 1e6 * (1 + STRAIN)
    return ("rubber\n" + table(names, 10 * STRAIN, *true, STRAIN, STRESS / 1e6,
                               separator=";")).encode("latin-1")  # fmt: skip


def saved(write: Callable[[Path], object]) -> bytes:
    """Return what is written to a path."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "file"
        write(path)
        return path.read_bytes()


def calibration() -> bytes:
    """Return the calibration of a board, with a line and a divider."""
    divider = fit_sensor([100, 200, 400, 800], [8.0, 4.0, 2.0, 1.0], curve="divider")
    known = BoardCalibration("board-1", nominal().pressure, (nominal().angles[0], divider), "mine")
    return saved(lambda path: save(known, path, "weights"))


def model() -> bytes:
    """Return a fitted model of a pad."""
    volts = np.random.default_rng(0).uniform(0.2, 4, (12, 2))
    of_forces = PadReadings(("a", "b"), volts, np.arange(12.0))
    fitted = pad_model.PadModel(pad_model.ForceSettings(0.5)).fit(of_forces)
    return saved(lambda path: pad_model.save(fitted, path))


SEEDS: dict[str, Callable[[], bytes]] = {
    "log": log,
    "other log": other_log,
    "mapping": MAPPING.encode,
    "pad log": kept("pad-objects.csv", 101),
    "layer log": kept("force-weights.csv", 81),
    "gripper log": kept("gripper-open-1.csv", 76),
    "readings": readings,
    "export": export,
    "german export": german_export,
    "database": database,
    "calibration": calibration,
    "rig": lambda: (data_folder() / "calibration" / "design-1.csv").read_bytes(),
    "model": model,
}
"""What makes a file, by its kind."""
