"""Lubricant film of one contact: Reynolds equation, elastic deflection, cavitation and balance of load."""
