"""The paper that ehlectric reproduces: its own methods, and its study.

H. Morris, M. Leighton and N. Morris, Lubricants 2022, 10(5), 87, doi:10.3390/lubricants10050087.
"""
