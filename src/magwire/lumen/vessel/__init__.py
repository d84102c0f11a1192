"""Vessels from files: lines cleaned, joined into a tree and smoothed."""
