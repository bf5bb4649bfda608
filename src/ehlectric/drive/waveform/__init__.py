"""Waveforms of oscilloscopes, recorders and circuit simulators, from a file to voltages at equal steps.

``waveform_file.read_waveform`` reads a file, and returns a ``waveform.Waveform`` and warnings. What a file
does not state is asked for by a key, and never guessed from the numbers.

============== ==========================================================================================
module         topic
============== ==========================================================================================
waveform       voltages at equal steps of time
waveform_file  the steps from a file to a waveform, and the warnings about it
text_heads     names and units of columns, and what the lines above the numbers state
binary_files   files of MATLAB, LabVIEW, LeCroy and Tektronix, read by libraries
chosen_columns columns that are read, and their factors to SI units
samples        numbers of the chosen columns, and the lines in which they are
sample_times   start and sampling interval; uneven times at equal steps
refusals       files with segments, gaps, counts of a converter, or voltages beyond the range
sample_quality doubts about samples: clipped, coarse, badly resolved or repeated
============== ==========================================================================================
"""
