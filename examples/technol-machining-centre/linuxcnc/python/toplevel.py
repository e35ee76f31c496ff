"""Loaded by LinuxCNC's interpreter at its start."""
import remap
