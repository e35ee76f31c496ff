"""What LinuxCNC's interpreter loads at its start."""
import remap
