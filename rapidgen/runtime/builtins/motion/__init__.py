"""Built-ins for movements and their settings."""
