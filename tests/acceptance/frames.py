"""simple_message frames written by hand, byte by byte, from the layout that the ROS-Industrial
nodes speak (recorded from abb_driver 1.4.0 and industrial_core). Nothing here is encoded by
rapidgen: these are what its codec and its modules are measured against.

A point: length 64, type 11, topic, no reply; sequence; ten joints (rad); velocity 0; duration.
Floats: 0.25 = 0000803e, 0.5 = 0000003f, -0.5 = 000000bf, 1.0 = 0000803f, 0.125 = 0000003e.
"""

_HEAD = "400000000b0000000100000000000000"
_NO_MORE_JOINTS = "00000000" * 4
_VELOCITY = "00000000"

FIVE_POINTS = [
    bytes.fromhex(_HEAD + sequence + joints + _NO_MORE_JOINTS + _VELOCITY + duration)
    for sequence, joints, duration in (
        # -1: where the robot stands; the real client says 10 s for a first stamp of 0.
        ("ffffffff", "00000000" * 6, "00002041"),
        ("01000000", "0000003e" + "00000000" * 5, "0000803f"),
        ("02000000", "0000803e" + "0000003e" + "00000000" * 4, "0000803f"),
        ("03000000", "0000003f" + "0000803e" + "00000000" * 3 + "0000003e", "0000803f"),
        # -3: the last point
        (
            "fdffffff",
            "0000003f" + "0000803e" + "000000bf" + "00000000" * 2 + "0000803e",
            "0000803f",
        ),
    )
]
LAST_JOINTS = (0.5, 0.25, -0.5, 0.0, 0.0, 0.25)

STOP = bytes.fromhex("400000000b0000000200000000000000fcffffff" + "00000000" * 12)
STOP_REPLY = bytes.fromhex("0c0000000b0000000300000001000000")

JOINT_AT_ZERO = bytes.fromhex("380000000a000000010000000000000000000000" + "00000000" * 10)
JOINT_AT_LAST = bytes.fromhex(
    "38000000"
    "0a000000"
    "01000000"
    "00000000"
    "00000000"
    "0000003f"
    "0000803e"
    "000000bf"
    "00000000"
    "00000000"
    "0000803e" + "00000000" * 4
)
# drives on, no e-stop, error_code 0, no error, standing, automatic (2), motion possible
STATUS_IDLE = bytes.fromhex(
    "280000000d000000010000000000000001000000000000000000000000000000000000000200000001000000"
)
STATUS_MOVING = bytes.fromhex(
    "280000000d000000010000000000000001000000000000000000000000000000010000000200000001000000"
)
