"""ABB's cfg text, backups, generated folders and loose files as one frozen System."""
