"""Threads, worker processes, interrupts, memory, and files that are written completely or not at all."""
