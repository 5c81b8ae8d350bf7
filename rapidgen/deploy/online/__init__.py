"""Deployment over Robot Web Services: cfg, program memory, restart."""
