"""The host at the emulated board that the tests of its safety begin with."""

import pytest

from tests.board.host import pushing_host


@pytest.fixture
def pushing():
    """A host whose motor pushes at full speed, 600 steps or more from home."""
    return pushing_host()
