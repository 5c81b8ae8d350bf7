"""What files alone cannot do, over Robot Web Services: cfg, program memory, restart, read back."""
