"""simple_message as data, and what is derived from it. No I/O."""
