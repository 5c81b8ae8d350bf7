"""The paired Python client: sync and async."""
