"""Time and devices of a controller: clock and events, network, signals, disks, log, pendant."""
