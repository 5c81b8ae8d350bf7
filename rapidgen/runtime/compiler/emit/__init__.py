"""Python source of RAPID routines, by kind of tree node."""
