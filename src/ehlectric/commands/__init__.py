"""The command line, and the runs, tables and files behind it that a page can use as well."""
