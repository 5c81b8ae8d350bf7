"""Plan, apply, verify and roll back what lies on a controller."""
