"""A sine on one joint at 250 Hz, and how far the robot is behind it."""

import math

from guiding import session_of

AMPLITUDE, FREQUENCY, SECONDS = 0.15, 0.3, 5.0  # rad, Hz, s

with session_of() as session:
    start = session.state
    time = 0.0
    while time < SECONDS:
        # A soft start: the amplitude grows over the first second.
        part = min(1.0, time)
        phase = math.tau * FREQUENCY * time
        joints, speeds = list(start.joints), [0.0] * len(start.joints)
        joints[0] += AMPLITUDE * part * math.sin(phase)
        speeds[0] = AMPLITUDE * part * math.tau * FREQUENCY * math.cos(phase)
        session.send(joints, speeds=speeds)
        # The controller's clock counts, so a delay of this program does not change the path.
        time = session.next_state().controller_time - start.controller_time
    lag = session.lag
    session.stop()
    print(f"lag {lag.seconds * 1000:.0f} ms, residual {math.degrees(lag.residual):.3f} degrees")
