"""What people look at, of a robot, a simulation or a recording."""
