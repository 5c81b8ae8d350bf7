"""Time and devices: clock, network, signals, disks, log, pendant."""
