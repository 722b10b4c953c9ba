"""Where the emulated board cannot be built, its tests are skipped."""

import pytest

from softgrip.board.emulated.build import EmulatorUnavailableError, missing

needs_emulator = pytest.mark.skipif(
    bool(missing()), reason=str(EmulatorUnavailableError(missing()))
)
