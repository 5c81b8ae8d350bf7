"""Where the EGM examples find their robot: `python EXAMPLE.py [ADDRESS]`.

ADDRESS is that of this computer in the network of the robot, port 6510; the robot's program is
guided.mod or guided_tcp.mod. Without it, `rapidgen sim` executes that program.
"""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rapidgen.client import egm

ROBOT = "irb120"


@contextmanager
def session_of(program: str = "guided.mod") -> Iterator[egm.EgmSession]:
    """A session whose robot waits for targets."""
    guidance = "pose" if program == "guided_tcp.mod" else "joints"
    if sys.argv[1:]:
        with egm.listen(ROBOT, guidance=guidance, host=sys.argv[1]) as session:
            session.wait_until_guided(timeout=600)
            yield session
        return
    with egm.listen(ROBOT, guidance=guidance, port=0) as session:
        path = Path(__file__).with_name(program)
        words = ["sim", str(path), "--robot", ROBOT, "--egm", f"PC=127.0.0.1:{session.port}"]
        sim = subprocess.Popen(
            [sys.executable, "-m", "rapidgen.cli", *words],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            session.wait_until_guided(timeout=60)
            yield session
        finally:
            sim.terminate()
            sim.wait()
