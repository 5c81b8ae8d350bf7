"""RAPID routines as Python source, compiled on first call."""
