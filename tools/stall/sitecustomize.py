"""Delay every Python process now and then, as on a busy machine.

A test that fails then is flaky. `make stall-test PACKAGE=client`; the environment sets the share
(HELD_UP) and the seed (SEED). Some tests may rightly fail in a delayed process: jog's 0.2 s, 2 s
without a state, and `test_nothing_heavy_is_imported_before_it`, as this file imports threading.
"""

import os
import random
import selectors
import socket
import threading
import time

_SHARE = float(os.environ["HELD_UP"])
"""Share of delayed calls; one of ten delays is long."""
_SHORT, _LONG, _BEGIN = 0.03, 0.3, 1.0
"""s at most"""
_dice = random.Random(f"{os.environ.get('SEED', '')} {os.getpid()}")
_sleep = time.sleep


def _hold_up():
    thrown = _dice.random()
    if thrown < _SHARE:
        _sleep(_dice.uniform(0, _LONG if thrown < _SHARE / 10 else _SHORT))


def _before(kind, name):
    real = getattr(kind, name)

    def held_up(self, *arguments, **options):
        _hold_up()
        return real(self, *arguments, **options)

    setattr(kind, name, held_up)


def _after(kind, name):
    real = getattr(kind, name)

    def held_up(self, *arguments, **options):
        result = real(self, *arguments, **options)
        _hold_up()
        return result

    setattr(kind, name, held_up)


for _name in ("recv", "recv_into", "send", "sendall", "connect", "close"):
    _before(socket.socket, _name)
_before(threading.Thread, "run")
# A thread that gets no time while the others of its process run.
_before(threading.Condition, "__enter__")
_after(socket.socket, "accept")
_after(selectors.DefaultSelector, "select")
_after(threading.Condition, "wait")
if _dice.random() < 0.3:
    _sleep(_dice.uniform(0, _BEGIN))
