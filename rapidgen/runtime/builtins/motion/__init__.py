"""Built-ins that move robots and settle how they move."""
