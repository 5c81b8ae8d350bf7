"""The cell of a program that names things that nothing declares: values, robot, peers, answers."""
