"""What the commands print: runs, sweeps, outlets, vessels, devices, this machine, progress."""
