"""The bytes between controller and client as data, no I/O."""
