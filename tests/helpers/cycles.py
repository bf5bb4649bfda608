"""Duty cycle of a bearing, for tests of its page."""

HEADS = "time [s],speed [rpm],radial load [N],temperature [degC],gear"

# Rows that stand still, touch, have a partial film, and full films with a low and with a high margin.
ROWS = """\
0,0,1800,70,1
10,15,1800,90,1
20,900,2500,80,2
30,1000,1800,80,2
40,-3000,1200,60,3
100,6000,900,40,4
"""
