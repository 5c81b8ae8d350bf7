"""The network under the socket built-ins, in memory or the operating system's."""
