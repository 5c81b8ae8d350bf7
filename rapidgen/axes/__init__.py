"""Units, joint maps, limits, kinematics and timing of axes."""
