"""Margin against breakdown: critical speed, sensitivity, uncertainty, and the verdict on a bearing.

The margin is the voltage of the first breakdown divided by the shaft voltage. Margins at other inputs are
computed with contacts from the atlas of films, and are scaled so that this margin at the case's own inputs
equals the one of its solution.
"""
