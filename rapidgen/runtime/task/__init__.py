"""One RAPID task: errors, pointer, steps, interrupts."""
