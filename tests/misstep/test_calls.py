"""How a function of a student is called."""

import signal

import pytest

from misstep.calls import TooLong, interrupted


def forever():
    while True:
        pass


@pytest.mark.parametrize("handler", [signal.default_int_handler, signal.SIG_IGN])
def test_a_loop_is_interrupted_also_where_a_shell_ignores_ctrl_c(handler):
    before = signal.signal(signal.SIGINT, handler)
    try:
        with pytest.raises(TooLong), interrupted(0.05):
            forever()
        assert signal.getsignal(signal.SIGINT) == handler
    finally:
        signal.signal(signal.SIGINT, before)
