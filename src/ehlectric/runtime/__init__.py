"""Threads, worker processes, interrupts, memory, and files that are never written in part."""
