"""The web app: pages in a browser for bearings, contacts and sweeps, served from this machine.

The process of the server only builds pages. Everything that computes runs in processes of its own
(``work.py``), by the same functions as the command line.
"""
