"""A RAPID task: errors, pointer, steps, interrupts."""
