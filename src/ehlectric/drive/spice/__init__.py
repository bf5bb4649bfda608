"""Netlist of a bearing for circuit simulators, and a test bench with the drive."""
