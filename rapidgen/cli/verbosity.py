"""How much is said: `-v`, `-vv` and `-q`, wherever they stand on the command line."""

import logging
import sys
from collections.abc import Sequence

_LEVELS = {
    "-v": logging.INFO,
    "--verbose": logging.INFO,
    "-vv": logging.DEBUG,
    "-q": logging.ERROR,
    "--quiet": logging.ERROR,
}
_LOG = logging.getLogger("rapidgen")
"""Above those of all rooms."""


def set_up(text: Sequence[str]) -> list[str]:
    """Log to stderr what the words ask for, warnings by default; the words without those."""
    own = [word for word in text if word in _LEVELS]
    again = own.count("-v") + own.count("--verbose") > 1
    _LOG.setLevel(
        logging.DEBUG if again else min(map(_LEVELS.__getitem__, own), default=logging.WARNING)
    )
    if not any(isinstance(handler, _ToStderr) for handler in _LOG.handlers):
        handler = _ToStderr()
        handler.setFormatter(
            logging.Formatter("%(asctime)s.%(msecs)03d %(name)s: %(message)s", "%H:%M:%S")
        )
        _LOG.addHandler(handler)
    return [word for word in text if word not in own]


def is_quiet() -> bool:
    """Whether nothing but errors is to be said."""
    return _LOG.getEffectiveLevel() >= logging.ERROR


class _ToStderr(logging.Handler):
    """Records as lines on stderr, whatever that is at the time."""

    def emit(self, record: logging.LogRecord) -> None:
        """Write one line."""
        sys.stderr.write(self.format(record) + "\n")
