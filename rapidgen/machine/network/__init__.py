"""Network of the socket built-ins: in memory, or the system's."""
