"""Robot Web Services of a virtual controller."""

from rapidgen.servers.rws import handlers

__all__ = ["handlers"]
