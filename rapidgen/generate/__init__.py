"""The robot model becomes RAPID modules, controller configuration and a manifest."""
