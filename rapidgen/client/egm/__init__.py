"""Guidance of a robot at 250 Hz: the partner of externally guided motion.

    with rapidgen.client.egm.listen("irb120", port=6510) as session:
        session.wait_until_guided()
        session.send(q)

The 4 ms loop runs in a process of its own, so that pauses of Python do not reach the robot.
"""

from rapidgen._extras import named
from rapidgen.client.egm.envelope import Envelope, TcpLimits
from rapidgen.client.egm.lag import Lag
from rapidgen.client.egm.session import AsyncEgmSession, EgmSession, listen, listen_async

with named():
    from rapidgen.client.egm.exchange import EgmState

__all__ = [
    "AsyncEgmSession",
    "EgmSession",
    "EgmState",
    "Envelope",
    "Lag",
    "TcpLimits",
    "listen",
    "listen_async",
]
