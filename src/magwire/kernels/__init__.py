"""Compiled kernels: arrays in, arrays out; no checks, no Python objects."""
