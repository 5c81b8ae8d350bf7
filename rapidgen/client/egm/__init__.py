"""Guidance of a robot at 250 Hz: the partner of externally guided motion.

    with rapidgen.client.egm.listen("irb120", port=6510) as session:
        session.wait_until_guided()
        session.send(q)

The 4 ms loop runs in a process of its own, so that pauses of Python do not reach the robot.
"""

from rapidgen.client.egm.envelope import Envelope
from rapidgen.client.egm.exchange import EgmState
from rapidgen.client.egm.session import EgmSession, listen

__all__ = ["EgmSession", "EgmState", "Envelope", "listen"]
