"""Fits of a bearing on its shaft and in its housing, thick rings under pressure, and running clearance."""
